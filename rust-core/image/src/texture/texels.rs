//! Where a lookup's texels come from: a pyramid in memory, or tiles.

use super::paged::{PagedTexels, TileReader};
use super::texel::{Rgba, Texel};
use gonio_simd::{F, Lanes, M, U};
use std::sync::Arc;

/// The levels that lanes read from.
#[derive(Clone, Copy)]
pub(crate) struct Level<L: Lanes> {
    pub(crate) number: U<L>,
    pub(crate) width: F<L>,
    pub(crate) height: F<L>,
    /// The level's first texel.
    pub(crate) offset: U<L>,
}

/// The two columns and the two rows of texels that lanes mix.
pub(crate) struct Quad<L: Lanes> {
    pub(crate) x: [U<L>; 2],
    pub(crate) y: [U<L>; 2],
}

/// Gives the texels of lookups. [`Texels::prepare`] comes first, then the same places are read.
pub(crate) trait Texels<L: Lanes> {
    /// Has the texels of a quad at hand in the lanes of `wanted`.
    fn prepare(&mut self, level: &Level<L>, quad: &Quad<L>, wanted: M<L>);
    /// The first texel of the quad.
    fn one<T: Texel>(&self, l: L, table: &[f32; 256], level: &Level<L>, x: U<L>, y: U<L>) -> Rgba<L>;
    /// The two texels of a row of the quad; `adjacent` where they lie side by side in all lanes.
    fn pair<T: Texel>(&self, l: L, table: &[f32; 256], level: &Level<L>, row: (usize, U<L>), x: [U<L>; 2], adjacent: bool) -> [Rgba<L>; 2];
}

/// All texels, level by level.
pub(crate) struct InMemory<'a> {
    pub(crate) words: &'a [f32],
}

impl<L: Lanes> Texels<L> for InMemory<'_> {
    #[inline(always)]
    fn prepare(&mut self, _: &Level<L>, _: &Quad<L>, _: M<L>) {}
    #[inline(always)]
    fn one<T: Texel>(&self, l: L, table: &[f32; 256], level: &Level<L>, x: U<L>, y: U<L>) -> Rgba<L> {
        T::one(l, self.words, table, y * level.width.to_i32() + level.offset + x)
    }
    #[inline(always)]
    fn pair<T: Texel>(&self, l: L, table: &[f32; 256], level: &Level<L>, row: (usize, U<L>), x: [U<L>; 2], adjacent: bool) -> [Rgba<L>; 2] {
        let start = row.1 * level.width.to_i32() + level.offset;
        let [a, mut b] = T::pair(l, self.words, table, start + x[0]);
        // Only at the image's edge is the right neighbour not the next texel.
        if !adjacent {
            b = T::one(l, self.words, table, start + x[1]);
        }
        [a, b]
    }
}

/// Tiles, of which a reader gathers the texels that are wanted: four a lane, one after the other.
pub(crate) struct InTiles<'a> {
    pub(crate) paged: &'a Arc<PagedTexels>,
    pub(crate) reader: &'a mut TileReader,
}

impl<L: Lanes> Texels<L> for InTiles<'_> {
    #[inline(always)]
    fn prepare(&mut self, level: &Level<L>, quad: &Quad<L>, wanted: M<L>) {
        let (number, [x, right], [y, below]) = (level.number.to_array(), quad.x, quad.y);
        let (low, high) = ([x.to_array(), y.to_array()], [right.to_array(), below.to_array()]);
        self.reader.fetch(self.paged, wanted.bits(), &number, [&low[0], &low[1]], [&high[0], &high[1]]);
    }
    #[inline(always)]
    fn one<T: Texel>(&self, l: L, table: &[f32; 256], _: &Level<L>, _: U<L>, _: U<L>) -> Rgba<L> {
        T::one(l, &self.reader.texels[..], table, l.iota() << 2)
    }
    #[inline(always)]
    fn pair<T: Texel>(&self, l: L, table: &[f32; 256], _: &Level<L>, row: (usize, U<L>), _: [U<L>; 2], _: bool) -> [Rgba<L>; 2] {
        T::pair(l, &self.reader.texels[..], table, (l.iota() << 2) + 2 * row.0 as u32)
    }
}
