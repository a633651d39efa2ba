//! Triangles that are long and lie askew, as several boxes each: their own boxes are mostly empty, and overlap.
//!
//! Early split clipping: Ernst and Greiner, Early Split Clipping for Bounding Volume Hierarchies (2007). Where a split gains most comes first, as in
//! Karras and Aila, Fast Parallel Construction of High-Quality Bounding Volume Hierarchies (2013), section 5.

use super::collapse::{LeafMaker, LeafRule};
use super::division::Source;
use crate::intersect::triangle_block::TriangleBlock;
use crate::tree::blas::{Triangles, triangle_box};
use crate::tree::node::{Kind, ROUNDING_PAD, WIDTH};
use glam::Vec3A;
use obvhs::aabb::Aabb;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A split in two is made where both boxes together are at most this share of the one: those of fat triangles are three quarters of it or more.
const MOST_LEFT: f32 = 0.6;

/// It is not made where as much of every triangle would gain less than this share of the box of all.
const LEAST_GAIN: f32 = 0.25;

/// Twice the leaves pay where all boxes together become at most this share of what they were. Random triangles, where they do not, were up to 1.13 times as
/// slow with splits.
const WORTH_IT: f64 = 0.5;

/// A part of a triangle.
#[derive(Clone, Copy)]
struct Part {
    triangle: u32,
    bounds: Aabb,
}

/// The triangles of a mesh, some of them in several parts.
pub(crate) struct Parts<'a> {
    mesh: &'a Triangles<'a>,
    /// In the order of their triangles.
    parts: Vec<Part>,
    /// Triangles that have a part.
    pub(crate) triangles: usize,
}

/// A part with the halves that a split makes of it.
struct Split {
    gain: f32,
    part: Part,
    halves: [Aabb; 2],
}

impl Ord for Split {
    fn cmp(&self, other: &Self) -> Ordering {
        self.gain.total_cmp(&other.gain).then_with(|| other.part.triangle.cmp(&self.part.triangle))
    }
}

