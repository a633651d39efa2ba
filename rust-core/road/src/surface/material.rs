//! Measured materials as roads.

use gonio_formats::{
    FormatError,
    bsdf::{self, Format},
};
use std::sync::Arc;

/// Degrees of elevation at which a driver sees the road.
const SEEN: f64 = 1.0;

/// A measured material that a driver sees along its first axis.
#[derive(Clone, Debug)]
pub struct Material {
    measured: Arc<bsdf::Measured>,
    /// What each of its channels counts in luminance.
    weights: Vec<f64>,
}

impl Material {
    /// Reads a file of any of the formats of measured materials; none where it is of none of them.
    ///
    /// # Errors
    /// What is wrong with a file of theirs.
    pub fn read(bytes: &[u8], name: &str) -> Option<Result<Self, FormatError>> {
        Format::of(bytes, name)?;
        let read = bsdf::read(bytes, name);
        Some(read.map(|measured| Self { weights: measured.channels().luminance_weights(), measured: Arc::new(measured) }))
    }

    /// r = q cos³γ in 1/sr at β in degrees and tan γ: the mean of light from both sides where these differ.
    pub(super) fn reduced(&self, beta: f64, tangent: f64) -> f64 {
        let (sin_seen, cos_seen) = SEEN.to_radians().sin_cos();
        let (sin_beta, cos_beta) = beta.to_radians().sin_cos();
        let cosine = (1.0 + tangent * tangent).sqrt().recip();
        let (across, eye) = (tangent * cosine, [-cos_seen, 0.0, sin_seen]);
        let from = |side: f64| self.luminance([across * cos_beta, side * across * sin_beta, cosine], eye);
        let mean = if self.measured.is_isotropic() { from(1.0) } else { 0.5 * (from(1.0) + from(-1.0)) };
        // It holds one cosine.
        mean * cosine * cosine
    }

    /// BSDF × cosine of the light's direction.
    fn luminance(&self, light: [f64; 3], eye: [f64; 3]) -> f64 {
        let mut values = vec![0.0; self.weights.len()];
        self.measured.eval(light, eye, &mut values);
        values.iter().zip(&self.weights).map(|(value, weight)| value * weight).sum()
    }
}
