//! The queue of shadow rays that next event estimation (NEE) sends: `stage/light/nee.rs` fills it, `stage/light/shadow.rs` traces it.

use crate::graph::CHUNK;
use crate::media::set::{MediaColumns, MediaSet};
use crate::state::rays::{RayLanes, Rays};
use crate::state::sample::SampleContext;
use crate::state::times::SlotTimes;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::{counts, ray_mask};
use gonio_accel::RayMask;
use gonio_camera::sampler::CAPACITY;
use gonio_simd::{Column, F, Lanes, M, PADDING, Spectrum, SpectrumColumns, U, padded};

/// Room for shadow rays: one for each path, and one for each subsurface walk that comes out in the same bounce.
pub(crate) const SHADOW_ROOM: usize = padded(2 * CAPACITY) + PADDING;

/// Most hits that are lit together, whole registers: at most a chunk, and as many as have room for their shadow rays.
pub(crate) fn hits_together(shadow_rays_per_hit: usize) -> usize {
    ((SHADOW_ROOM - PADDING) / shadow_rays_per_hit / PADDING * PADDING).clamp(PADDING, CHUNK)
}

/// One register of shadow rays, to be appended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadowLanes<L: Lanes> {
    pub(crate) ray: RayLanes<L>,
    pub(crate) contribution: Spectrum<L>,
    pub(crate) slot: U<L>,
    pub(crate) code: U<L>,
    pub(crate) light: U<L>,
    pub(crate) shares: Option<[Spectrum<L>; 2]>,
    /// Class of the receiver, where the light cache learns.
    pub(crate) receiver: Option<U<L>>,
    pub(crate) along: Along<L>,
}

/// What shadow rays take along from where they start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along<L: Lanes> {
    /// What they start in, where anything absorbs.
    media: Option<MediaSet<L>>,
    /// Surfaces that their paths have gone straight through, where their number is limited.
    straight: Option<U<L>>,
    /// The most that they may bring in the mean of their channels, where that is clamped as they arrive.
    ceiling: Option<F<L>>,
}

impl<L: Lanes> Along<L> {
    /// Of rays that start in these media, on paths with these counts of bounces.
    #[inline(always)]
    pub(crate) fn new(tables: &Tables, transport: &Transport, media: MediaSet<L>, counts: U<L>, ceiling: Option<F<L>>) -> Self {
        let media = if tables.any_absorbing { Some(media) } else { None };
        let limited = tables.any_transparent && transport.limits.counts_straight();
        Self { media, straight: if limited { Some(counts::straight(counts)) } else { None }, ceiling }
    }
}

/// Shadow rays, and the contribution of each if nothing blocks it.
#[derive(Debug)]
pub(crate) struct ShadowRays {
    pub(crate) count: usize,
    /// They start at once, and end short of the light.
    pub(crate) rays: Rays,
    pub(crate) contribution: SpectrumColumns,
    pub(crate) slot: Column<u32>,
    /// The light pass that the contribution counts for, see [`crate::words::code`].
    pub(crate) code: Column<u32>,
    /// The light that each ray leads to.
    pub(crate) light: Column<u32>,
    /// Diffuse and glossy share of contributions at first surfaces; filled where passes of light are wanted.
    pub(crate) shares: [SpectrumColumns; 2],
    /// Classes of receivers; filled where the light cache learns.
    pub(crate) receiver: Column<u32>,
    /// What rays start in; filled where anything absorbs.
    pub(crate) media: MediaColumns,
    /// What tells samples apart that send the same ray; filled where media vary.
    pub(crate) salt: Column<u32>,
    /// Surfaces that paths have gone straight through; filled where anything is transparent and their number is limited.
    pub(crate) straight: Column<u32>,
    /// Most that contributions may come to; filled where they are clamped as they arrive.
    pub(crate) ceiling: Column,
}

impl Default for ShadowRays {
    fn default() -> Self {
        Self::with_mask(ray_mask::SHADOW)
    }
}

impl ShadowRays {
    /// An empty queue of rays with these visibility bits.
    pub(crate) fn with_mask(mask: RayMask) -> Self {
        let room = SHADOW_ROOM;
        Self {
            count: 0,
            rays: Rays::new(room, mask),
            contribution: SpectrumColumns::new(room),
            slot: Column::new(room),
            code: Column::new(room),
            light: Column::new(room),
            shares: [SpectrumColumns::new(room), SpectrumColumns::new(room)],
            receiver: Column::new(room),
            media: MediaColumns::new(room),
            salt: Column::new(room),
            straight: Column::new(room),
            ceiling: Column::new(room),
        }
    }

    /// Gives the rays that are appended next these times, where anything moves: for rays whose slots are no samples'.
    #[inline(always)]
    pub(crate) fn append_time<L: Lanes>(&mut self, time: F<L>, chosen: M<L>, moves: bool) {
        if !moves {
            return self.rays.time.clear();
        }
        self.rays.time.resize(self.rays.t_max.len(), 0.5);
        time.append(chosen, &mut self.rays.time, self.count);
    }

    /// Sets the times of all rays by their slots.
    pub(crate) fn set_times(&mut self, times: &SlotTimes) {
        self.rays.set_times(times.of(self.slot[..self.count].iter().copied()));
    }

    /// Tells the samples of all rays apart by their slots.
    #[inline(always)]
    pub(crate) fn set_salts<L: Lanes>(&mut self, l: L, sample: &SampleContext<'_>) {
        for at in (0..self.count).step_by(L::COUNT) {
            sample.salt(l, l.load_integers(&self.slot, at)).store(&mut self.salt, at);
        }
    }

    /// Whether the shadow rays of some more hits fit into the queue.
    pub(crate) fn has_room(&self, hits: usize, shadow_rays_per_hit: usize) -> bool {
        self.count + hits * shadow_rays_per_hit <= SHADOW_ROOM - PADDING
    }

    /// Holds all contributions within their limits.
    #[inline(always)]
    pub(crate) fn clamp<L: Lanes>(&mut self, l: L) {
        for at in (0..self.count).step_by(L::COUNT) {
            let (value, most) = (self.contribution.load(l, at), l.load(&self.ceiling, at));
            let mean = value.abs().mean();
            let held = value * mean.gt(most).select(most / mean, l.f(1.0));
            self.contribution.store(held, at);
        }
    }

    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, ray: &ShadowLanes<L>, chosen: M<L>) {
        let n = self.count;
        self.rays.append(&ray.ray, chosen, n);
        self.contribution.append(ray.contribution, chosen, n);
        ray.slot.append(chosen, &mut self.slot, n);
        ray.code.append(chosen, &mut self.code, n);
        ray.light.append(chosen, &mut self.light, n);
        if let Some(shares) = ray.shares {
            self.shares[0].append(shares[0], chosen, n);
            self.shares[1].append(shares[1], chosen, n);
        }
        if let Some(receiver) = ray.receiver {
            receiver.append(chosen, &mut self.receiver, n);
        }
        if let Some(media) = ray.along.media {
            self.media.append(media, chosen, n);
        }
        if let Some(straight) = ray.along.straight {
            straight.append(chosen, &mut self.straight, n);
        }
        if let Some(ceiling) = ray.along.ceiling {
            ceiling.append(chosen, &mut self.ceiling, n);
        }
        self.count += chosen.count();
    }
}
