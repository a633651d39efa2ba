//! Blender's Magic Texture.

use crate::finite::finite;
use crate::periodic::{cosine, remainder, sine};
use core::f32::consts::TAU;
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// The deepest turbulence.
const MOST_DEPTH: u8 = 10;

/// Waves in three channels, each bending the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MagicTexture {
    /// How often the channels bend each other, at most ten times.
    pub depth: u8,
}

impl MagicTexture {
    /// The inputs' names.
    pub const INPUTS: [&str; 5] = ["x", "y", "z", "scale", "distortion"];
    /// The channels' mean, red, green and blue.
    pub const OUTPUTS: usize = 4;

    /// Value and colour at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, _: L, [x, y, z, scale, distortion]: &[F<L>; 5]) -> [F<L>; 4] {
        let [x, y, z] = [remainder(*x, TAU), remainder(*y, TAU), remainder(*z, TAU)];
        let mut channels = [sine((x + y + z) * 5.0 * *scale), cosine((y - x - z) * 5.0 * *scale), -cosine((z - (x + y)) * 5.0 * *scale)];
        if self.depth > 0 {
            for channel in &mut channels {
                *channel *= *distortion;
            }
        }
        for step in 1..=self.depth.min(MOST_DEPTH) {
            let (channel, value) = bent(channels, step);
            channels[channel] = value * *distortion;
        }
        let flat = distortion.eq(0.0);
        let mut color = [x; 3];
        for (out, channel) in color.iter_mut().zip(channels) {
            *out = finite(0.5 - flat.select(channel, channel / (*distortion * 2.0)));
        }
        let [red, green, blue] = color;
        [finite((red + green + blue) * (1.0 / 3.0)), red, green, blue]
    }
}

/// The channel that a step changes, and what it becomes before it is distorted.
#[inline(always)]
fn bent<L: Lanes>([x, y, z]: [F<L>; 3], step: u8) -> (usize, F<L>) {
    match step {
        1 => (1, -cosine(x - y + z)),
        2 => (0, cosine(x - y - z)),
        3 => (2, sine(-x - y - z)),
        4 => (0, -cosine(y - x - z)),
        5 => (1, -sine(y - x + z)),
        6 => (1, -cosine(y - x + z)),
        7 => (0, cosine(x + y + z)),
        8 => (2, sine(x + y - z)),
        9 => (0, -cosine(z - (x + y))),
        _ => (1, -sine(x - y + z)),
    }
}
