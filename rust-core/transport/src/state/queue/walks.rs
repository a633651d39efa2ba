//! Subsurface random walks under way: started by `stage/scatter.rs`, taken step by step in `stage/subsurface.rs`.

use crate::state::columns::{Columns3, append3, columns3, load3};
use crate::state::rays::Rays;
use crate::tables::ray_mask;
use gonio_accel::Hits;
use gonio_bsdf::subsurface::Medium;
use gonio_camera::sampler::CAPACITY;
use gonio_simd::{Column, F, Lanes, M, PADDING, Rgb, U, Vec3, padded};

/// Walks under way, a column entry each.
#[derive(Debug)]
pub(crate) struct Walks {
    pub(crate) count: usize,
    /// Rays of the flights. Hits nearer than `t_min` are the surface that was entered: walks start on it, as an offset would count as depth.
    /// A flight ends at `t_max`.
    pub(crate) rays: Rays,
    pub(crate) throughput: Columns3,
    pub(crate) albedo: Columns3,
    pub(crate) extinction: Columns3,
    pub(crate) anisotropy: Column,
    /// Probabilities of the colour channels by which the flight was sampled.
    pub(crate) channels: Columns3,
    pub(crate) instance: Column<u32>,
    pub(crate) slot: Column<u32>,
    pub(crate) flags: Column<u32>,
    pub(crate) counts: Column<u32>,
    pub(crate) width: Column,
}

impl Default for Walks {
    fn default() -> Self {
        let room = padded(CAPACITY) + PADDING;
        let three = || columns3(room);
        Self {
            count: 0,
            rays: Rays::new(room, ray_mask::SHADOW),
            throughput: three(),
            albedo: three(),
            extinction: three(),
            anisotropy: Column::new(room),
            channels: three(),
            instance: Column::new(room),
            slot: Column::new(room),
            flags: Column::new(room),
            counts: Column::new(room),
            width: Column::new(room),
        }
    }
}

/// What a step's flights met.
#[derive(Debug, Default)]
pub(crate) struct WalkHits {
    pub(crate) hits: Hits,
    /// Walks that reached the surface.
    pub(crate) out: Vec<u32>,
}

/// One register of walks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WalkLanes<L: Lanes> {
    pub(crate) origin: Vec3<L>,
    pub(crate) direction: Vec3<L>,
    pub(crate) t_min: F<L>,
    pub(crate) throughput: Rgb<L>,
    pub(crate) medium: Medium<L>,
    pub(crate) instance: U<L>,
    pub(crate) slot: U<L>,
    pub(crate) flags: U<L>,
    pub(crate) counts: U<L>,
    pub(crate) width: F<L>,
}

impl Walks {
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, w: &WalkLanes<L>, chosen: M<L>) {
        let n = self.count;
        self.rays.append(w.origin, w.direction, chosen, n);
        w.t_min.append(chosen, &mut self.rays.t_min, n);
        append3(w.throughput.into(), chosen, &mut self.throughput, n);
        append3(w.medium.albedo.into(), chosen, &mut self.albedo, n);
        append3(w.medium.extinction.into(), chosen, &mut self.extinction, n);
        w.medium.anisotropy.append(chosen, &mut self.anisotropy, n);
        w.instance.append(chosen, &mut self.instance, n);
        w.slot.append(chosen, &mut self.slot, n);
        w.flags.append(chosen, &mut self.flags, n);
        w.counts.append(chosen, &mut self.counts, n);
        w.width.append(chosen, &mut self.width, n);
        self.count += chosen.count();
    }

    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, l: L, at: usize) -> WalkLanes<L> {
        WalkLanes {
            origin: load3(l, &self.rays.origin, at),
            direction: load3(l, &self.rays.direction, at),
            t_min: l.load(&self.rays.t_min, at),
            throughput: load3(l, &self.throughput, at).into(),
            medium: Medium {
                albedo: load3(l, &self.albedo, at).into(),
                extinction: load3(l, &self.extinction, at).into(),
                anisotropy: l.load(&self.anisotropy, at),
            },
            instance: l.load_integers(&self.instance, at),
            slot: l.load_integers(&self.slot, at),
            flags: l.load_integers(&self.flags, at),
            counts: l.load_integers(&self.counts, at),
            width: l.load(&self.width, at),
        }
    }
}
