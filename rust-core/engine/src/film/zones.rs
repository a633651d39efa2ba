//! Zones of a tile: what adaptive sampling goes on with or leaves.

use crate::camera::sampler::TILE;

/// Pixels along the side of a zone: what adaptive sampling goes on with or leaves.
pub const ZONE: usize = 8;
/// Zones of a tile, and pixels of a zone: those whose Morton numbers differ in the last six bits.
pub const ZONES: usize = (TILE / ZONE) * (TILE / ZONE);

/// The zone of a pixel by its Morton number.
#[inline]
pub fn zone_of(code: usize) -> usize {
    code / (ZONE * ZONE)
}
