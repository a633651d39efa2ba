//! Sizes of a batch of paths.

use gonio_simd::{Lanes, U};

/// Pixels along a tile's side.
pub const TILE: usize = 64;
/// Pixels of a tile: the paths that start together.
pub const BATCH: usize = TILE * TILE;
/// Paths under way at once: each pixel's own, which a shadow catcher splits in two, and the one that measures its illuminance.
pub const CAPACITY: usize = 3 * BATCH;
/// The pixel's Morton number in a slot of any kind of path.
#[inline(always)]
pub fn pixel<L: Lanes>(slot: U<L>) -> U<L> {
    slot & (BATCH as u32 - 1)
}
