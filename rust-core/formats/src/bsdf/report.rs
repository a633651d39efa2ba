//! What a measurement says of itself: how much it scatters, and whether light may go either way.

use super::direction::{Direction, cosine_direction, through};
use super::hemispheres::Hemispheres;
use super::measured::Measured;
use super::quadrature::{STRATA, quadrature};

/// Pairs of directions that reciprocity is tried on.
const PAIRS: usize = 4096;

/// Shares of light from one direction that scatter into each hemisphere, for each channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Albedo {
    /// Back to the side that it comes from.
    pub reflected: Vec<f64>,
    /// Through to the other side.
    pub transmitted: Vec<f64>,
}

/// How far the luminance of light one way differs from the other way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reciprocity {
    /// Pairs of directions with light in at least one sense.
    pub pairs: usize,
    /// The sum of all differences over the sum of all values.
    pub mean_difference: f64,
    /// The largest difference over the mean of the two.
    pub largest_difference: f64,
}

impl Measured {
    /// Hemispherical reflectance and transmittance of light from `wi`. Exact for matrices; for everything else by a quadrature that resolves
    /// lobes down to about half a degree.
    pub fn albedo(&self, wi: Direction) -> Albedo {
        self.albedo_by(wi, STRATA)
    }

    /// [`Measured::albedo`] by a quadrature of another fineness.
    pub(crate) fn albedo_by(&self, wi: Direction, strata: usize) -> Albedo {
        let count = self.channels().count();
        let mut albedo = Albedo { reflected: vec![0.0; count], transmitted: vec![0.0; count] };
        for pair in Hemispheres::ALL.into_iter().filter(|pair| pair.is_from_front() == (wi[2] > 0.0) && self.has(*pair)) {
            let sum = if pair.is_reflection() { &mut albedo.reflected } else { &mut albedo.transmitted };
            match self {
                Self::Patches(patches) => patches.albedo(pair, wi, sum),
                _ => self.integrate(pair, wi, strata, sum),
            }
        }
        albedo
    }

    /// The integral of BSDF × cosine of `wo` into one hemisphere.
    fn integrate(&self, pair: Hemispheres, wi: Direction, strata: usize, sum: &mut [f64]) {
        let mut values = vec![0.0; sum.len()];
        let up = if wi[2] < 0.0 { through(wi) } else { wi };
        for node in quadrature(up, strata) {
            let is_up = pair.is_from_front() == pair.is_reflection();
            let wo = if is_up { node.direction } else { through(node.direction) };
            self.eval(wi, wo, &mut values);
            let weight = node.solid_angle * node.direction[2] / up[2];
            sum.iter_mut().zip(&values).for_each(|(sum, v)| *sum += weight * v);
        }
    }

    /// How reciprocal the measurement is: for each pair of directions the BSDF one way and the other. None where nothing scatters.
    pub fn reciprocity(&self) -> Option<Reciprocity> {
        let weights = self.channels().luminance_weights();
        let (mut pairs, mut differences, mut total, mut largest) = (0, 0.0, 0.0, 0.0_f64);
        for hemispheres in [Hemispheres::ReflectionFront, Hemispheres::ReflectionBack, Hemispheres::TransmissionFront] {
            if !self.has(hemispheres) || !self.has(hemispheres.reversed()) {
                continue;
            }
            for i in 0..PAIRS {
                let [a, b] = directions(i, hemispheres);
                let one = self.luminance(&weights, a, b) / a[2].abs();
                let other = self.luminance(&weights, b, a) / b[2].abs();
                if one + other > 0.0 {
                    pairs += 1;
                    differences += (one - other).abs();
                    total += 0.5 * (one + other);
                    largest = largest.max((one - other).abs() / (0.5 * (one + other)));
                }
            }
        }
        (pairs > 0).then(|| Reciprocity { pairs, mean_difference: differences / total, largest_difference: largest })
    }
}

/// Two directions of a low-discrepancy sequence (Roberts' R₄), away from the horizon, where a cosine divides.
fn directions(i: usize, hemispheres: Hemispheres) -> [Direction; 2] {
    // Powers of the inverse of the root of x⁵ = x + 1.
    let step = [0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_3];
    let u = step.map(|step| (0.5 + step * (i + 1) as f64).fract());
    let direction = |u: [f64; 2]| cosine_direction([0.95 * u[0], u[1]]);
    let side = |is_up: bool, d: Direction| if is_up { d } else { through(d) };
    let from_front = hemispheres.is_from_front();
    let to_front = from_front == hemispheres.is_reflection();
    [side(from_front, direction([u[0], u[1]])), side(to_front, direction([u[2], u[3]]))]
}
