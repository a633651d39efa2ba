//! Drawings of what a measured material scatters.

mod lobes;
mod map;

pub use lobes::lobe_diagram;
pub use map::lobe_map;

use super::direction::{Direction, spherical, through};
use super::hemispheres::Hemispheres;
use super::measured::Measured;

/// Light's angles from the normal that drawings show, degrees.
const INCIDENCE_DEG: [f64; 4] = [0.0, 30.0, 60.0, 75.0];

/// Decades from the brightest value down that drawings show.
const DECADES: f64 = 4.0;

/// The luminance of a material's BSDF, 1/sr.
struct Luminance<'a> {
    measured: &'a Measured,
    weights: Vec<f64>,
}

impl<'a> Luminance<'a> {
    fn new(measured: &'a Measured) -> Self {
        Self { measured, weights: measured.channels().luminance_weights() }
    }

    /// The BSDF of light from `wi` that leaves to `wo`, without the cosine.
    fn bsdf(&self, wi: Direction, wo: Direction) -> f64 {
        self.measured.luminance(&self.weights, wi, wo).max(0.0) / wi[2].abs()
    }

    /// Light at an angle from the normal of the side that drawings look at, at azimuth 180° so that its mirror direction is at 0°.
    fn light(&self, theta_deg: f64) -> Direction {
        let up = spherical(theta_deg.to_radians(), core::f64::consts::PI);
        if self.is_lit_from_front() { up } else { through(up) }
    }

    /// Whether light comes from the front: it does if anything is done to it there.
    fn is_lit_from_front(&self) -> bool {
        [Hemispheres::ReflectionFront, Hemispheres::TransmissionFront].into_iter().any(|pair| self.measured.has(pair))
    }

    /// What is done to that light.
    fn pairs(&self) -> impl Iterator<Item = Hemispheres> {
        let from_front = self.is_lit_from_front();
        Hemispheres::ALL.into_iter().filter(move |pair| pair.is_from_front() == from_front && self.measured.has(*pair))
    }
}

/// The exponent of the decade that `peak` ends in, for scales.
fn decade(peak: f64) -> f64 {
    if peak > 0.0 && peak.is_finite() { peak.log10().ceil() } else { 0.0 }
}

/// How high a value stands on a scale of [`DECADES`] that ends at 10 to the power of `top`, 0 to 1.
fn height(value: f64, top: f64) -> f64 {
    if value > 0.0 { (1.0 + (value.log10() - top) / DECADES).clamp(0.0, 1.0) } else { 0.0 }
}

/// A power of ten in a drawing.
fn power_of_ten(exponent: f64) -> String {
    if (-3.0..=3.0).contains(&exponent) { crate::short_number(10_f64.powf(exponent)) } else { format!("1e{exponent}") }
}
