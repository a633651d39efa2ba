//! What a fit is compared with.

use super::model::Model;
use crate::bsdf::direction::{Direction, angles_of, azimuth, cosine_direction, reflected, spherical};
use crate::bsdf::measured::Measured;

/// Pairs of directions.
const PAIRS: usize = 2048;

/// Rounds of Newton's method for a colour.
const ROUNDS: usize = 6;

/// Added before cube roots are drawn, 1/sr: below it there is nothing to see, and the root has no slope at zero.
const LEAST: f64 = 1e-5;

/// Directions and the measured BSDF × cosine of `wi` there.
pub(super) struct Observations {
    pairs: Vec<[Direction; 2]>,
    /// Cube roots, for each channel.
    roots: [Vec<f64>; 3],
    /// The sum of their squares.
    total: f64,
}

impl Observations {
    /// Views over the hemisphere, and light half over the hemisphere, half about the mirror direction.
    pub(super) fn of(measured: &Measured) -> Self {
        let weights = measured.channels().rgb_weights();
        let mut found = Self { pairs: Vec::with_capacity(PAIRS), roots: [Vec::new(), Vec::new(), Vec::new()], total: 0.0 };
        for i in 0..2 * PAIRS {
            let [wi, wo] = pair(i);
            if wi[2] <= 0.0 || found.pairs.len() == PAIRS {
                continue;
            }
            found.pairs.push([wi, wo]);
            for (roots, value) in found.roots.iter_mut().zip(measured.rgb(&weights, wi, wo)) {
                roots.push((value.max(0.0) + LEAST).cbrt());
            }
        }
        found.total = found.roots.iter().flatten().map(|root| root * root).sum();
        found
    }

    /// Whether nothing is reflected at all.
    pub(super) fn is_black(&self) -> bool {
        self.roots.iter().flatten().all(|root| *root <= LEAST.cbrt() * (1.0 + 1e-9))
    }

    /// The best colour of a model, and how far it is from the measurement.
    pub(super) fn solve(&self, model: &Model) -> ([f64; 3], f64) {
        let responses: Vec<_> = self.pairs.iter().map(|[wi, wo]| model.response(*wi, *wo)).collect();
        let white_mean = model.white_mean();
        let mut squares = 0.0;
        let colour = [0, 1, 2].map(|c| {
            let mut colour = 0.5;
            for _ in 0..ROUNDS {
                let (mut numerator, mut denominator) = (0.0, f64::MIN_POSITIVE);
                for (response, root) in responses.iter().zip(&self.roots[c]) {
                    let [value, slope] = response.value(colour, white_mean);
                    let found = (value + LEAST).cbrt();
                    let slope = slope / (3.0 * found * found);
                    numerator += slope * (root - found);
                    denominator += slope * slope;
                }
                colour = (colour + numerator / denominator).clamp(0.0, 1.0);
            }
            let difference = |(response, root): (&super::model::Response, &f64)| {
                let found = (response.value(colour, white_mean)[0] + LEAST).cbrt();
                (found - root) * (found - root)
            };
            squares += responses.iter().zip(&self.roots[c]).map(difference).sum::<f64>();
            colour
        });
        (colour, (squares / self.total).sqrt())
    }
}

/// Light and view of a low-discrepancy sequence (Roberts' R₄); the view stays 3° above the surface, light may fall below it.
fn pair(i: usize) -> [Direction; 2] {
    // Powers of the inverse of the root of x⁵ = x + 1.
    let step = [0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_3];
    let u = step.map(|step| (0.5 + step * (i + 1) as f64).fract());
    let wo = cosine_direction([0.997 * u[0], u[1]]);
    if i.is_multiple_of(2) {
        return [cosine_direction([0.997 * u[2], u[3]]), wo];
    }
    let (theta, phi) = angles_of([u[2], u[3]]);
    [reflected(wo, spherical(theta, phi + azimuth(wo))), wo]
}
