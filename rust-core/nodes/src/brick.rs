//! Blender's Brick Texture: rows of bricks with mortar between.

use crate::finite::all_finite;
use gonio_simd::{F, Lanes, M, U};
use serde::{Deserialize, Serialize};

/// The texture's settings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrickTexture {
    /// How far the rows named by `offset_frequency` are moved, in bricks.
    pub offset: f32,
    /// One of how many rows is moved; 0 for none, and for no squashing either.
    pub offset_frequency: u32,
    /// How much wider the bricks of squashed rows are.
    pub squash: f32,
    /// Of how many rows all but one keep their width; 0 for none, and for no offset either.
    pub squash_frequency: u32,
}

/// Whether a whole number is a multiple of another.
#[inline(always)]
fn is_multiple<L: Lanes>(number: F<L>, of: u32) -> M<L> {
    let of = of as f32;
    ((number / of).floor() * of).eq(number)
}

/// Noise of an integer, in [0, 1).
#[inline(always)]
fn integer_noise<L: Lanes>(n: U<L>) -> F<L> {
    let n = (n + 1013) & 0x7fff_ffff;
    let n = (n >> 13) ^ n;
    let mixed = (n * (n * n * 60_493 + 19_990_303) + 1_376_312_589) & 0x7fff_ffff;
    mixed.i32_to_float() * (0.5 / 1_073_741_824.0)
}

impl BrickTexture {
    /// The inputs of [`evaluate`](Self::evaluate), in order.
    pub const INPUTS: [&str; 8] = ["x", "y", "scale", "mortar_size", "mortar_smooth", "bias", "brick_width", "row_height"];
    /// How many outputs there are.
    pub const OUTPUTS: usize = 2;

    /// The tint, by which a brick goes from the first colour to the second, and the share of mortar, which Cycles gives as the factor. The colour
    /// is first, mixed with second by tint, mixed with mortar by the factor.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 8]) -> [F<L>; 2] {
        let [x, y, scale, mortar_size, mortar_smooth, bias, brick_width, row_height] = *inputs;
        let (x, y) = (x * scale, y * scale);
        let row = (y / row_height).floor();
        let (mut width, mut offset) = (brick_width, l.f(0.0));
        if self.offset_frequency > 0 && self.squash_frequency > 0 {
            width = is_multiple(row, self.squash_frequency).select(width * self.squash, width);
            offset = (width * self.offset).keep_if(is_multiple(row, self.offset_frequency));
        }
        let brick = ((x + offset) / width).floor();
        let (along, up) = ((x + offset) - width * brick, y - row_height * row);
        let tint = (integer_noise((row.to_i32() << 16) + (brick.to_i32() & 0xffff)) + bias).saturate();
        let inside = along.min(up).min((width - along).min(row_height - up));
        let t = ((1.0 - inside / mortar_size) / mortar_smooth).saturate();
        let soft = mortar_smooth.eq(0.0).select(l.f(1.0), t * t * (3.0 - t * 2.0));
        all_finite([tint, soft.keep_if(!inside.ge(mortar_size))])
    }
}
