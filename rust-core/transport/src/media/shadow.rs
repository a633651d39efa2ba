//! Transmittance of shadow rays, which pass surfaces: optical depth, summed up by where they enter media and leave them.
//!
//! Between two surfaces a ray is in what it has entered and not left. So each surface counts once, by its distance, whatever order it comes in.

use super::set::{FAR, MediaColumns, RESIDUE};
use crate::tables::media::MediumTable;
use gonio_accel::TransparentHit;
use gonio_simd::{Column, Lanes, PADDING, Spectrum, SpectrumColumns};

/// By shadow ray; used where anything fills meshes.
#[derive(Debug)]
pub struct OpticalDepth {
    depth: SpectrumColumns,
    /// Extinction a metre where the ray ends.
    around: SpectrumColumns,
    /// That of one medium.
    one: SpectrumColumns,
}

impl OpticalDepth {
    /// Room for so many rays.
    pub fn new(room: usize) -> Self {
        Self { depth: SpectrumColumns::new(room), around: SpectrumColumns::new(room), one: SpectrumColumns::new(PADDING) }
    }

    /// Begins the sums of so many rays with what they start in.
    #[inline(always)]
    pub fn begin<L: Lanes>(&mut self, l: L, media: &MediaColumns, count: usize) {
        for at in (0..count).step_by(L::COUNT) {
            self.depth.store(Spectrum::zero(l), at);
            self.around.store(media.extinction().load(l, at), at);
        }
    }

    /// Adds hits on the surface of what a medium fills; `sides` are 1 where rays enter it, else -1.
    #[inline(always)]
    pub fn add<L: Lanes>(&mut self, l: L, (media, row): (&MediumTable, u32), hits: &[TransparentHit], sides: &Column) {
        self.one.store(media.absorption(l, row), 0);
        for (hit, side) in hits.iter().zip(&sides[..]) {
            self.depth.add(hit.ray as usize, &self.one, 0, -side * hit.t);
            self.around.add(hit.ray as usize, &self.one, 0, *side);
        }
    }

    /// What is left of light along a register of rays, from the one at `at` on, which end at these distances.
    #[inline(always)]
    pub fn transmittance<L: Lanes>(&self, l: L, ends: &[f32], at: usize) -> Spectrum<L> {
        let end = l.load(ends, at);
        let around = self.around.load(l, at);
        // Rounding must not darken what comes from infinitely far away.
        let around = end.lt(FAR).select(around, around - Spectrum::constant(l.f(RESIDUE)));
        let depth = self.depth.load(l, at) + around.max(0.0) * end.min(FAR);
        (depth.max(0.0) * l.f(-1.0)).exp()
    }
}
