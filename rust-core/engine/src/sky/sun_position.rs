//! Where the sun stands: the Solar Position Algorithm of NREL (Reda and Andreas, TP-560-34302), refraction included.

use super::{Moment, within};
use crate::{Error, Result};
use solar_positioning::{Horizon, Location, RefractionCorrection, SolarEvents, SolarPositions, delta_t, time::JulianDate};

/// A place on Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Degrees, −90 to 90; north positive.
    pub latitude_deg: f64,
    /// Degrees, −180 to 180; east positive.
    pub longitude_deg: f64,
    /// Metres above the sea.
    pub elevation_m: f64,
}

impl Place {
    /// Itself, if there is such a place.
    ///
    /// # Errors
    /// The first number that is out of its range.
    pub fn checked(self) -> Result<Self> {
        within("latitude", "°", self.latitude_deg, -90.0..=90.0)?;
        within("longitude", "°", self.longitude_deg, -180.0..=180.0)?;
        within("elevation", " m", self.elevation_m, -500.0..=12_000.0)?;
        Ok(self)
    }

    /// Kilometres to another place along the ground, by the haversine formula on a sphere of 6371 km.
    pub fn distance_km(&self, other: &Self) -> f64 {
        let [north, east] = [other.latitude_deg - self.latitude_deg, other.longitude_deg - self.longitude_deg];
        let half = |degrees: f64| (0.5 * degrees.to_radians()).sin().powi(2);
        let chord = half(north) + self.latitude_deg.to_radians().cos() * other.latitude_deg.to_radians().cos() * half(east);
        2.0 * 6371.0 * chord.clamp(0.0, 1.0).sqrt().asin()
    }

    /// Pressure of the standard atmosphere at this elevation, hPa (ISO 2533).
    pub fn standard_pressure_hpa(&self) -> f64 {
        1013.25 * (1.0 - 2.255_77e-5 * self.elevation_m).powf(5.255_88)
    }

    fn location(&self) -> Location {
        Location { latitude: self.latitude_deg, longitude: self.longitude_deg }
    }
}

/// The air that bends the sun's rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Mean pressure of the year at the place, hPa.
    pub pressure_hpa: f64,
    /// Mean temperature of the year, °C.
    pub temperature_c: f64,
}

impl Air {
    /// The standard atmosphere at a place, 15 °C at the sea.
    pub fn standard(place: &Place) -> Self {
        Self { pressure_hpa: place.standard_pressure_hpa(), temperature_c: 15.0 - 0.0065 * place.elevation_m }
    }
}

/// Where the sun's centre is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunPosition {
    /// Degrees from true north, clockwise.
    pub azimuth_deg: f64,
    /// Degrees above the horizon, as refraction lifts it.
    pub elevation_deg: f64,
}

impl SunPosition {
    /// Unit vector towards the sun: east, north, up.
    pub fn direction(&self) -> [f64; 3] {
        let (sin_azimuth, cos_azimuth) = self.azimuth_deg.to_radians().sin_cos();
        let (up, flat) = self.elevation_deg.to_radians().sin_cos();
        [flat * sin_azimuth, flat * cos_azimuth, up]
    }

    /// Radians from the zenith.
    pub fn zenith_angle(&self) -> f64 {
        (90.0 - self.elevation_deg).to_radians()
    }
}

/// When the sun rises and sets on a day, in hours of the place's clock since midnight of that day; `None` where it does not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunTimes {
    /// The upper limb comes over the horizon.
    pub sunrise_h: Option<f64>,
    /// The sun passes the meridian.
    pub transit_h: Option<f64>,
    /// The upper limb goes under the horizon.
    pub sunset_h: Option<f64>,
}

/// The sun's position, within 0.0003° for the years −2000 to 6000.
///
/// # Errors
/// A place, moment or air that does not exist.
pub fn sun_position(place: &Place, moment: &Moment, air: &Air) -> Result<SunPosition> {
    let (place, moment) = (place.checked()?, moment.checked()?);
    let refraction = RefractionCorrection::new(air.pressure_hpa, air.temperature_c).map_err(|error| unusable(&error))?;
    let time = JulianDate::new(moment.julian_date(), seconds_of_delta_t(&moment)?).map_err(|error| unusable(&error))?;
    let found = SolarPositions::new().at_from_julian(time, place.location(), place.elevation_m, Some(refraction));
    let found = found.map_err(|error| unusable(&error))?;
    Ok(SunPosition { azimuth_deg: found.azimuth(), elevation_deg: found.elevation_angle() })
}

/// Sunrise, transit and sunset of the moment's day; the horizon is level with the place.
///
/// # Errors
/// A place or moment that does not exist.
pub fn sun_times(place: &Place, moment: &Moment) -> Result<SunTimes> {
    let (place, moment) = (place.checked()?, moment.checked()?);
    let start = moment.julian_midnight() - moment.utc_offset_h / 24.0;
    let (end, location, delta_t) = (start + 1.0, place.location(), seconds_of_delta_t(&moment)?);
    let (events, horizon) = (SolarEvents::new(), Horizon::SunriseSunset);
    let hours = |found: solar_positioning::Result<Option<f64>>| Ok(found.map_err(|error| unusable(&error))?.map(|at| (at - start) * 24.0));
    Ok(SunTimes {
        sunrise_h: hours(events.next_rise_from_julian(start, end, location, delta_t, horizon))?,
        transit_h: hours(events.next_transit_from_julian(start, end, location.longitude, delta_t))?,
        sunset_h: hours(events.next_set_from_julian(start, end, location, delta_t, horizon))?,
    })
}

/// Terrestrial less universal time in seconds.
fn seconds_of_delta_t(moment: &Moment) -> Result<f64> {
    delta_t::estimate_from_date(moment.year, moment.month).map_err(|error| unusable(&error))
}

fn unusable(error: &solar_positioning::Error) -> Error {
    Error::setting("sun", error.to_string())
}
