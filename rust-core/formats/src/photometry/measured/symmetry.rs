//! Symmetries that standard errors bear out.
//!
//! A symmetry makes some planes equal. Where it holds, the differences between those planes are noise, and the sum of their squares over the
//! variances is near the number of degrees of freedom: one less than planes, for each group of equal planes and each γ. It is tested on the
//! intensities and, since a small tilt of the whole hides in the noise of each direction, on the planes' fluxes.

use super::Measurement;
use crate::photometry::Symmetry;
use crate::photometry::flux::polar_weights_of;
use crate::photometry::lookup::fold_plane;

/// χ² per degree of freedom that a symmetry may have: this much for errors that are estimates themselves, and [`SPREADS`] standard
/// deviations of χ² (√2 over the root of the degrees of freedom) above it.
const ALLOWED: f64 = 1.1;
/// See [`ALLOWED`].
const SPREADS: f64 = 4.0;
/// Standard errors by which no single plane may differ from its group.
const LARGEST: f64 = 6.0;
/// Differences of that share of a group's mean are no asymmetry, nor are those of [`FLOOR`] of the peak: facets do as much.
const RIPPLE: f64 = 1e-3;
/// See [`RIPPLE`].
const FLOOR: f64 = 1e-4;

/// How well a symmetry fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryTest {
    /// The symmetry.
    pub symmetry: Symmetry,
    /// χ² per degree of freedom of the intensities; near 1 where the symmetry holds, 0 where errors are too small to matter.
    pub chi_square: f64,
    /// The degrees of freedom, each as far as noise is what differences come from.
    pub degrees: f64,
    /// χ² per degree of freedom of the planes' fluxes.
    pub flux_chi_square: f64,
    /// The largest difference between a plane and its group's mean, in standard errors.
    pub largest: f64,
    /// Whether it holds: both χ² are at most 1.1 + 4 √(2 / degrees of freedom), and the largest difference at most six standard errors.
    /// A thousandth of the group's mean and 0.0001 of the peak are added to the errors.
    pub holds: bool,
}

/// Planes that a symmetry makes equal: the angle they are kept at, and their indices.
pub(super) type Group = (f64, Vec<usize>);

/// A sum of squares over variances.
#[derive(Clone, Copy, Default)]
struct ChiSquare {
    sum: f64,
    degrees: f64,
    /// What differences too small to be asymmetry may add.
    ripple: f64,
    largest: f64,
}

impl ChiSquare {
    /// Adds a group of values that should be one, each with its variance.
    fn add(&mut self, values: &[[f64; 2]], peak: f64) {
        let count = values.len() as f64;
        let mean = values.iter().map(|[value, _]| value).sum::<f64>() / count;
        let noise = values.iter().map(|[_, variance]| variance).sum::<f64>() / count;
        let floor = (RIPPLE * mean).powi(2) + (FLOOR * peak).powi(2);
        // Dark directions tell nothing.
        if values.len() < 2 || noise + floor <= 0.0 || values.iter().all(|value| *value == [0.0; 2]) {
            return;
        }
        let squares: f64 = values.iter().map(|[value, _]| (value - mean).powi(2)).sum();
        // Where noise is the least part, many such directions would hide what the others say.
        if noise >= floor {
            self.sum += squares / (noise + floor);
            self.degrees += (count - 1.0) * noise / (noise + floor);
            self.ripple += (count - 1.0) * floor / (noise + floor);
        }
        for [value, variance] in values {
            // Few counts give small errors by chance: the group's is the least.
            let variance = (variance.max(noise) + floor) * (1.0 - 1.0 / count);
            self.largest = self.largest.max(((value - mean).powi(2) / variance).sqrt());
        }
    }

    fn per_degree(&self) -> f64 {
        if self.degrees > 0.0 { self.sum / self.degrees } else { 0.0 }
    }

    fn holds(&self) -> bool {
        let limit = ALLOWED * self.degrees + SPREADS * (2.0 * self.degrees).sqrt() + self.ripple;
        self.sum <= limit && self.largest <= LARGEST
    }
}

impl Measurement {
    /// The highest symmetry that the errors bear out, and the tests that led to it.
    pub(super) fn symmetry_found(&self) -> (Symmetry, Vec<SymmetryTest>) {
        let mut tests = Vec::new();
        for symmetry in [Symmetry::Rotational, Symmetry::Quadrants, Symmetry::AboutC0, Symmetry::AboutC90] {
            let Some(test) = self.symmetry_test(symmetry) else { continue };
            tests.push(test);
            if test.holds {
                return (symmetry, tests);
            }
        }
        (Symmetry::None, tests)
    }

    /// Tests a symmetry; `None` where the planes are too few or lie so that they cannot have it.
    pub(super) fn symmetry_test(&self, symmetry: Symmetry) -> Option<SymmetryTest> {
        let groups = self.groups(symmetry)?;
        let peak = self.intensities.iter().copied().fold(0.0, f64::max);
        let (mut each, mut whole) = (ChiSquare::default(), ChiSquare::default());
        let weights = polar_weights_of(&self.gammas);
        let fluxes: Vec<[f64; 2]> = (0..self.planes.len()).map(|plane| self.plane_flux(plane, &weights)).collect();
        let mean = fluxes.iter().map(|[flux, _]| flux).sum::<f64>() / fluxes.len() as f64;
        for (_, members) in &groups {
            for gamma in (0..self.gammas.len()).filter(|gamma| !self.is_pole(*gamma)) {
                let values: Vec<[f64; 2]> = members.iter().map(|plane| self.at(*plane, gamma)).collect();
                each.add(&values, peak);
            }
            let values: Vec<[f64; 2]> = members.iter().map(|plane| fluxes[*plane]).collect();
            whole.add(&values, mean);
        }
        Some(SymmetryTest {
            symmetry,
            chi_square: each.per_degree(),
            degrees: each.degrees,
            flux_chi_square: whole.per_degree(),
            largest: each.largest.max(whole.largest),
            holds: each.holds() && whole.holds(),
        })
    }

    /// The flux of a plane in lm per radian of C, and its variance.
    fn plane_flux(&self, plane: usize, weights: &[f64]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (gamma, weight) in weights.iter().enumerate() {
            let [value, variance] = self.at(plane, gamma);
            sum[0] += weight * value;
            sum[1] += weight * weight * variance;
        }
        sum
    }

    /// The planes that a symmetry makes equal, by the angle they are kept at; `None` where their mirror images are no planes.
    pub(super) fn groups(&self, symmetry: Symmetry) -> Option<Vec<Group>> {
        let (count, step) = (self.planes.len(), self.step());
        let least = match symmetry {
            Symmetry::None | Symmetry::Rotational => 1,
            Symmetry::AboutC0 => 2,
            Symmetry::AboutC90 | Symmetry::Quadrants => 4,
        };
        if count % least != 0 {
            return None;
        }
        let mut groups: Vec<Group> = (0..count).map(|index| (index as f64 * step, Vec::new())).collect();
        for (index, c) in self.planes.iter().enumerate() {
            // A plane within rounding of 360 is the first.
            let kept = (fold_plane(*c, symmetry) / step).round() as usize % count;
            groups[kept].1.push(index);
        }
        groups.retain(|(_, members)| !members.is_empty());
        Some(groups)
    }
}
