//! Rays to lights that wait to be traced.

use super::{
    columns::{Columns3, append3, columns3},
    ray_mask,
};
use crate::geometry::ShadowSegment;
use gonio_camera::sampler::CAPACITY;
use gonio_simd::{Column, Lanes, M, Rgb, U, padded};

/// Room for shadow rays: walks under surfaces come out and are lit beside the surfaces themselves.
pub(super) const SHADOW_ROOM: usize = padded(2 * CAPACITY) + gonio_simd::PADDING;

/// One register of shadow rays, to be appended.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowLanes<L: Lanes> {
    pub(super) segment: ShadowSegment<L>,
    pub(super) contribution: Rgb<L>,
    pub(super) slot: U<L>,
    pub(super) code: U<L>,
    pub(super) light: U<L>,
    pub(super) shares: Option<[Rgb<L>; 2]>,
}

/// Shadow rays with what they bring if nothing is in the way.
#[derive(Debug)]
pub(super) struct ShadowRays {
    pub(super) count: usize,
    pub(super) origin: Columns3,
    pub(super) direction: Columns3,
    pub(super) t_max: Column,
    pub(super) contribution: Columns3,
    pub(super) slot: Column<u32>,
    /// What the contribution counts as, see [`super::light_sums::code`].
    pub(super) code: Column<u32>,
    /// The light that each ray leads to.
    pub(super) light: Column<u32>,
    /// Diffuse and glossy share of contributions at first surfaces; filled where passes of light are wanted.
    pub(super) shares: [Columns3; 2],
    /// Constant columns that the traversal wants.
    pub(super) t_min: Vec<f32>,
    pub(super) mask: Vec<u8>,
}

impl Default for ShadowRays {
    fn default() -> Self {
        let room = SHADOW_ROOM;
        Self {
            count: 0,
            origin: columns3(room),
            direction: columns3(room),
            t_max: Column::new(room),
            contribution: columns3(room),
            slot: Column::new(room),
            code: Column::new(room),
            light: Column::new(room),
            shares: [columns3(room), columns3(room)],
            t_min: vec![0.0; room],
            mask: vec![ray_mask::SHADOW; room],
        }
    }
}

impl ShadowRays {
    #[inline(always)]
    pub(super) fn append<L: Lanes>(&mut self, ray: &ShadowLanes<L>, chosen: M<L>) {
        let n = self.count;
        append3(ray.segment.origin, chosen, &mut self.origin, n);
        append3(ray.segment.direction, chosen, &mut self.direction, n);
        ray.segment.t_max.append(chosen, &mut self.t_max, n);
        append3(ray.contribution.into(), chosen, &mut self.contribution, n);
        ray.slot.append(chosen, &mut self.slot, n);
        ray.code.append(chosen, &mut self.code, n);
        ray.light.append(chosen, &mut self.light, n);
        if let Some(shares) = ray.shares {
            append3(shares[0].into(), chosen, &mut self.shares[0], n);
            append3(shares[1].into(), chosen, &mut self.shares[1], n);
        }
        self.count += chosen.count();
    }
}
