//! Pictures by wavelength.

use crate::{
    array::Array,
    error::{exception, setting, told},
    pass::Pass,
    scene::Scene,
    watched::{unless, watched},
};
use gonio::{
    measure::Watch,
    output::{ExrOptions, write_spectral},
    scene::Aov,
    spectral_picture::{self as engine, LightFigure, NewLamp},
};
use gonio_formats::FormatError;
use gonio_simd::Execution;
use gonio_spectrum::{Spectrum, bands_of};
use pyo3::prelude::*;
use std::path::PathBuf;

/// A light group's name, the factor of its lumens, its lamps' spectrum.
type NewGroup = (String, f64, Option<GivenSpectrum>);

/// A spectrum in Python: wavelengths in nm and power.
#[derive(FromPyObject)]
enum GivenSpectrum {
    Read {
        #[pyo3(item)]
        wavelengths_nm: Vec<f64>,
        #[pyo3(item)]
        power: Vec<f64>,
    },
    Pair(Vec<f64>, Vec<f64>),
}

impl GivenSpectrum {
    fn of(&self, name: &str) -> Result<Spectrum, FormatError> {
        let (Self::Read { wavelengths_nm, power } | Self::Pair(wavelengths_nm, power)) = self;
        Spectrum::new(name, wavelengths_nm, power)
    }
}

/// A picture by wavelength.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct SpectralPicture {
    found: engine::SpectralPicture,
    diagnostics: Vec<(String, String)>,
}

#[pymethods]
impl SpectralPicture {
    /// The middles of the bands, nm.
    #[getter]
    fn wavelengths_nm(&self) -> Array {
        Array::flat(self.found.bands.centres())
    }
    /// Spectral radiance, W/(m² sr nm): rows, columns, bands.
    #[getter]
    fn radiance(&self, py: Python<'_>) -> Pass {
        self.by_pixel(py, self.found.radiance())
    }
    /// Linear Rec.709 in cd/m² and coverage: rows, columns, 4.
    #[getter]
    fn color(&self) -> Pass {
        let values = self.found.image.layer(Aov::Color).map(|layer| layer.values.clone()).unwrap_or_default();
        Pass::new(self.found.image.size(), 4, &["R", "G", "B", "A"], values)
    }
    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        self.diagnostics.clone()
    }
    /// Names of its passes by wavelength: color, and illuminance and lightgroup:NAME where the scene asks for them.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.found.layers.iter().map(|layer| layer.name.clone()).collect()
    }
    /// A pass by wavelength, W/(m² sr nm), illuminance in W/(m² nm): rows, columns, bands.
    fn layer(&self, py: Python<'_>, name: &str) -> PyResult<Pass> {
        let layer = self.found.layers.iter().find(|layer| layer.name == name);
        let unknown = || setting("name", format!("'{name}' was found, expected one of {}", self.names().join(", ")));
        Ok(self.by_pixel(py, &layer.ok_or_else(unknown)?.bands))
    }
    /// A figure of the light on what each pixel shows: ra, rf, rg or melanopic-edi (lx), rows and columns, of a scene whose passes have illuminance. NaN where it
    /// is not defined.
    fn light_figure(&self, py: Python<'_>, name: &str) -> PyResult<Pass> {
        let expected = || LightFigure::ALL.map(LightFigure::name).join(", ");
        let figure =
            LightFigure::by_name(name).ok_or_else(|| setting("name", format!("'{name}' was found, expected one of {}", expected())))?;
        let values = py.detach(|| self.found.light_figure(figure)).map_err(exception)?;
        Ok(Pass::new(self.found.image.size(), 1, &["Y"], values))
    }
    /// With other lamps in its light groups: a list of (name, factor, spectrum), where a spectrum is what `illuminant` and `read_spectrum` give, (wavelengths
    /// in nm, power), or None to keep what it was, and factors are of lumens. Diagnostics say what is approximate.
    fn relit(&self, py: Python<'_>, groups: Vec<NewGroup>) -> PyResult<Self> {
        let lamp = |(group, factor, spectrum): NewGroup| {
            if !(factor.is_finite() && factor >= 0.0) {
                return Err(setting("factor", format!("{factor} was found, expected a number from 0 on")));
            }
            let spectrum = spectrum.map(|spectrum| spectrum.of(&group)).transpose();
            let spectrum = spectrum.map_err(|error| setting("spectrum", format!("of {group}: {error}")))?;
            Ok(NewLamp { group, factor, spectrum })
        };
        let lamps = groups.into_iter().map(lamp).collect::<PyResult<Vec<_>>>()?;
        let (found, notes) = py.detach(|| self.found.clone().relit(&lamps)).map_err(exception)?;
        Ok(Self { found, diagnostics: notes.into_iter().map(|note| ("light groups".to_owned(), note)).collect() })
    }
    /// Writes it: .exr in the layout of Fichet and others, .hsr of Radiance.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| write_spectral(&path, &self.found, &ExrOptions::default())).map_err(exception)
    }
}

impl SpectralPicture {
    /// Bands as rows, columns, bands.
    fn by_pixel(&self, py: Python<'_>, bands: &[Vec<f32>]) -> Pass {
        let size = self.found.image.size();
        let pixels = size[0] * size[1];
        let values = py.detach(|| (0..pixels).flat_map(|pixel| bands.iter().map(move |band| band[pixel])).collect());
        Pass::new(size, bands.len(), &[], values)
    }
}

/// Renders the scene's view by wavelength, with its samples for each band of 5, 10 or 20 nm; `cancelled`, a function that says whether to stop, is asked
/// every 50 ms.
#[pyfunction]
#[pyo3(signature = (scene, *, band = 5.0, cancelled = None))]
pub(crate) fn spectral_picture(py: Python<'_>, scene: &Scene, band: f64, cancelled: Option<Py<PyAny>>) -> PyResult<SpectralPicture> {
    let bands = bands_of(band).ok_or_else(|| setting("band", format!("{band} nm was found, expected 5, 10 or 20")))?;
    let description = scene.scene.clone();
    let ask = |py: Python<'_>, _: Option<&gonio::render::Progress>| unless(py, cancelled.as_ref());
    let (found, diagnostics) = watched(py, ask, |stop, progress| {
        let mut watch = Watch { previous: None, cancel: stop, progress };
        engine::spectral_picture(&description, bands, Execution::detect(), &mut watch)
    })?;
    Ok(SpectralPicture { found, diagnostics: told(&diagnostics) })
}
