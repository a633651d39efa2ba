//! The queries a ray can ask, as sinks of hits, and their loops over a batch of single rays.

use super::instance_walk::{Collector, SceneWalk, walk_instance, walk_scene};
use super::lanes8::Lanes8;
use super::ray::{Hits, NONE, PassedHit, RayBatch};
use super::scalar::Scalar;
use super::scene_bvh::SceneBvh;
use super::stream::{FEWEST_RAYS, Sink, stream, with_pending};
use super::walk::EMPTY_STACK;
use super::wide::Wide;
use fearless_simd::{Level, dispatch};
use gonio_simd::sorts_fast;

/// A hit as it is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    pub(super) t: f32,
    pub(super) u: f32,
    pub(super) v: f32,
    pub(super) primitive: u32,
    pub(super) instance: u32,
}

impl Hit {
    /// No hit up to `t_max`.
    #[inline(always)]
    pub(super) fn miss(t_max: f32) -> Self {
        Hit { t: t_max, u: 0.0, v: 0.0, primitive: NONE, instance: NONE }
    }

    /// Nearer than another; equal distances go to the lower numbers, so that the order of the walk does not show.
    #[inline(always)]
    pub(super) fn is_before(&self, other: &Hit) -> bool {
        self.t < other.t || (self.t == other.t && (self.instance, self.primitive) < (other.instance, other.primitive))
    }
}

/// Keeps the nearest hit.
pub(super) struct Nearest(pub(super) Hit);

impl Collector for Nearest {
    const ORDERED: bool = true;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.0.t
    }

    #[inline(always)]
    fn add(&mut self, hit: Hit, _transparent: bool) -> bool {
        if hit.is_before(&self.0) {
            self.0 = hit;
        }
        false
    }
}

/// Ends at the first hit.
pub(super) struct Any {
    pub(super) t_max: f32,
}

impl Collector for Any {
    const ORDERED: bool = false;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn add(&mut self, _hit: Hit, _transparent: bool) -> bool {
        true
    }
}

/// Two triangles' distances to a point of their common edge differ by less than this share.
const SAME_DISTANCE: f32 = 1e-5;

/// Ends at the first opaque hit and keeps the transparent ones.
struct Passed<'a> {
    t_max: f32,
    ray: u32,
    hits: &'a mut Vec<PassedHit>,
}

impl Collector for Passed<'_> {
    const ORDERED: bool = false;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn add(&mut self, hit: Hit, transparent: bool) -> bool {
        if transparent {
            let Hit { t, u, v, primitive, instance } = hit;
            let hit = PassedHit { ray: self.ray, instance, primitive, u, v, t };
            match hit.is_on_edge().then(|| self.twin(&hit)).flatten() {
                // The lower number, so that the order of the walk does not show.
                Some(twin) if hit.primitive < self.hits[twin].primitive => self.hits[twin] = hit,
                Some(_) => {}
                None => self.hits.push(hit),
            }
        }
        !transparent
    }
}

impl Passed<'_> {
    /// The place of a hit of the same ray on the same edge, which two triangles share: the surface is passed once.
    fn twin(&self, hit: &PassedHit) -> Option<usize> {
        let of_ray = self.hits.iter().rposition(|known| known.ray != hit.ray).map_or(0, |last| last + 1);
        let is_twin =
            |known: &PassedHit| known.instance == hit.instance && known.is_on_edge() && (known.t - hit.t).abs() <= SAME_DISTANCE * hit.t;
        self.hits[of_ray..].iter().position(is_twin).map(|place| of_ray + place)
    }
}

impl SceneBvh {
    /// The nearest hit of every ray on the mesh of one instance, whatever else is in the way: `instances[i]` is that of ray `i`.
    pub fn first_hit_within(&self, level: Level, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        dispatch!(level, simd => first_hit_within(Wide(simd), self, rays, instances, hits));
    }

    /// [`SceneBvh::first_hit_within`] without vector code.
    pub fn first_hit_within_scalar(&self, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
        first_hit_within(Scalar, self, rays, instances, hits);
    }

    /// The nearest hit of every ray: for incoherent rays.
    pub fn first_hit(&self, level: Level, rays: &RayBatch, hits: &mut Hits) {
        if streams(level, rays) {
            hits.resize(rays.len());
            with_pending(|pending| dispatch!(level, simd => stream::<_, false, _>(simd, self, rays, pending, hits)));
        } else {
            dispatch!(level, simd => first_hit(Wide(simd), self, rays, hits));
        }
    }

    /// [`SceneBvh::first_hit`] without vector code.
    pub fn first_hit_scalar(&self, rays: &RayBatch, hits: &mut Hits) {
        first_hit(Scalar, self, rays, hits);
    }

