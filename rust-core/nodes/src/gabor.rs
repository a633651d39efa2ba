//! Blender's Gabor Texture: a sum of waves in Gaussian windows, eight at random places in each cell of a grid.
//!
//! Lagae et al., Procedural Noise using Sparse Gabor Convolution, ACM TOG 28(3), 2009; Tavernier et al., Making Gabor Noise Fast and Normalized,
//! Eurographics 2019; Tricard et al., Procedural Phasor Noise, ACM TOG 38(4), 2019.

use crate::finite::all_finite;
use crate::hash::{hash3, hash4, to_unit};
use core::f32::consts::{PI, SQRT_2};
use gonio_simd::{F, Lanes, U};
use serde::{Deserialize, Serialize};

/// The texture's settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct GaborTexture {
    /// 2 for x and y, 3 for all.
    pub dimensions: u8,
}

/// Waves in a cell.
const WAVES: usize = 8;

/// The inputs that all waves share.
#[derive(Clone, Copy, Debug)]
struct Waves<L: Lanes, const D: usize> {
    frequency: F<L>,
    isotropy: F<L>,
    /// The wave's direction without isotropy.
    direction: [F<L>; D],
    /// Its angles: one in the plane, inclination and azimuth in space.
    angles: [F<L>; 2],
}

/// The cell and what tells its numbers apart, hashed.
#[inline(always)]
fn random<L: Lanes, const D: usize>(l: L, cell: [U<L>; D], number: U<L>) -> F<L> {
    to_unit(match D {
        2 => hash3(l, cell[0], cell[1], number),
        _ => hash4(l, cell[0], cell[1], cell[2], number),
    })
}

/// A second random number by the same seed.
#[inline(always)]
fn second<L: Lanes, const D: usize>(l: L, cell: [U<L>; D], number: U<L>) -> F<L> {
    to_unit(match D {
        2 => hash3(l, number, cell[0], cell[1]),
        _ => hash4(l, cell[2], cell[0], number, cell[1]),
    })
}

/// A number of the wave as a seed.
#[inline(always)]
fn seed<L: Lanes>(l: L, wave: usize, purpose: usize) -> U<L> {
    l.u(((wave * 3 + purpose) as f32).to_bits())
}

/// Where a wave stands in its cell.
#[inline(always)]
fn centre<L: Lanes, const D: usize>(l: L, cell: [U<L>; D], wave: usize) -> [F<L>; D] {
    let number = seed(l, wave, 1);
    let mut centre = [random(l, cell, number); D];
    centre[1] = second(l, cell, number);
    if D > 2 {
        centre[D - 1] = to_unit(hash4(l, number, cell[D - 1], cell[1], cell[0]));
    }
    centre
}

impl<L: Lanes, const D: usize> Waves<L, D> {
    /// The direction of a wave: the base turned by random angles of at most half a turn.
    #[inline(always)]
    fn direction(&self, l: L, cell: [U<L>; D], wave: usize) -> [F<L>; D] {
        if !self.isotropy.gt(0.0).any() {
            return self.direction;
        }
        let number = seed(l, wave, 0);
        let mut direction = self.direction;
        if D == 2 {
            let (sin, cos) = ((random(l, cell, number) - 0.5) * PI).mul_add(self.isotropy, self.angles[0]).sin_cos();
            [direction[0], direction[1]] = [cos, sin];
        } else {
            let (sin, cos) = (random(l, cell, number) * PI).mul_add(self.isotropy, self.angles[0]).sin_cos();
            let (across, along) = (second(l, cell, number) * PI).mul_add(self.isotropy, self.angles[1]).sin_cos();
            for (axis, turned) in [sin * along, sin * across, cos].into_iter().enumerate().take(D) {
                direction[axis] = self.isotropy.gt(0.0).select(turned, direction[axis]);
            }
        }
        direction
    }

