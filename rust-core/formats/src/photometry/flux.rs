//! Luminous flux in closed form, for the same bilinear interpolation that [`Goniogram::intensity`] uses.
//!
//! Within a cell the intensity is linear in each angle, so its integral over solid angle is a sum of weights of the tabulated values: of
//! ∫ (a + bt) dt along the angle about the polar axis, and of ∫ (a + bt) sin t dt = −(a + bt) cos t + b sin t along the angle from it.
//! Types A and B have their polar axis across nadir, and there the half space below is a range of the angle about the axis: exact as
//! well.

use super::{Goniogram, PhotometricType, Symmetry};
use std::f64::consts::PI;

/// No limit.
const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl Goniogram {
    /// The luminaire's luminous flux in lm.
    pub fn flux(&self) -> f64 {
        self.flux_within(ALL, ALL)
    }

    /// The flux in lm below the horizontal plane through the luminaire (γ < 90°).
    pub fn flux_below(&self) -> f64 {
        match self.photometric_type {
            PhotometricType::C => self.flux_within(ALL, [0.0, 90.0]),
            PhotometricType::B => self.flux_within(ALL, [-90.0, 90.0]),
            PhotometricType::A => self.flux_within([-90.0, 90.0], ALL),
        }
    }

    /// The flux in lm between two γ in degrees; type C.
    pub(crate) fn flux_between(&self, vertical: [f64; 2]) -> f64 {
        self.flux_within(ALL, vertical)
    }

    /// The same in ranges of C from 0 to 360 degrees, of a goniogram without symmetry that stores both ends.
    pub(crate) fn flux_of_sides(&self, sides: &[[f64; 2]], vertical: [f64; 2]) -> f64 {
        let down = polar_weights(&self.vertical, vertical, 0.0);
        let plane = |h: usize| self.plane(h).iter().zip(&down).map(|(intensity, weight)| intensity * weight).sum::<f64>();
        let of_side =
            |side: &[f64; 2]| flat_weights(&self.horizontal, *side).iter().enumerate().map(|(h, weight)| weight * plane(h)).sum::<f64>();
        sides.iter().map(of_side).sum()
    }

    /// The flux in lm of the directions whose stored angles lie in two ranges, in degrees.
    fn flux_within(&self, horizontal: [f64; 2], vertical: [f64; 2]) -> f64 {
        let (along, down) = match self.photometric_type {
            PhotometricType::C => (self.plane_weights(), polar_weights(&self.vertical, vertical, 0.0)),
            PhotometricType::B => (polar_weights(&self.horizontal, horizontal, 90.0), flat_weights(&self.vertical, vertical)),
            PhotometricType::A => (flat_weights(&self.horizontal, horizontal), polar_weights(&self.vertical, vertical, 90.0)),
        };
        let plane = |h: usize| self.plane(h).iter().zip(&down).map(|(intensity, weight)| intensity * weight).sum::<f64>();
        let stored: f64 = along.iter().enumerate().map(|(h, weight)| weight * plane(h)).sum();
        stored * self.copies()
    }

    /// Each stored intensity's weight in sr in the flux between two γ in degrees; type C.
    pub(crate) fn flux_weights(&self, vertical: [f64; 2]) -> Vec<f64> {
        let (along, down) = (self.plane_weights(), polar_weights(&self.vertical, vertical, 0.0));
        let copies = self.copies();
        along.iter().flat_map(|plane| down.iter().map(move |weight| copies * plane * weight)).collect()
    }

    /// How often the stored part fills the whole.
    fn copies(&self) -> f64 {
        match self.symmetry {
            Symmetry::None | Symmetry::Rotational => 1.0,
            Symmetry::AboutC0 | Symmetry::AboutC90 => 2.0,
            Symmetry::Quadrants => 4.0,
        }
    }

    /// Weights in radians of the stored C planes.
    pub(crate) fn plane_weights(&self) -> Vec<f64> {
        if self.symmetry == Symmetry::Rotational {
            return vec![2.0 * PI];
        }
        let mut weights = flat_weights(&self.horizontal, ALL);
        if let (Symmetry::None, Some(first), Some(last)) = (self.symmetry, self.horizontal.first(), self.horizontal.last()) {
            // The last plane and the first enclose the cell that closes the circle.
            let gap = (first + 360.0 - last).max(0.0).to_radians() / 2.0;
            let end = weights.len() - 1;
            weights[0] += gap;
            weights[end] += gap;
        }
        weights
    }
}

/// ∫ hatᵢ(t) dt in radians within `limits`, the hats being linear interpolation's.
fn flat_weights(angles: &[f64], limits: [f64; 2]) -> Vec<f64> {
    // From the cell's start: (u²/2) for the part that belongs to its far end.
    hats(angles, limits, |start, [a, b]| {
        let (a, b) = (a - start, b - start);
        [b - a, (b - a) * (b + a) / 2.0]
    })
}

/// The weights of angles from the polar axis in degrees, for a flux per radian about it.
pub(crate) fn polar_weights_of(angles: &[f64]) -> Vec<f64> {
    polar_weights(angles, ALL, 0.0)
}

/// ∫ hatᵢ(t) sin(t + offset) dt, with `offset` in degrees.
fn polar_weights(angles: &[f64], limits: [f64; 2], offset: f64) -> Vec<f64> {
    let offset = offset.to_radians();
    hats(angles, limits, |start, [a, b]| {
        let (middle, half) = (offset + (a + b) / 2.0, (b - a) / 2.0);
        // ∫ sin and ∫ (t − start) sin t, written so that small cells lose no digits.
        let whole = 2.0 * middle.sin() * half.sin();
        let first = (a - start) * (a + offset).cos() - (b - start) * (b + offset).cos() + 2.0 * middle.cos() * half.sin();
        [whole, first]
    })
}

/// Sums each cell's integral of the measure, and of the measure times the distance from the cell's start, into weights of its two ends.
fn hats(angles: &[f64], limits: [f64; 2], integrals: impl Fn(f64, [f64; 2]) -> [f64; 2]) -> Vec<f64> {
    let mut weights = vec![0.0; angles.len()];
    for (index, pair) in angles.windows(2).enumerate() {
        let range = [pair[0].max(limits[0]), pair[1].min(limits[1])].map(f64::to_radians);
        let (start, width) = (pair[0].to_radians(), (pair[1] - pair[0]).to_radians());
        if range[1] > range[0] {
            let [whole, first] = integrals(start, range);
            weights[index] += whole - first / width;
            weights[index + 1] += first / width;
        }
    }
    weights
}
