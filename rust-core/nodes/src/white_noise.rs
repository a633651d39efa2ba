//! Blender's White Noise Texture.

use crate::hash::{hash1, hash2, hash3, hash4, to_unit};
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// A random number for each point in one to four dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WhiteNoise {
    /// From 1 (`w` alone) to 4; 2 takes `x` and `y`.
    pub dimensions: u8,
    /// Whether green and blue are wanted; if not, they are the value as well.
    pub color: bool,
}

impl WhiteNoise {
    /// The inputs' names.
    pub const INPUTS: [&str; 4] = ["x", "y", "z", "w"];
    /// Value, red (the same), green and blue.
    pub const OUTPUTS: usize = 4;

    /// Value and colour at the points.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, [x, y, z, w]: &[F<L>; 4]) -> [F<L>; 4] {
        let [x, y, z, w] = [x.to_bits(), y.to_bits(), z.to_bits(), w.to_bits()];
        let [first, second] = [l.u(1.0f32.to_bits()), l.u(2.0f32.to_bits())];
        let red = to_unit(match self.dimensions {
            1 => hash1(l, w),
            2 => hash2(l, x, y),
            3 => hash3(l, x, y, z),
            _ => hash4(l, x, y, z, w),
        });
        if !self.color {
            return [red; 4];
        }
        // One more word, but in four dimensions the words in other orders.
        let (green, blue) = match self.dimensions {
            1 => (hash2(l, w, first), hash2(l, w, second)),
            2 => (hash3(l, x, y, first), hash3(l, x, y, second)),
            3 => (hash4(l, x, y, z, first), hash4(l, x, y, z, second)),
            _ => (hash4(l, z, x, w, y), hash4(l, w, z, y, x)),
        };
        [red, red, to_unit(green), to_unit(blue)]
    }
}
