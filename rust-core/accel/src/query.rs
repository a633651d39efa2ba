//! The queries a batch of incoherent rays can ask, and their loops.

use super::hit_callback::{Any, AnyHitTransparent, Hit, HitCallback, Nearest, NearestHits, Occluded, RayQuery};
use super::lanes8::Lanes8;
use super::ray::{Hits, RayBatch, TransparentHit};
use super::scalar::Scalar;
use super::stream::{FEWEST_RAYS, stream, with_stacks};
use super::stream_tuner::{Mode, Part};
use super::tlas::Tlas;
use super::traverse::EMPTY_STACK;
use super::traverse_scene::{SceneStacks, traverse_instance, traverse_scene};
use super::wide::Wide;
use fearless_simd::Level;
use gonio_simd::dispatch_level;
use gonio_simd::{Execution, sorts_fast};

impl Tlas {
    /// The nearest hit of every ray on the mesh of one instance, whatever else is in the way: `instances[i]` is that of ray `i`.
    pub fn first_hit_within(&self, level: Level, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        dispatch_level!(level, simd => first_hit_within(Wide(simd), self, rays, instances, hits));
    }

    /// [`Tlas::first_hit_within`] without vector code.
    pub fn first_hit_within_scalar(&self, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        first_hit_within(Scalar, self, rays, instances, hits);
    }

    /// The nearest hit of every ray: for incoherent rays.
    pub fn first_hit(&self, level: Level, rays: &RayBatch, hits: &mut Hits) {
        self.ask(level, rays, &mut NearestHits::new(hits, rays.len()));
        self.intersect_loose_lights(Execution::Vector(level), rays, hits);
    }

    /// [`Tlas::first_hit`] without vector code.
    pub fn first_hit_scalar(&self, rays: &RayBatch, hits: &mut Hits) {
        single(Scalar, self, rays, Part::ALL, &mut NearestHits::new(hits, rays.len()));
        self.intersect_loose_lights(Execution::Scalar, rays, hits);
    }

    /// `out[i] = 1` when ray `i` hits anything, transparent or not, else 0; `out` is as long as the batch.
    pub fn occluded(&self, level: Level, rays: &RayBatch, out: &mut [u8]) {
        self.ask(level, rays, &mut Occluded(out));
    }

    /// [`Tlas::occluded`] without vector code.
    pub fn occluded_scalar(&self, rays: &RayBatch, out: &mut [u8]) {
        single(Scalar, self, rays, Part::ALL, &mut Occluded(out));
    }

    /// Every hit up to the first opaque one: `out[i] = 1` when ray `i` meets an opaque instance, else 0 and its hits on transparent
    /// instances are appended to `passed`, those of a ray together, in no order.
    pub fn any_hit_transparent(&self, level: Level, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<TransparentHit>) {
        self.ask(level, rays, &mut AnyHitTransparent { occluded: out, passed });
    }

    /// [`Tlas::any_hit_transparent`] without vector code.
    pub fn any_hit_transparent_scalar(&self, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<TransparentHit>) {
        single(Scalar, self, rays, Part::ALL, &mut AnyHitTransparent { occluded: out, passed });
    }

    /// Whether many incoherent shadow rays are under way at once, which is as fast as packets of coherent ones, or faster.
    pub fn has_streams(&self, level: Level) -> bool {
        sorts_fast(level) && self.tuners.streams(level, Any::ORDERED, self.is_large)
    }

    /// Many rays under way at once where that pays, else one by one.
    fn ask<Q: RayQuery>(&self, level: Level, rays: &RayBatch, query: &mut Q) {
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
