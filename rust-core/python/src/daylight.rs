//! Daylight by place, time and weather.

use crate::{
    error::{exception, setting},
    pass::Pass,
};
use gonio::scene::ColourSpectra;
use gonio::sky::{self, Air, Frame, Irradiance, Moment, Place, SkyModel, SunTimes, UpAxis};
use gonio_formats::weather;
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};

/// The sun and the sky over a place at a moment: angles in degrees, illuminances in lx, luminances in cd/m².
#[pyclass(frozen, module = "gonio")]
#[derive(Clone, Copy)]
pub(crate) struct Daylight {
    pub(crate) daylight: sky::Daylight,
    sky: sky::Sky,
    times: SunTimes,
}

/// A moment from ISO 8601 text, or from a datetime that knows its offset.
fn moment(time: &Bound<'_, PyAny>) -> PyResult<Moment> {
    let text: String = if time.hasattr("isoformat")? { time.call_method0("isoformat")?.extract()? } else { time.extract()? };
    Moment::parse(&text).map_err(exception)
}

/// The axis of a name.
pub(crate) fn up_axis(name: &str) -> PyResult<UpAxis> {
    match name {
        "Y" | "y" => Ok(UpAxis::Y),
        "Z" | "z" => Ok(UpAxis::Z),
        other => Err(setting("up", format!("'{other}' was found, expected Y or Z"))),
    }
}

/// Daylight over a place: latitude (north positive) and longitude (east positive) in degrees, time as ISO 8601 text with an offset from UTC or a
/// datetime that knows its own.
///
/// elevation: metres above the sea; pressure and temperature: hPa and °C of the air that bends the sun's rays, both or neither; sky: perez,
/// hosek-wilkie, overcast, clear, or cie1 to cie16; turbidity: haze, 1 to 10; direct_normal and diffuse_horizontal: measured irradiances in W/m²,
/// both or neither; dew_point: °C; ground: its albedo, shown below the horizon; coloured: False for a white sun and sky.
#[pyfunction]
#[pyo3(signature = (latitude, longitude, time, *, elevation = 0.0, pressure = None, temperature = None, sky = "perez", turbidity = 3.0, direct_normal = None, diffuse_horizontal = None, dew_point = None, ground = 0.0, coloured = true))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn daylight(
    latitude: f64,
    longitude: f64,
    time: &Bound<'_, PyAny>,
    elevation: f64,
    pressure: Option<f64>,
    temperature: Option<f64>,
    sky: &str,
    turbidity: f64,
    direct_normal: Option<f64>,
    diffuse_horizontal: Option<f64>,
    dew_point: Option<f64>,
    ground: f64,
    coloured: bool,
) -> PyResult<Daylight> {
    let place = Place { latitude_deg: latitude, longitude_deg: longitude, elevation_m: elevation };
    let mut daylight = sky::Daylight::new(place, moment(time)?);
    daylight.model = SkyModel::parse(sky).map_err(exception)?;
    daylight.air =
        pair("pressure", pressure, "temperature", temperature)?.map(|[pressure_hpa, temperature_c]| Air { pressure_hpa, temperature_c });
    daylight.irradiance = pair("direct_normal", direct_normal, "diffuse_horizontal", diffuse_horizontal)?
        .map(|[direct_normal, diffuse_horizontal]| Irradiance { direct_normal, diffuse_horizontal });
    daylight.dew_point_c = dew_point.unwrap_or(daylight.dew_point_c);
    daylight.turbidity = turbidity;
    daylight.ground = ground;
    daylight.is_coloured = coloured;
    Daylight::of(daylight)
}

/// Two numbers that belong together.
fn pair(first_name: &str, first: Option<f64>, second_name: &str, second: Option<f64>) -> PyResult<Option<[f64; 2]>> {
    match (first, second) {
        (Some(first), Some(second)) => Ok(Some([first, second])),
        (None, None) => Ok(None),
        _ => Err(PyValueError::new_err(format!("{first_name} and {second_name} go together, one alone was given"))),
    }
}

impl Daylight {
    fn of(daylight: sky::Daylight) -> PyResult<Self> {
        let sky = daylight.sky().map_err(exception)?;
        let times = sky::sun_times(&daylight.place, &daylight.moment).map_err(exception)?;
        Ok(Self { daylight, sky, times })
    }
}

