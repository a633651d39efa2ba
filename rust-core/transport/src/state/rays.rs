//! Rays in columns, as the TLAS takes them (pbrt's ray queues). Paths, walks and shadow rays own theirs; sorting and retracing copy some.

use crate::state::columns::{Columns3, append3, columns3, load3};
use crate::state::passed::PassedHits;
use gonio_accel::{RayBatch, RayMask};
use gonio_simd::{Column, F, Lanes, M, U, Vec3};
use std::ops::Range;

/// One register of rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayLanes<L: Lanes> {
    pub(crate) origin: Vec3<L>,
    pub(crate) direction: Vec3<L>,
    /// The ray sees points beyond this distance, metres.
    pub(crate) t_min: F<L>,
    /// And up to this one.
    pub(crate) t_max: F<L>,
}

impl<L: Lanes> RayLanes<L> {
    /// The chosen rays of others, else these.
    #[inline(always)]
    pub(crate) fn or(&self, chosen: M<L>, others: &Self) -> Self {
        Self {
            origin: chosen.select(others.origin, self.origin),
            direction: chosen.select(others.direction, self.direction),
            t_min: chosen.select(others.t_min, self.t_min),
            t_max: chosen.select(others.t_max, self.t_max),
        }
    }
}

/// Rays, an entry each; whoever owns them keeps their number.
#[derive(Debug)]
pub struct Rays {
    /// Where they start, rebased world space.
    pub origin: Columns3,
    /// Unit directions.
    pub direction: Columns3,
    pub(crate) t_min: Column,
    pub(crate) t_max: Column,
    /// Visibility bits, see [`crate::words::ray_mask`].
    pub(crate) mask: Vec<RayMask>,
    /// Times of the shutter; empty where nothing moves.
    pub(crate) time: Vec<f32>,
    /// What they have passed; of paths alone.
    pub(crate) passed: PassedHits,
}

impl Rays {
    /// Room for some rays; they start at once, and have these visibility bits until they get others.
    pub(crate) fn new(room: usize, mask: RayMask) -> Self {
        let (t_min, t_max) = (Column::new(room), Column::new(room));
        Self {
            origin: columns3(room),
            direction: columns3(room),
            t_min,
            t_max,
            mask: vec![mask; room],
            time: Vec::new(),
            passed: PassedHits::default(),
        }
    }

    /// A range of them, to be traced.
    pub fn batch(&self, range: Range<usize>) -> RayBatch<'_> {
        let (origin, direction) = (&self.origin, &self.direction);
        RayBatch {
            origin: [&origin[0][range.clone()], &origin[1][range.clone()], &origin[2][range.clone()]],
            direction: [&direction[0][range.clone()], &direction[1][range.clone()], &direction[2][range.clone()]],
            t_min: &self.t_min[range.clone()],
            t_max: &self.t_max[range.clone()],
            mask: &self.mask[range.clone()],
            time: if self.time.is_empty() { &[] } else { &self.time[range.clone()] },
            passed: self.passed.of(range),
        }
    }

    /// Writes the chosen lanes behind the first `count` rays; visibility bits are set later.
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, ray: &RayLanes<L>, chosen: M<L>, count: usize) {
        append3(ray.origin, chosen, &mut self.origin, count);
        append3(ray.direction, chosen, &mut self.direction, count);
        ray.t_min.append(chosen, &mut self.t_min, count);
        ray.t_max.append(chosen, &mut self.t_max, count);
    }

    /// A register of rays.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, l: L, at: usize) -> RayLanes<L> {
        let (origin, direction) = (load3(l, &self.origin, at), load3(l, &self.direction, at));
        RayLanes { origin, direction, t_min: l.load(&self.t_min, at), t_max: l.load(&self.t_max, at) }
    }

    /// Gives the first rays times; none at all where nothing moves.
    pub(crate) fn set_times(&mut self, times: Option<impl Iterator<Item = f32>>) {
        let Some(times) = times else { return self.time.clear() };
        self.time.resize(self.t_max.len(), 0.5);
        self.time.iter_mut().zip(times).for_each(|(place, time)| *place = time);
    }

    /// The times of some rays, the shutter's middle where nothing moves.
    #[inline(always)]
    pub(crate) fn times<L: Lanes>(&self, l: L, ray: U<L>) -> F<L> {
        if self.time.is_empty() { l.f(0.5) } else { l.gather(&self.time, ray) }
    }

    /// Copies a ray over another; visibility bits stay.
    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        let threes = [&mut self.origin, &mut self.direction];
        threes.into_iter().flatten().chain([&mut self.t_min, &mut self.t_max]).for_each(|column| column[to] = column[from]);
        if !self.time.is_empty() {
            self.time[to] = self.time[from];
        }
        self.passed.copy(from, to);
    }

    /// Takes chosen rays of others, in that order.
    pub(crate) fn select(&mut self, from: &Self, chosen: &[u32]) {
        fn fill<T: Copy>(to: &mut [T], from: &[T], chosen: &[u32]) {
            to.iter_mut().zip(chosen).for_each(|(to, ray)| *to = from[*ray as usize]);
        }
        for axis in 0..3 {
            fill(&mut self.origin[axis], &from.origin[axis], chosen);
            fill(&mut self.direction[axis], &from.direction[axis], chosen);
        }
        fill(&mut self.t_min, &from.t_min, chosen);
        fill(&mut self.t_max, &from.t_max, chosen);
        fill(&mut self.mask, &from.mask, chosen);
        self.passed.select(&from.passed, chosen);
        let time = |ray: &u32| from.time[*ray as usize];
        self.set_times((!from.time.is_empty()).then(|| chosen.iter().map(time)));
    }
}
