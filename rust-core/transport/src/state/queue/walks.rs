//! Subsurface random walks under way: started by `stage/shade/scatter.rs`, taken step by step in `stage/walk/subsurface.rs`.

use crate::state::path_core::PathCore;
use crate::state::paths::Paths;
use crate::state::rays::{RayLanes, Rays};
use crate::state::times::SlotTimes;
use crate::words::ray_mask;
use gonio_accel::Hits;
use gonio_bsdf::subsurface::WalkMedium;
use gonio_camera::sampler::CAPACITY;
use gonio_simd::{Column, Lanes, M, PADDING, SpectrumColumns, U, padded};

/// Walks under way, a column entry each.
#[derive(Debug)]
pub(crate) struct Walks {
    pub(crate) count: usize,
    /// Rays of the flights. Hits nearer than `t_min` are the surface that was entered: walks start on it, as an offset would count as depth.
    /// A flight ends at `t_max`.
    pub(crate) rays: Rays,
    pub(crate) throughput: SpectrumColumns,
    pub(crate) albedo: SpectrumColumns,
    pub(crate) extinction: SpectrumColumns,
    pub(crate) anisotropy: Column,
    /// Probabilities of the components by which the flight was sampled.
    pub(crate) channels: SpectrumColumns,
    /// The path that entered.
    pub(crate) path: Column<u32>,
    pub(crate) instance: Column<u32>,
    pub(crate) slot: Column<u32>,
    pub(crate) flags: Column<u32>,
    pub(crate) counts: Column<u32>,
    pub(crate) width: Column,
}

impl Default for Walks {
    fn default() -> Self {
        let room = padded(CAPACITY) + PADDING;
        let spectra = || SpectrumColumns::new(room);
        Self {
            count: 0,
            rays: Rays::new(room, ray_mask::SHADOW),
            throughput: spectra(),
            albedo: spectra(),
            extinction: spectra(),
            anisotropy: Column::new(room),
            channels: spectra(),
            path: Column::new(room),
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
    /// The flight under way.
    pub(crate) ray: RayLanes<L>,
    /// What the path carries; what does not change inside is looked up where it comes out, by [`Self::path`].
    pub(crate) core: PathCore<L>,
    pub(crate) medium: WalkMedium<L>,
    pub(crate) path: U<L>,
    pub(crate) instance: U<L>,
}

impl Walks {
    /// Sets the times of all flights by their slots.
    pub(crate) fn set_times(&mut self, times: &SlotTimes) {
        self.rays.set_times(times.of(self.slot[..self.count].iter().copied()));
    }

    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, w: &WalkLanes<L>, chosen: M<L>) {
        let n = self.count;
        self.rays.append(&w.ray, chosen, n);
        self.throughput.append(w.core.throughput, chosen, n);
        self.albedo.append(w.medium.albedo, chosen, n);
        self.extinction.append(w.medium.extinction, chosen, n);
        w.medium.anisotropy.append(chosen, &mut self.anisotropy, n);
        w.path.append(chosen, &mut self.path, n);
        w.instance.append(chosen, &mut self.instance, n);
        w.core.slot.append(chosen, &mut self.slot, n);
        w.core.flags.append(chosen, &mut self.flags, n);
        w.core.counts.append(chosen, &mut self.counts, n);
        w.core.width.append(chosen, &mut self.width, n);
        self.count += chosen.count();
    }

    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, l: L, at: usize) -> WalkLanes<L> {
        WalkLanes {
            ray: self.rays.load(l, at),
            core: PathCore {
                throughput: self.throughput.load(l, at),
                counts: l.load_integers(&self.counts, at),
                width: l.load(&self.width, at),
                ..PathCore::new(l, l.load_integers(&self.slot, at), l.load_integers(&self.flags, at))
            },
            medium: WalkMedium {
                albedo: self.albedo.load(l, at),
                extinction: self.extinction.load(l, at),
                anisotropy: l.load(&self.anisotropy, at),
            },
            path: l.load_integers(&self.path, at),
            instance: l.load_integers(&self.instance, at),
        }
    }

    /// What the paths carry whose walks come out: what has changed inside is theirs, the rest is that of the `paths` that entered.
    #[inline(always)]
    pub(crate) fn core<L: Lanes>(&self, l: L, walk: U<L>, paths: &Paths, any_absorbing: bool) -> PathCore<L> {
        let path = l.gather_integers(&self.path, walk);
        let mut core = PathCore {
            throughput: self.throughput.gather(l, walk),
            counts: l.gather_integers(&self.counts, walk),
            width: l.gather(&self.width, walk),
            unguided: paths.unguided(l, path),
            ..PathCore::new(l, l.gather_integers(&self.slot, walk), l.gather_integers(&self.flags, walk))
        };
        if any_absorbing {
            core.media = paths.media.gather(l, path);
        }
        core
    }
}
