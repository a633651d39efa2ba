//! Batches of rays and of hits, one entry a ray.

use crate::intersect::prepared::Padded;
use bytemuck::{Pod, Zeroable};

/// Visibility bits of rays and of instances: a ray sees an instance with which it shares one.
pub type RayMask = u16;

/// `Hits::instance` and `Hits::primitive` of a ray that hits nothing.
pub const NONE: u32 = u32::MAX;

/// A borrowed batch of rays; all slices have the same length, one entry a ray.
///
/// A ray sees points `origin + t * direction` with `t_min < t <= t_max`; directions need not be unit, `t` counts in units of the direction.
/// `t_min` below zero counts as zero. A ray with a component that is not finite, or with a zero direction, hits nothing.
#[derive(Clone, Copy, Debug)]
pub struct RayBatch<'a> {
    /// Start points: x, y, z.
    pub origin: [&'a [f32]; 3],
    /// Directions: x, y, z, of any length but zero.
    pub direction: [&'a [f32]; 3],
    /// Exclusive lower end of the interval.
    pub t_min: &'a [f32],
    /// Inclusive upper end of the interval; infinity is fine.
    pub t_max: &'a [f32],
    /// An instance is seen when it shares a bit of its visibility mask with this one.
    pub mask: &'a [RayMask],
    /// Times of the shutter, from 0 to 1. None at all stand for its middle.
    pub time: &'a [f32],
    /// Hits that rays have passed, of which only [`crate::Tlas::first_hit`] knows. None at all where no ray has.
    pub passed: &'a [Passed],
}

impl<'a> RayBatch<'a> {
    /// The number of rays.
    pub fn len(&self) -> usize {
        self.t_max.len()
    }

    /// True when there is no ray.
    pub fn is_empty(&self) -> bool {
        self.t_max.is_empty()
    }

    /// The start point of a ray.
    #[inline(always)]
    pub(crate) fn origin_of(&self, i: usize) -> Padded {
        [self.origin[0][i], self.origin[1][i], self.origin[2][i], 0.0]
    }

    /// The direction of a ray.
    #[inline(always)]
    pub(crate) fn direction_of(&self, i: usize) -> Padded {
        [self.direction[0][i], self.direction[1][i], self.direction[2][i], 0.0]
    }

    /// The time of a ray.
    #[inline(always)]
    pub(crate) fn time_of(&self, i: usize) -> f32 {
        if self.time.is_empty() { 0.5 } else { self.time[i] }
    }

    /// Cuts all columns to one length, so that later indexing is checked once.
    #[inline(always)]
    pub(crate) fn same_length(self) -> Self {
        let n = self.len();
        let cut = |column: &'a [f32]| &column[..n];
        RayBatch {
            origin: self.origin.map(cut),
            direction: self.direction.map(cut),
            t_min: cut(self.t_min),
            t_max: self.t_max,
            mask: &self.mask[..n],
            time: if self.time.is_empty() { self.time } else { cut(self.time) },
            passed: self.passed,
        }
    }
}

/// The hit that a ray has passed, as it goes straight on: what it meets next comes after that in the order of hits, so that faces that lie on
/// each other are met one after the other, each once. The ray begins just before it (`t_min`).
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Passed {
    /// Its distance, 0 of a ray that has passed nothing.
    pub t: f32,
    /// Its instance, else [`NONE`].
    pub instance: u32,
    /// Its triangle, else [`NONE`].
    pub primitive: u32,
    /// 1 on an edge of the triangle (u or v is zero, or their sum at least [`BEFORE_EDGE`]), else 0: neighbours that are hit there as well are passed with it.
    pub on_edge: u32,
}

impl Passed {
    /// Of a ray that has passed nothing.
    pub const NOTHING: Self = Self { t: 0.0, instance: NONE, primitive: NONE, on_edge: 0 };

    /// Whether a hit comes before it in the order of hits, or is on the same surface.
    #[inline(always)]
    pub(crate) fn covers(&self, hit: &Hit) -> bool {
        let same = (hit.instance, hit.primitive) == (self.instance, self.primitive);
        let earlier = hit.t == self.t && (hit.instance, !hit.primitive) < (self.instance, !self.primitive);
        same || earlier || (self.on_edge != 0 && hit.instance == self.instance && is_on_edge(hit.u, hit.v) && are_near(hit.t, self.t))
    }
}

/// Where u and v sum up to this, a hit is on the edge of corners 1 and 2.
pub const BEFORE_EDGE: f32 = 1.0 - f32::EPSILON;

/// Whether a hit is on an edge of its triangle, where a neighbour is hit as well.
#[inline(always)]
pub(crate) fn is_on_edge(u: f32, v: f32) -> bool {
    u <= 0.0 || v <= 0.0 || u + v >= BEFORE_EDGE
}

/// Two triangles' distances to a point of their common edge differ by less than this share.
const SAME_DISTANCE: f32 = 1e-5;

/// Whether two distances may be those to a point of a common edge.
#[inline(always)]
pub(crate) fn are_near(a: f32, b: f32) -> bool {
    (a - b).abs() <= SAME_DISTANCE * a
}

/// A hit as it is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub(crate) t: f32,
    pub(crate) u: f32,
    pub(crate) v: f32,
    pub(crate) primitive: u32,
    pub(crate) instance: u32,
}

