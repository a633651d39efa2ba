//! Optical depth along shadow rays, which pass surfaces: segment by segment, from where they enter media to where they leave them.

use super::set::{MediaColumns, MediaSet};
use crate::tables::media::MediumTable;
use gonio_accel::TransparentHit;
use gonio_simd::{Column, Lanes, One, Spectrum, SpectrumColumns};

/// Where a ray passes the surface of what a medium fills.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    ray: u32,
    t: f32,
    row: u32,
    entering: bool,
}

/// By shadow ray; used where anything absorbs.
#[derive(Debug)]
pub struct OpticalDepth {
    crossings: Vec<Crossing>,
    depth: SpectrumColumns,
}

impl OpticalDepth {
    /// Room for so many rays.
    pub fn new(room: usize) -> Self {
        Self { crossings: Vec::new(), depth: SpectrumColumns::new(room) }
    }

    /// Begins with rays that have passed nothing.
    pub fn clear(&mut self) {
        self.crossings.clear();
    }

    /// Adds hits on the surface of what a row of the table fills; `sides` are 1 where rays enter it, else -1.
    pub fn add(&mut self, row: u32, hits: &[TransparentHit], sides: &Column) {
        let crossings = hits.iter().zip(&sides[..]);
        self.crossings.extend(crossings.map(|(hit, side)| Crossing { ray: hit.ray, t: hit.t, row, entering: *side > 0.0 }));
    }

    /// Adds up the depths of the first `count` rays, which start in `media` and end at these distances.
    #[inline(always)]
    pub fn add_up<L: Lanes>(&mut self, l: L, table: &MediumTable, media: &MediaColumns, ends: &[f32], count: usize) {
        for at in (0..count).step_by(L::COUNT) {
            self.depth.store(media.load(l, at).optical_depth(table, l.load(ends, at)), at);
        }
        // Whatever order surfaces come in.
        self.crossings
            .sort_unstable_by(|a, b| a.ray.cmp(&b.ray).then(a.t.total_cmp(&b.t)).then((a.row, a.entering).cmp(&(b.row, b.entering))));
        for of_ray in self.crossings.chunk_by(|a, b| a.ray == b.ray) {
            let ray = of_ray[0].ray as usize;
            self.depth.store(along(table, media.load(One, ray), of_ray, ends[ray]), ray);
        }
    }

    /// What is left of light along a register of rays, from the one at `at` on.
    #[inline(always)]
    pub fn transmittance<L: Lanes>(&self, l: L, at: usize) -> Spectrum<L> {
        (self.depth.load(l, at) * l.f(-1.0)).exp()
    }
}

/// Optical depth of a ray that starts in some media.
fn along(table: &MediumTable, mut media: MediaSet<One>, crossings: &[Crossing], end: f32) -> Spectrum<One> {
    let (mut depth, mut start) = (Spectrum::zero(One), 0.0);
    for Crossing { t, row, entering, .. } in crossings {
        depth += media.extinction(table) * One.f(t - start);
        media = if *entering { media.entered(*row, One.m(true)) } else { media.left(*row, One.m(true)) };
        start = *t;
    }
    depth + media.optical_depth(table, One.f(end - start))
}
