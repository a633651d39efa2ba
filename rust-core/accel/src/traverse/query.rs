//! The queries of a batch of rays, and the loops of single rays.

use super::single::EMPTY_STACK;
use super::single_scene::{SceneStacks, traverse_scene};
use super::single_within::traverse_instance;
use super::stream::{FEWEST_RAYS, stream, with_stacks};
use super::stream_tuner::{Mode, Part};
use crate::blockers::{AnyHitLinked, Blockers};
use crate::hit_callback::{Any, AnyHitTransparent, HitCallback, HitsBeyond, Nearest, NearestHits, Occluded, RayQuery};
use crate::intersect::lanes8::Lanes8;
use crate::intersect::scalar::Scalar;
use crate::intersect::wide::Wide;
use crate::ray::{Hit, Hits, RayBatch, TransparentHit};
use crate::tree::tlas::Tlas;
use gonio_simd::dispatch_level;
use gonio_simd::{Execution, sorts_fast};

impl Tlas {
    /// The nearest hit of every ray. With `coherent` consecutive groups of sixteen rays go as packets where there is vector code; hits are the
    /// same either way.
    pub fn first_hit(&self, execution: Execution, rays: &RayBatch, coherent: bool, hits: &mut Hits) {
        self.first_hit_in_tree(execution, rays, coherent, hits);
        self.intersect_loose_lights(execution, rays, hits);
    }

    /// The same as if there were no loose lights.
    pub fn first_hit_in_tree(&self, execution: Execution, rays: &RayBatch, coherent: bool, hits: &mut Hits) {
        if !rays.passed.is_empty() {
            return self.ask(execution, rays, &mut HitsBeyond::new(rays.passed, hits));
        }
        match execution {
            Execution::Vector(level) if coherent => self.first_hit_packets(level, rays, hits),
            _ => self.ask(execution, rays, &mut NearestHits::new(hits, rays.len())),
        }
    }

    /// The nearest hit of every ray on the mesh of one instance, whatever else is in the way: `instances[i]` is that of ray `i`.
    pub fn first_hit_within(&self, execution: Execution, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        match execution {
            Execution::Scalar => first_hit_within(Scalar, self, rays, instances, hits),
            Execution::Vector(level) => dispatch_level!(level, simd => first_hit_within(Wide(simd), self, rays, instances, hits)),
        }
    }

    /// `out[i] = 1` when ray `i` hits anything, transparent or not, else 0; `out` is as long as the batch. `coherent` as in
    /// [`Tlas::first_hit`].
    pub fn occluded(&self, execution: Execution, rays: &RayBatch, coherent: bool, out: &mut [u8]) {
        match execution {
            Execution::Vector(level) if coherent => self.occluded_packets(level, rays, out),
            _ => self.ask(execution, rays, &mut Occluded(out)),
        }
    }

    /// Every hit up to the first opaque one: `out[i] = 1` when ray `i` meets an opaque instance, else 0 and its hits on transparent
    /// instances are appended to `transparent`, those of a ray together, in no order.
    pub fn any_hit_transparent(&self, execution: Execution, rays: &RayBatch, out: &mut [u8], transparent: &mut Vec<TransparentHit>) {
        self.ask(execution, rays, &mut AnyHitTransparent { occluded: out, transparent });
    }

    /// The same where each ray is blocked, and dimmed, by the instances of its row alone: `row_of[i]` is that of ray `i`.
    pub fn any_hit_linked(
        &self,
        execution: Execution,
        rays: &RayBatch,
        (blockers, row_of): (&Blockers, &[u32]),
        out: &mut [u8],
        transparent: &mut Vec<TransparentHit>,
    ) {
        self.ask(execution, rays, &mut AnyHitLinked::new(out, transparent, blockers, row_of));
    }

    /// Whether packets of coherent shadow rays are faster than incoherent ones: where these do not go in streams.
    pub fn has_shadow_packets(&self, execution: Execution) -> bool {
        match execution {
            Execution::Scalar => false,
            Execution::Vector(level) => !(sorts_fast(level) && self.tuners.streams(level, Any::ORDERED, self.is_large)),
        }
    }

    /// Incoherent rays: as a stream where that pays, else one by one.
    fn ask<Q: RayQuery>(&self, execution: Execution, rays: &RayBatch, query: &mut Q) {
        let Execution::Vector(level) = execution else { return single(Scalar, self, rays, Part::ALL, query) };
        let mut run = |as_stream, part| {
            if as_stream {
                with_stacks(|stacks| dispatch_level!(level, simd => stream(simd, self, rays, part, stacks, query)));
            } else {
                dispatch_level!(level, simd => single(Wide(simd), self, rays, part, query));
            }
        };
        let (n, ordered) = (rays.len(), Q::Callback::ORDERED);
        if n < FEWEST_RAYS || !sorts_fast(level) {
            return run(false, Part::ALL);
        }
        match self.tuners.mode(level, ordered, n, self.is_large) {
            Mode::Stream => run(true, Part::ALL),
            Mode::Single => run(false, Part::ALL),
            Mode::Both(turn) => self.tuners.compare(level, ordered, turn, n, run),
        }
    }
}

#[inline(always)]
fn single<K: Lanes8, Q: RayQuery>(lanes: K, scene: &Tlas, rays: &RayBatch, part: Part, query: &mut Q) {
    let rays = rays.same_length();
    let (mut upper, mut lower) = (EMPTY_STACK, EMPTY_STACK);
    let mut callback = query.callback();
    for i in part.of(rays.len()) {
        query.begin(&mut callback, i, rays.t_max[i]);
        let ended = traverse_scene(lanes, scene, &mut SceneStacks { stack: &mut upper, mesh_stack: &mut lower }, &rays, i, &mut callback);
        query.end(i, &callback, ended);
    }
}

#[inline(always)]
fn first_hit_within<K: Lanes8>(lanes: K, scene: &Tlas, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
    let rays = rays.same_length();
    let mut stack = EMPTY_STACK;
    let mut query = NearestHits::new(hits, rays.len());
    for (i, instance) in instances[..rays.len()].iter().enumerate() {
        let mut nearest = Nearest(Hit::miss(rays.t_max[i]));
        traverse_instance(lanes, scene, &mut stack, &rays, i, *instance, &mut nearest);
        query.end(i, &nearest, false);
    }
}
