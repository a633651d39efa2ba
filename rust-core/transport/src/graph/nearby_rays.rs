//! The rays of steps that look around hits: columns of one sample of a piece.

use crate::state::rays::{RayLanes, Rays};
use crate::words::ray_mask;
use gonio_accel::{Hits, Tlas, TransparentHit};
use gonio_nodes::CHUNK;
use gonio_simd::{Column, Execution, Lanes, PADDING, Vec3};

/// The surfaces around.
#[derive(Clone, Copy, Debug)]
pub struct Around<'a> {
    /// All instances.
    pub bvh: &'a Tlas,
    /// Whether any material lets straight light pass: what does occludes nothing.
    pub any_transparent: bool,
}

/// The rays of one sample of a piece, and what they met.
#[derive(Debug)]
pub(super) struct NearbyRays {
    pub(super) execution: Execution,
    pub(super) rays: Rays,
    pub(super) blocked: Vec<u8>,
    pub(super) passed: Vec<TransparentHit>,
    pub(super) instances: Vec<u32>,
    pub(super) hits: Hits,
    /// Radii of the discs' points.
    pub(super) radius: Column,
    pub(super) sum: [Column; 3],
}

impl Default for NearbyRays {
    fn default() -> Self {
        let column = || Column::new(CHUNK + PADDING);
        Self {
            execution: Execution::detect(),
            rays: Rays::new(CHUNK + PADDING, ray_mask::SHADOW),
            blocked: vec![0; CHUNK],
            passed: Vec::new(),
            instances: Vec::new(),
            hits: Hits::default(),
            radius: column(),
            sum: [column(), column(), column()],
        }
    }
}

impl NearbyRays {
    /// Writes a register of rays.
    #[inline(always)]
    pub(super) fn store<L: Lanes>(&mut self, ray: &RayLanes<L>, at: usize) {
        store3(ray.origin, &mut self.rays.origin, at);
        store3(ray.direction, &mut self.rays.direction, at);
        ray.t_min.store(&mut self.rays.t_min, at);
        ray.t_max.store(&mut self.rays.t_max, at);
    }
    /// The nearest hits of the first rays, each on its own instance.
    pub(super) fn trace_within(&mut self, around: &Around<'_>, count: usize) {
        around.bvh.first_hit_within(self.execution, &self.rays.batch(0..count), &self.instances, &mut self.hits);
    }
}

/// Writes a register of vectors.
#[inline(always)]
pub(super) fn store3<L: Lanes>(v: Vec3<L>, columns: &mut [Column; 3], at: usize) {
    let [x, y, z] = columns;
    v.store([x, y, z], at);
}
