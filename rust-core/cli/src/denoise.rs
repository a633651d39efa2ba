//! Taking noise out of pictures with Intel's Open Image Denoise, which the Python package pyoidn brings.

use gonio::{
    Error, Result,
    film::{Image, Layer},
    scene::{Aov, Settings},
};
use pyo3::{prelude::*, types::PyBytes};

/// Passes that tell noise from detail, and what of the colour has none.
const GUIDES: [Aov; 3] = [Aov::DenoisingAlbedo, Aov::DenoisingNormal, Aov::DenoisingLight];

/// The Python side: `gonio.oidn`.
#[derive(Debug)]
pub(super) struct Denoiser {
    module: Py<PyModule>,
}

impl Denoiser {
    /// Finds the package before anything is rendered.
    pub(super) fn new() -> Result<Self> {
        Python::attach(|py| {
            let module = py.import("gonio.oidn").and_then(|module| module.call_method0("require").map(|_| module));
            module.map(|module| Self { module: module.unbind() }).map_err(|error| failure(py, &error))
        })
    }

    /// Asks for the passes that guide it; gives those that nobody else has asked for.
    pub(super) fn ask_for_guides(settings: &mut Settings) -> Vec<Aov> {
        let added: Vec<Aov> = GUIDES.into_iter().filter(|aov| !settings.aovs.contains(aov)).collect();
        settings.aovs.extend(&added);
        added
    }

    /// Denoises the colour of a picture, guided by the passes that it has.
    pub(super) fn run(&self, image: &mut Image) -> Result<()> {
        let [width, height] = image.size();
        let denoised = Python::attach(|py| {
            let bytes = |layer: &Layer| PyBytes::new(py, &rgb_bytes(layer));
            let [albedo, normal, light] = GUIDES.map(|aov| image.layer(aov).map(bytes));
            let arguments = (width, height, image.layer(Aov::Color).map(bytes), albedo, normal, light);
            let bytes: PyResult<Vec<u8>> = self.module.bind(py).call_method1("denoised_bytes", arguments).and_then(|bytes| bytes.extract());
            bytes.map_err(|error| failure(py, &error))
        })?;
        for layer in image.layers.iter_mut().filter(|layer| layer.aov == Aov::Color) {
            for (pixel, denoised) in layer.values.chunks_exact_mut(layer.channels).zip(denoised.as_chunks::<12>().0) {
                let values = denoised.as_chunks::<4>().0.iter().map(|bytes| f32::from_ne_bytes(*bytes));
                pixel.iter_mut().zip(values).for_each(|(out, value)| *out = value);
            }
        }
        Ok(())
    }
}

/// The first three channels of a pass.
fn rgb_bytes(layer: &Layer) -> Vec<u8> {
    layer.values.chunks_exact(layer.channels).flat_map(|pixel| &pixel[..3]).flat_map(|value| value.to_ne_bytes()).collect()
}

fn failure(py: Python<'_>, error: &PyErr) -> Error {
    Error::setting("denoise", error.value(py).to_string())
}
