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
    spectral_picture::{self as engine},
};
use gonio_simd::Execution;
use gonio_spectrum::bands_of;
use pyo3::prelude::*;
use std::path::PathBuf;

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
        let (size, bands) = (self.found.image.size(), &self.found.radiance);
        let pixels = size[0] * size[1];
        let values = py.detach(|| (0..pixels).flat_map(|pixel| bands.iter().map(move |band| band[pixel])).collect());
        Pass::new(size, bands.len(), &[], values)
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
    /// Writes it: .exr in the layout of Fichet and others, .hsr of Radiance.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| write_spectral(&path, &self.found, &ExrOptions::default())).map_err(exception)
    }
}

/// Renders the scene's view by wavelength, with its samples for each band of 5, 10 or 20 nm; `cancelled`, a function that says whether to stop, is asked
/// every 50 ms.
#[pyfunction]
#[pyo3(signature = (scene, *, band = 5.0, cancelled = None))]
pub(crate) fn spectral_picture(py: Python<'_>, scene: &Scene, band: f64, cancelled: Option<Py<PyAny>>) -> PyResult<SpectralPicture> {
    let bands = bands_of(band).ok_or_else(|| setting("band", format!("{band} nm was found, expected 5, 10 or 20")))?;
    let description = scene.scene.clone();
    let ask = |py: Python<'_>, _: &gonio::render::Progress| unless(py, cancelled.as_ref());
    let (found, diagnostics) = watched(py, ask, |stop, progress| {
        let mut watch = Watch { previous: None, cancel: stop, progress };
        engine::spectral_picture(&description, bands, Execution::detect(), &mut watch)
    })?;
    Ok(SpectralPicture { found, diagnostics: told(&diagnostics) })
}
