//! The colours of lamps.

use pyo3::prelude::*;

/// Linear Rec.709 colour of luminance 1 of a black body at a temperature in K, between 1000 K and 10000 K, held there outside.
#[pyfunction]
pub(crate) fn blackbody_rgb(kelvin: f32) -> [f32; 3] {
    gonio::light::blackbody_rgb(kelvin)
}