    /// The waves of a cell at a place relative to its corner, as real and imaginary parts.
    #[inline(always)]
    fn of_cell(&self, l: L, cell: [U<L>; D], at: [F<L>; D], sum: &mut [F<L>; 2]) {
        for wave in 0..WAVES {
            let mut place = centre(l, cell, wave);
            let mut squared = l.f(0.0);
            for axis in 0..D {
                place[axis] = at[axis] - place[axis];
                squared = place[axis].mul_add(place[axis], squared);
            }
            let inside = squared.lt(1.0);
            if !inside.any() {
                continue;
            }
            let direction = self.direction(l, cell, wave);
            let mut turns = l.f(0.0);
            for axis in 0..D {
                turns = (direction[axis] * self.frequency).mul_add(place[axis], turns);
            }
            // A Gaussian in a Hann window, which ends it smoothly.
            let window = (squared * 0.5).sin_cos_turns().1.mul_add(0.5, 0.5) * (squared * -PI).exp();
            let negative = random(l, cell, seed(l, wave, 2)).lt(0.5);
            let weight = negative.select(-window, window).keep_if(inside);
            let (sin, cos) = turns.sin_cos_turns();
            sum[0] += cos * weight;
            sum[1] += sin * weight;
        }
    }

    /// The sum over the 3^D cells around.
    #[inline(always)]
    fn around(&self, l: L, at: [F<L>; D]) -> [F<L>; 2] {
        let mut sum = [l.f(0.0); 2];
        for number in 0..3_usize.pow(D as u32) {
            let (mut cell, mut place, mut rest) = ([l.u(0); D], at, number);
            for axis in 0..D {
                let offset = (rest % 3) as f32 - 1.0;
                rest /= 3;
                let corner = at[axis].floor();
                cell[axis] = (corner + offset).to_bits();
                place[axis] = at[axis] - corner - offset;
            }
            self.of_cell(l, cell, place, &mut sum);
        }
        sum
    }
}

impl GaborTexture {
    /// The inputs of [`evaluate`](Self::evaluate), in order; the angle counts in two dimensions, the direction in three.
    pub const INPUTS: [&str; 10] =
        ["x", "y", "z", "scale", "frequency", "anisotropy", "angle", "direction_x", "direction_y", "direction_z"];
    /// How many outputs there are.
    pub const OUTPUTS: usize = 3;

    /// Value, phase and intensity.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 10]) -> [F<L>; 3] {
        let [x, y, z, scale, frequency, anisotropy, angle, direction_x, direction_y, direction_z] = *inputs;
        let (x, y, z) = (x * scale, y * scale, z * scale);
        let (frequency, isotropy) = (frequency.max(0.001), 1.0 - anisotropy.saturate());
        let ([real, imaginary], deviation) = match self.dimensions {
            2 => (flat(l, [x, y], frequency, isotropy, angle), 1.0),
            _ => (solid(l, [x, y, z], frequency, isotropy, [direction_x, direction_y, direction_z]), SQRT_2.recip().sqrt()),
        };
        let most = 6.0 * deviation;
        let value = (imaginary / most).mul_add(0.5, 0.5);
        let phase = (imaginary.atan2(real) + PI) / (2.0 * PI);
        let intensity = (real * real + imaginary * imaginary).sqrt() / most;
        all_finite([value, phase, intensity])
    }
}

/// The sum in the plane; a function of its own, so that callers do not each carry it.
#[inline(always)]
fn flat<L: Lanes>(l: L, at: [F<L>; 2], frequency: F<L>, isotropy: F<L>, angle: F<L>) -> [F<L>; 2] {
    l.vectorize(
        #[inline(always)]
        || {
            let (sin, cos) = angle.sin_cos();
            Waves { frequency, isotropy, direction: [cos, sin], angles: [angle, angle] }.around(l, at)
        },
    )
}

/// The sum in space.
#[inline(always)]
fn solid<L: Lanes>(l: L, at: [F<L>; 3], frequency: F<L>, isotropy: F<L>, [x, y, z]: [F<L>; 3]) -> [F<L>; 2] {
    l.vectorize(
        #[inline(always)]
        || {
            let length = (x * x + y * y + z * z).sqrt();
            let (x, y, z) = (x / length, y / length, z / length);
            let across = (x * x + y * y).sqrt();
            // Upright, any azimuth will do.
            let azimuth = across.gt(0.0).select(x / across, l.f(1.0)).acos();
            let azimuth = y.lt(0.0).select(-azimuth, azimuth);
            Waves { frequency, isotropy, direction: [x, y, z], angles: [z.acos(), azimuth] }.around(l, at)
        },
    )
}
