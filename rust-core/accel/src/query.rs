//! The queries a batch of incoherent rays can ask, and their loops.

use super::collector::{Any, Collector, Hit, Nearest, NearestHits, Occluded, OccludedOrPassed, Query};
use super::instance_walk::{SceneWalk, walk_instance, walk_scene};
use super::lanes8::Lanes8;
use super::ray::{Hits, PassedHit, RayBatch};
use super::scalar::Scalar;
use super::scene_bvh::SceneBvh;
use super::stream::{FEWEST_RAYS, stream, with_pending};
use super::trial::{Part, Way};
use super::walk::EMPTY_STACK;
use super::wide::Wide;
use fearless_simd::Level;
use gonio_simd::dispatch_level;
use gonio_simd::{Execution, sorts_fast};

impl SceneBvh {
    /// The nearest hit of every ray on the mesh of one instance, whatever else is in the way: `instances[i]` is that of ray `i`.
    pub fn first_hit_within(&self, level: Level, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        dispatch_level!(level, simd => first_hit_within(Wide(simd), self, rays, instances, hits));
    }

    /// [`SceneBvh::first_hit_within`] without vector code.
    pub fn first_hit_within_scalar(&self, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        first_hit_within(Scalar, self, rays, instances, hits);
    }

    /// The nearest hit of every ray: for incoherent rays.
    pub fn first_hit(&self, level: Level, rays: &RayBatch, hits: &mut Hits) {
        self.ask(level, rays, &mut NearestHits::new(hits, rays.len()));
        self.meet_apart(Execution::Vector(level), rays, hits);
    }

    /// [`SceneBvh::first_hit`] without vector code.
    pub fn first_hit_scalar(&self, rays: &RayBatch, hits: &mut Hits) {
        one_by_one(Scalar, self, rays, Part::ALL, &mut NearestHits::new(hits, rays.len()));
        self.meet_apart(Execution::Scalar, rays, hits);
    }

    /// `out[i] = 1` when ray `i` hits anything, transparent or not, else 0; `out` is as long as the batch.
    pub fn occluded(&self, level: Level, rays: &RayBatch, out: &mut [u8]) {
        self.ask(level, rays, &mut Occluded(out));
    }

    /// [`SceneBvh::occluded`] without vector code.
    pub fn occluded_scalar(&self, rays: &RayBatch, out: &mut [u8]) {
        one_by_one(Scalar, self, rays, Part::ALL, &mut Occluded(out));
    }

    /// Every hit up to the first opaque one: `out[i] = 1` when ray `i` meets an opaque instance, else 0 and its hits on transparent
    /// instances are appended to `passed`, those of a ray together, in no order.
    pub fn blocked_or_passed(&self, level: Level, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<PassedHit>) {
        self.ask(level, rays, &mut OccludedOrPassed { occluded: out, passed });
    }

    /// [`SceneBvh::blocked_or_passed`] without vector code.
    pub fn blocked_or_passed_scalar(&self, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<PassedHit>) {
        one_by_one(Scalar, self, rays, Part::ALL, &mut OccludedOrPassed { occluded: out, passed });
    }

    /// Whether many incoherent shadow rays are under way at once, which is as fast as packets of coherent ones, or faster.
    pub fn has_streams(&self, level: Level) -> bool {
        sorts_fast(level) && self.trials.together(level, Any::ORDERED, self.is_large)
    }

    /// Many rays under way at once where that pays, else one by one.
    fn ask<Q: Query>(&self, level: Level, rays: &RayBatch, query: &mut Q) {
        let mut walk = |together, part| {
            if together {
                with_pending(|pending| dispatch_level!(level, simd => stream(simd, self, rays, part, pending, query)));
            } else {
                dispatch_level!(level, simd => one_by_one(Wide(simd), self, rays, part, query));
            }
        };
        let (n, ordered) = (rays.len(), Q::Collector::ORDERED);
        if n < FEWEST_RAYS || !sorts_fast(level) {
            return walk(false, Part::ALL);
        }
        match self.trials.way(level, ordered, n, self.is_large) {
            Way::Together => walk(true, Part::ALL),
            Way::OneByOne => walk(false, Part::ALL),
            Way::Both(turn) => self.trials.compare(level, ordered, turn, n, walk),
        }
    }
}

#[inline(always)]
fn one_by_one<K: Lanes8, Q: Query>(lanes: K, scene: &SceneBvh, rays: &RayBatch, part: Part, query: &mut Q) {
    let rays = rays.same_length();
    let (mut upper, mut lower) = (EMPTY_STACK, EMPTY_STACK);
    let mut collector = query.collector();
    for i in part.of(rays.len()) {
        query.begin(&mut collector, i, rays.t_max[i]);
        let ended = walk_scene(lanes, scene, &mut SceneWalk { stack: &mut upper, mesh_stack: &mut lower }, &rays, i, &mut collector);
        query.end(i, &collector, ended);
    }
}

#[inline(always)]
fn first_hit_within<K: Lanes8>(lanes: K, scene: &SceneBvh, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
    let rays = rays.same_length();
    let mut stack = EMPTY_STACK;
    let mut query = NearestHits::new(hits, rays.len());
    for (i, instance) in instances[..rays.len()].iter().enumerate() {
        let mut nearest = Nearest(Hit::miss(rays.t_max[i]));
        walk_instance(lanes, scene, &mut stack, &rays, i, *instance, &mut nearest);
        query.end(i, &nearest, false);
    }
}