#[pymethods]
impl Daylight {
    /// Degrees from true north to the sun, clockwise.
    #[getter]
    fn azimuth(&self) -> f64 {
        self.sky.sun.azimuth_deg
    }
    /// Degrees from the horizon to the sun's centre, refraction included.
    #[getter]
    fn elevation(&self) -> f64 {
        self.sky.sun.elevation_deg
    }
    /// Unit vector towards the sun: east, north, up.
    #[getter]
    fn sun_direction(&self) -> (f64, f64, f64) {
        self.sky.sun.direction().into()
    }
    /// Hours of the place's clock at which the sun rises; None if it does not on this day.
    #[getter]
    fn sunrise(&self) -> Option<f64> {
        self.times.sunrise_h
    }
    /// Hours of the place's clock at which the sun crosses the meridian.
    #[getter]
    fn transit(&self) -> Option<f64> {
        self.times.transit_h
    }
    /// Hours of the place's clock at which the sun sets; None if it does not on this day.
    #[getter]
    fn sunset(&self) -> Option<f64> {
        self.times.sunset_h
    }
    /// Illuminance by the sun's disc of a surface that faces it, lx.
    #[getter]
    fn direct_illuminance(&self) -> f64 {
        self.sky.direct_lux
    }
    /// Illuminance by the sky of a level surface, lx.
    #[getter]
    fn diffuse_illuminance(&self) -> f64 {
        self.sky.diffuse_lux
    }
    /// Illuminance by sun and sky of a level surface, lx.
    #[getter]
    fn global_illuminance(&self) -> f64 {
        self.sky.global_lux()
    }
    /// Irradiances that were given, or those of a cloudless day, W/m²: direct normal and diffuse horizontal.
    #[getter]
    fn irradiances(&self) -> (f64, f64) {
        (self.sky.irradiance.direct_normal, self.sky.irradiance.diffuse_horizontal)
    }
    /// Luminance of the zenith, cd/m².
    #[getter]
    fn zenith_luminance(&self) -> f64 {
        self.sky.zenith_luminance()
    }
    /// Mean luminance of the sun's disc, cd/m².
    #[getter]
    fn sun_luminance(&self) -> f64 {
        self.sky.sun_luminance()
    }
    /// Irradiance by the sun's disc of a surface that faces it: linear Rec.709 whose luminance is in lx.
    #[getter]
    fn sun_irradiance(&self) -> [f64; 3] {
        self.sky.sun_irradiance()
    }
    /// What red, green and blue of the sky are where light has wavelengths, as `add_light` takes it: `wavelengths_nm`, and `over_d65`, three lists. None for a
    /// white sky.
    #[getter]
    fn sky_spectra<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        self.sky.sky_spectra().map(|spectra| spectra_described(py, &spectra)).transpose()
    }
    /// The same of the sun's disc.
    #[getter]
    fn sun_spectra<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        self.sky.sun_spectra().map(|spectra| spectra_described(py, &spectra)).transpose()
    }
    /// Luminance of the sky without the sun's disc towards a unit vector (east, north, up), cd/m².
    fn luminance(&self, direction: [f64; 3]) -> f64 {
        self.sky.luminance(direction)
    }
    /// The sky without the sun's disc as a latitude-longitude picture of `rows` rows and twice as many columns: linear RGBA in cd/m², the zenith on
    /// top, south in the middle, east left of it.
    #[pyo3(signature = (rows = 512))]
    fn image(&self, py: Python<'_>, rows: u32) -> PyResult<Pass> {
        let image = py.detach(|| self.sky.image(rows)).map_err(exception)?;
        Ok(Pass::new([image.width as usize, image.height as usize], 4, &["R", "G", "B", "A"], image.rgba.to_vec()))
    }
    /// In words.
    fn __repr__(&self) -> String {
        let (daylight, sky) = (&self.daylight, &self.sky);
        format!(
            "<gonio.Daylight: {} at {:.4}°, {:.4}°; {} sky, sun {:.2}° high at {:.2}°, {:.0} lx from it and {:.0} lx from the sky>",
            daylight.moment,
            daylight.place.latitude_deg,
            daylight.place.longitude_deg,
            daylight.model,
            sky.sun.elevation_deg,
            sky.sun.azimuth_deg,
            sky.direct_lux,
            sky.diffuse_lux
        )
    }
}

fn spectra_described<'py>(py: Python<'py>, spectra: &ColourSpectra) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("wavelengths_nm", &spectra.wavelengths_nm)?;
    described.set_item("over_d65", spectra.over_d65.to_vec())?;
    Ok(described)
}

/// How the sky stands over a scene.
pub(crate) fn frame(up: &str, north: f64) -> PyResult<Frame> {
    if !north.is_finite() {
        return Err(setting("north", format!("{north} was found, expected degrees")));
    }
    Ok(Frame { up_axis: up_axis(up)?, north_deg: north })
}

/// What an EPW or WEA file's bytes hold: place, latitude, longitude, utc_offset, elevation, and hours as (month, day, hour, direct normal and
/// diffuse horizontal irradiance in W/m², dew point or None); `name` says which file it is.
#[pyfunction]
pub(crate) fn read_weather<'py>(py: Python<'py>, data: &[u8], name: &str) -> PyResult<Bound<'py, PyDict>> {
    let found = weather::read(data).map_err(|error| exception(gonio::Error::in_file(name, &error)))?;
    let found = gonio::sky::in_irradiances(found);
    let hour = |h: &weather::Hour| (h.month, h.day, h.hour, h.direct_normal, h.diffuse_horizontal, h.dew_point_c);
    let result = PyDict::new(py);
    result.set_item("place", &found.place)?;
    result.set_item("latitude", found.latitude_deg)?;
    result.set_item("longitude", found.longitude_deg)?;
    result.set_item("utc_offset", found.utc_offset_h)?;
    result.set_item("elevation", found.elevation_m)?;
    result.set_item("hours", found.hours.iter().map(hour).collect::<Vec<_>>())?;
    Ok(result)
}