impl PartialOrd for Split {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Split {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Split {}

impl<'a> Parts<'a> {
    /// Splits what gains by it, up to twice as many parts as there are triangles; `None` where nothing does.
    pub(crate) fn of(mesh: &'a Triangles<'a>) -> Option<Self> {
        let mut parts: Vec<Part> = (0..mesh.triangles.len() as u32)
            .filter_map(|triangle| Some(Part { triangle, bounds: triangle_box(&mesh.corners_of(triangle)?)? }))
            .collect();
        let triangles = parts.len();
        let before = area(&parts);
        let whole = parts.iter().fold(Aabb::empty(), |all, part| all.union(&part.bounds));
        let least = whole.half_area() * LEAST_GAIN / triangles.max(1) as f32;
        let mut waiting: BinaryHeap<Split> = BinaryHeap::new();
        let mut done = Vec::with_capacity(parts.len());
        for part in parts.drain(..) {
            match split(mesh, part, least) {
                Some(split) => waiting.push(split),
                None => done.push(part),
            }
        }
        if waiting.is_empty() {
            return None;
        }
        while done.len() + waiting.len() < 2 * triangles {
            let Some(Split { part, halves, .. }) = waiting.pop() else { break };
            for bounds in halves {
                let half = Part { bounds, ..part };
                match split(mesh, half, least) {
                    Some(split) => waiting.push(split),
                    None => done.push(half),
                }
            }
        }
        done.extend(waiting.into_iter().map(|split| split.part));
        if area(&done) > WORTH_IT * before {
            return None;
        }
        // Places of parts beside the triangle, so that the outcome is the same each time.
        done.sort_by(|a, b| a.triangle.cmp(&b.triangle).then_with(|| by_place(&a.bounds, &b.bounds)));
        Some(Self { mesh, parts: done, triangles })
    }
}

/// Half areas of all boxes together.
fn area(parts: &[Part]) -> f64 {
    parts.iter().map(|part| f64::from(part.bounds.half_area())).sum()
}

fn by_place(a: &Aabb, b: &Aabb) -> Ordering {
    (0..3).fold(Ordering::Equal, |order, axis| order.then(a.min[axis].total_cmp(&b.min[axis])))
}

/// The split of a part in the middle of its longest axis, if it gains enough.
fn split(mesh: &Triangles<'_>, part: Part, least: f32) -> Option<Split> {
    let area = part.bounds.half_area();
    // No split gains more than all of it.
    if area <= least {
        return None;
    }
    let corners = mesh.corners_of(part.triangle)?;
    let size = part.bounds.diagonal();
    let axis = size.max_position();
    let middle = 0.5 * (part.bounds.min[axis] + part.bounds.max[axis]);
    let half = |upper: bool| {
        let mut bounds = part.bounds;
        if upper {
            bounds.min[axis] = middle
        } else {
            bounds.max[axis] = middle
        }
        clipped(&corners, &bounds)
    };
    let halves = [half(false)?, half(true)?];
    let left: f32 = halves.iter().map(Aabb::half_area).sum();
    (left <= MOST_LEFT * area && area - left > least).then_some(Split { gain: area - left, part, halves })
}

/// The box of what of a triangle lies in a box, widened as the triangle's own; `None` if nothing does.
fn clipped(corners: &[[f32; 3]; 3], within: &Aabb) -> Option<Aabb> {
    let mut polygon: Vec<[f64; 3]> = corners.iter().map(|corner| corner.map(f64::from)).collect();
    for axis in 0..3 {
        for (sign, limit) in [(1.0, f64::from(within.min[axis])), (-1.0, f64::from(within.max[axis]))] {
            polygon = kept(&polygon, |p| sign * (p[axis] - limit));
        }
    }
    let mut bounds = Aabb::empty();
    for point in &polygon {
        bounds = bounds.union(&Aabb::from_point(Vec3A::from_array(point.map(|x| x as f32))));
    }
    let largest = corners.iter().flatten().fold(0.0f32, |most, x| most.max(x.abs()));
    let pad = largest * ROUNDING_PAD;
    let (min, max) = ((bounds.min - pad).max(within.min - pad), (bounds.max + pad).min(within.max + pad));
    (!polygon.is_empty()).then(|| Aabb::new(min, max))
}

/// The part of a polygon where a height is not negative (Sutherland and Hodgman 1974).
fn kept(polygon: &[[f64; 3]], height: impl Fn(&[f64; 3]) -> f64) -> Vec<[f64; 3]> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (i, from) in polygon.iter().enumerate() {
        let to = &polygon[(i + 1) % polygon.len()];
        let (a, b) = (height(from), height(to));
        if a >= 0.0 {
            out.push(*from);
        }
        if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
            let share = a / (a - b);
            out.push([0, 1, 2].map(|k| from[k] + (to[k] - from[k]) * share));
        }
    }
    out
}

impl Source for Parts<'_> {
    fn len(&self) -> usize {
        self.parts.len()
    }

    fn bounds(&self, number: u32) -> Option<Aabb> {
        Some(self.parts[number as usize].bounds)
    }

    fn extent(&self) -> Aabb {
        self.mesh.extent()
    }
}

impl LeafMaker for Parts<'_> {
    type Leaf = TriangleBlock;
    const RULE: LeafRule = <Triangles<'_> as LeafMaker>::RULE;
    const KIND: Kind = <Triangles<'_> as LeafMaker>::KIND;

    fn leaf(&self, primitives: &[u32]) -> TriangleBlock {
        let (mut triangles, mut count) = ([0; WIDTH], 0);
        for triangle in primitives.iter().map(|part| self.parts[*part as usize].triangle) {
            // Parts of a triangle follow each other.
            if count == 0 || triangles[count - 1] != triangle {
                triangles[count] = triangle;
                count += 1;
            }
        }
        self.mesh.leaf(&triangles[..count])
    }
}