    /// `out[i] = 1` when ray `i` hits anything, transparent or not, else 0; `out` is as long as the batch.
    pub fn occluded(&self, level: Level, rays: &RayBatch, out: &mut [u8]) {
        if streams(level, rays) {
            with_pending(|pending| dispatch!(level, simd => stream::<_, true, _>(simd, self, rays, pending, out)));
        } else {
            dispatch!(level, simd => occluded(Wide(simd), self, rays, out));
        }
    }

    /// [`SceneBvh::occluded`] without vector code.
    pub fn occluded_scalar(&self, rays: &RayBatch, out: &mut [u8]) {
        occluded(Scalar, self, rays, out);
    }

    /// Every hit up to the first opaque one: `out[i] = 1` when ray `i` meets an opaque instance, else 0 and its hits on transparent
    /// instances are appended to `passed`, rays in rising order, the hits of a ray in no order.
    pub fn blocked_or_passed(&self, level: Level, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<PassedHit>) {
        dispatch!(level, simd => blocked_or_passed(Wide(simd), self, rays, out, passed));
    }

    /// [`SceneBvh::blocked_or_passed`] without vector code.
    pub fn blocked_or_passed_scalar(&self, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<PassedHit>) {
        blocked_or_passed(Scalar, self, rays, out, passed);
    }
}

/// Whether the rays of a batch go together rather than one by one.
fn streams(level: Level, rays: &RayBatch) -> bool {
    sorts_fast(level) && rays.len() >= FEWEST_RAYS
}

impl Sink<false> for Hits {
    #[inline(always)]
    fn end(&mut self, i: usize, hit: &Hit) {
        (self.t[i], self.u[i], self.v[i], self.primitive[i], self.instance[i]) = (hit.t, hit.u, hit.v, hit.primitive, hit.instance);
    }
}

impl Sink<true> for [u8] {
    #[inline(always)]
    fn end(&mut self, i: usize, hit: &Hit) {
        self[i] = u8::from(hit.instance != NONE);
    }
}

#[inline(always)]
fn first_hit<K: Lanes8>(lanes: K, scene: &SceneBvh, rays: &RayBatch, hits: &mut Hits) {
    let rays = rays.same_length();
    let n = rays.len();
    hits.resize(n);
    let (mut upper, mut lower) = (EMPTY_STACK, EMPTY_STACK);
    let (t, u, v) = (&mut hits.t[..n], &mut hits.u[..n], &mut hits.v[..n]);
    let (primitive, instance) = (&mut hits.primitive[..n], &mut hits.instance[..n]);
    for i in 0..n {
        let mut nearest = Nearest(Hit::miss(rays.t_max[i]));
        walk_scene(lanes, scene, &mut SceneWalk { stack: &mut upper, mesh_stack: &mut lower }, &rays, i, &mut nearest);
        let hit = nearest.0;
        (t[i], u[i], v[i], primitive[i], instance[i]) = (hit.t, hit.u, hit.v, hit.primitive, hit.instance);
    }
}

#[inline(always)]
fn first_hit_within<K: Lanes8>(lanes: K, scene: &SceneBvh, rays: &RayBatch, instances: &[u32], hits: &mut Hits) {
    let rays = rays.same_length();
    let n = rays.len();
    hits.resize(n);
    let mut stack = EMPTY_STACK;
    for (i, instance) in instances[..n].iter().enumerate() {
        let mut nearest = Nearest(Hit::miss(rays.t_max[i]));
        walk_instance(lanes, scene, &mut stack, &rays, i, *instance, &mut nearest);
        let hit = nearest.0;
        (hits.t[i], hits.u[i], hits.v[i], hits.primitive[i], hits.instance[i]) = (hit.t, hit.u, hit.v, hit.primitive, hit.instance);
    }
}

#[inline(always)]
fn occluded<K: Lanes8>(lanes: K, scene: &SceneBvh, rays: &RayBatch, out: &mut [u8]) {
    let rays = rays.same_length();
    let (mut upper, mut lower) = (EMPTY_STACK, EMPTY_STACK);
    for (i, out) in out[..rays.len()].iter_mut().enumerate() {
        let mut any = Any { t_max: rays.t_max[i] };
        *out = u8::from(walk_scene(lanes, scene, &mut SceneWalk { stack: &mut upper, mesh_stack: &mut lower }, &rays, i, &mut any));
    }
}

#[inline(always)]
fn blocked_or_passed<K: Lanes8>(lanes: K, scene: &SceneBvh, rays: &RayBatch, out: &mut [u8], passed: &mut Vec<PassedHit>) {
    let rays = rays.same_length();
    let (mut upper, mut lower) = (EMPTY_STACK, EMPTY_STACK);
    for (i, out) in out[..rays.len()].iter_mut().enumerate() {
        let before = passed.len();
        let mut collector = Passed { t_max: rays.t_max[i], ray: i as u32, hits: passed };
        let blocked = walk_scene(lanes, scene, &mut SceneWalk { stack: &mut upper, mesh_stack: &mut lower }, &rays, i, &mut collector);
        if blocked {
            passed.truncate(before);
        }
        *out = u8::from(blocked);
    }
}