impl Hit {
    /// No hit up to `t_max`.
    #[inline(always)]
    pub(crate) fn miss(t_max: f32) -> Self {
        Hit { t: t_max, u: 0.0, v: 0.0, primitive: NONE, instance: NONE }
    }
}

/// The nearest hits of a batch, one entry a ray; the queries set the length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hits {
    /// Distance in units of the ray's direction; the ray's `t_max` for a miss.
    pub t: Vec<f32>,
    /// Barycentric coordinate of the triangle's vertex 1, or the shape's first parameter.
    pub u: Vec<f32>,
    /// Barycentric coordinate of the triangle's vertex 2, or the shape's second parameter.
    pub v: Vec<f32>,
    /// The triangle's number in its mesh, 0 for shapes, [`NONE`] for a miss.
    pub primitive: Vec<u32>,
    /// The instance's number, [`NONE`] for a miss.
    pub instance: Vec<u32>,
    /// What the rays that hit a loose light would hit without all of those, in the order of the rays.
    pub covered: Vec<Covered>,
}

/// The hit of a ray, or its miss, behind loose lights; as in [`Hits`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// The ray's number in its batch.
    pub(crate) ray: u32,
    pub(crate) hit: Hit,
}

impl Hits {
    /// Appends a copy of an entry.
    pub fn repeat(&mut self, entry: usize) {
        [&mut self.t, &mut self.u, &mut self.v].into_iter().for_each(|column| column.push(column[entry]));
        [&mut self.primitive, &mut self.instance].into_iter().for_each(|column| column.push(column[entry]));
    }

    /// An entry.
    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Hit {
        Hit { t: self.t[i], u: self.u[i], v: self.v[i], primitive: self.primitive[i], instance: self.instance[i] }
    }

    /// Writes an entry.
    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, hit: &Hit) {
        (self.t[i], self.u[i], self.v[i], self.primitive[i], self.instance[i]) = (hit.t, hit.u, hit.v, hit.primitive, hit.instance);
    }

    /// Sets the number of entries; new entries are misses.
    pub fn resize(&mut self, n: usize) {
        self.t.resize(n, f32::INFINITY);
        self.u.resize(n, 0.0);
        self.v.resize(n, 0.0);
        self.primitive.resize(n, NONE);
        self.instance.resize(n, NONE);
    }
}

/// A hit on a transparent instance, on the way of a ray that no opaque surface blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransparentHit {
    /// The ray's number in its batch.
    pub ray: u32,
    /// The instance's number.
    pub instance: u32,
    /// The triangle's number in its mesh, 0 for shapes.
    pub primitive: u32,
    /// See [`Hits::u`].
    pub u: f32,
    /// See [`Hits::v`].
    pub v: f32,
    /// Distance in units of the ray's direction.
    pub t: f32,
}

impl TransparentHit {
    /// Whether the hit is on an edge of its triangle, where a neighbour is hit as well.
    pub(crate) fn is_on_edge(&self) -> bool {
        is_on_edge(self.u, self.v)
    }
}
