//! The tests of curves and points in plain Rust, for the scalar level: see `segments.rs` and `point_block.rs`.

use super::joint::OVERLAP;
use super::line_ray::{END_CAP, START_CAP, SmoothHits, UNSEEN};
use super::point_block::PointBlock;
use super::prepared::PreparedRay;
use super::segment_block::Segments;
use super::segments::SEAM;
use super::smooth::{SmoothLeaf, dot};
use crate::tree::node::WIDTH;

/// Distance, share of the axis, and the way out from there.
type Found = (f32, f32, [f32; 3]);

/// `a + b s`.
fn along(a: [f32; 3], b: [f32; 3], s: f32) -> [f32; 3] {
    [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s]
}

/// A ray in three components.
struct LineRay {
    origin: [f32; 3],
    direction: [f32; 3],
    squared: f32,
    range: [f32; 2],
}

impl LineRay {
    fn new(ray: &PreparedRay, t_max: f32) -> Self {
        let [x, y, z, _] = ray.direction;
        let [ox, oy, oz, _] = ray.origin;
        LineRay { origin: [ox, oy, oz], direction: [x, y, z], squared: x * x + y * y + z * z, range: [ray.t_min, t_max] }
    }

    /// Where the ray is nearest to a point, and the way from there to the point.
    fn foot(&self, point: [f32; 3]) -> (f32, [f32; 3]) {
        let to = along(point, self.origin, -1.0);
        let t = dot(to, self.direction) / self.squared;
        (t, along(to, self.direction, -t))
    }

    fn sees(&self, t: f32) -> bool {
        t > self.range[0] && t <= self.range[1]
    }

    /// The distance behind which shapes that face the ray are seen.
    fn behind(&self, t: f32, radius: f32) -> bool {
        radius > 0.0 && t > radius / self.squared.sqrt() * UNSEEN && self.sees(t)
    }

    /// Where the ray enters a sphere that it is nearest to at `foot`, with the way `to` its centre.
    fn sphere(&self, foot: f32, to: [f32; 3], radius: f32) -> Option<(f32, [f32; 3])> {
        let half = ((radius * radius - dot(to, to)) / self.squared).sqrt();
        let t = foot - half;
        (half >= 0.0 && radius > 0.0 && self.sees(t)).then(|| (t, along(to.map(|x| -x), self.direction, -half)))
    }
}

/// The lanes of a leaf that a ray meets, as a mask.
pub(crate) fn intersect(leaf: SmoothLeaf<'_>, ray: &PreparedRay, t_max: f32, hits: &mut SmoothHits) -> u32 {
    let ray = LineRay::new(ray, t_max);
    let mut mask = 0;
    for lane in 0..WIDTH {
        let found = match leaf {
            SmoothLeaf::Nothing => None,
            SmoothLeaf::Tubes(leaf) => tube(leaf, lane, &ray),
            SmoothLeaf::Ribbons(leaf) => ribbon(leaf, lane, &ray),
            SmoothLeaf::Spheres(block) => ball(block, lane, &ray, false),
            SmoothLeaf::Discs(block) => ball(block, lane, &ray, true),
        };
        if let Some((t, share, out)) = found {
            (hits.t[lane], hits.along[lane]) = (t, share);
            (0..3).for_each(|k| hits.out[k][lane] = out[k]);
            mask |= 1 << lane;
        }
    }
    mask
}

fn of_lane(rows: &[[f32; WIDTH]; 3], lane: usize) -> [f32; 3] {
    [rows[0][lane], rows[1][lane], rows[2][lane]]
}

fn ball(block: &PointBlock, lane: usize, ray: &LineRay, facing: bool) -> Option<Found> {
    let (foot, to) = ray.foot(of_lane(&block.centre, lane));
    let radius = block.radius[lane];
    if facing {
        return (dot(to, to) <= radius * radius && ray.behind(foot, radius)).then(|| (foot, 0.0, to.map(|x| -x)));
    }
    ray.sphere(foot, to, radius).map(|(t, out)| (t, 0.0, out))
}

fn ribbon(leaf: Segments<'_>, lane: usize, ray: &LineRay) -> Option<Found> {
    if lane >= leaf.count() {
        return None;
    }
    let axis = leaf.axis(lane);
    let (foot, to) = ray.foot(leaf.start(lane));
    let along_ray = dot(axis, ray.direction) / ray.squared;
    let across = along(axis, ray.direction, -along_ray);
    let raw = -dot(to, across) / dot(across, across).max(f32::MIN_POSITIVE);
    let share = raw.clamp(0.0, 1.0);
    let out = along(to, across, share).map(|x| -x);
    let (_, radius) = leaf.lane(lane, share);
    let t = foot + share * along_ray;
    let is_outer = |(next, length, _): ([f32; 3], f32, f32)| dot(next, out) <= OVERLAP[0] * radius * length;
    let goes_on = raw <= 1.0 || leaf.joint(lane).next().is_some_and(is_outer);
    let hit = dot(out, out) <= radius * radius && raw >= 0.0 && goes_on && ray.behind(t, radius);
    hit.then_some((t, share, out))
}

fn tube(leaf: Segments<'_>, lane: usize, ray: &LineRay) -> Option<Found> {
    if lane >= leaf.count() {
        return None;
    }
    let (axis, [radius, growth]) = (leaf.axis(lane), leaf.radius(lane));
    let (foot, to) = ray.foot(leaf.start(lane));
    let along_ray = dot(axis, ray.direction) / ray.squared;
    let across = along(axis, ray.direction, -along_ray);
    let share = (-dot(to, across) / dot(across, across).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    let near = along(to, across, share).map(|x| -x);
    let widest = radius.max(radius + growth);
    if dot(near, near) > widest * widest {
        return None;
    }
    let slack = SEAM * dot(axis, axis).sqrt();
    let mut best = cone(axis, [radius, growth], ray, (foot + share * along_ray, share, near), [along_ray, dot(across, across)]);
    let mut keep = |t: f32, share: f32, out: [f32; 3]| {
        if best.is_none_or(|best| t < best.0) {
            best = Some((t, share, out));
        }
    };
    let (end, joint, start) = (radius + growth, leaf.joint(lane), leaf.start(lane));
    let size = (0..3).fold(0.0f32, |most, k| most.max((start[k] + axis[k]).abs()));
    if let Some((t, out)) = ray.sphere(foot + along_ray, along(to, across, 1.0), end)
        && end * growth + dot(axis, out) >= -end * slack
        && joint.next().is_none_or(|(next, length, taper)| dot(next, out) <= (end * (taper + OVERLAP[0]) + size * OVERLAP[1]) * length)
    {
        keep(t, END_CAP, out);
    }
    if joint.is_first()
        && let Some((t, out)) = ray.sphere(foot, to, radius)
        && radius * growth + dot(axis, out) <= radius * slack
    {
        keep(t, START_CAP, out);
    }
    best
}

/// The cone between the ends; `near` is where the ray is nearest to the axis.
fn cone(axis: [f32; 3], [start, growth]: [f32; 2], ray: &LineRay, near: Found, [along_ray, across_squared]: [f32; 2]) -> Option<Found> {
    let (t_near, share, out) = near;
    let radius = start + share * growth;
    let slope = dot(axis, axis) - growth * growth;
    let axis_ray = along_ray * ray.squared;
    let e = radius * growth + dot(axis, out);
    let a = ray.squared * (across_squared - growth * growth) / slope;
    let b = -(e * axis_ray / slope);
    let c = dot(out, out) - radius * radius - e * e / slope;
    let discriminant = b * b - a * c;
    if !(discriminant >= 0.0 && slope > 0.0) {
        return None;
    }
    let root = discriminant.sqrt();
    let after = if b < 0.0 { c / (root - b) } else { (-b - root) / a };
    let more = (axis_ray * after + e) / slope;
    let (t, all) = (t_near + after, share + more);
    ((0.0..=1.0).contains(&all) && ray.sees(t)).then(|| (t, all, along(along(out, ray.direction, after), axis, -more)))
}

/// The distance where a ray leaves a rounded cone that it has entered: the last of the spheres at its ends and of the cone between them.
pub(super) fn leaves(leaf: Segments<'_>, lane: usize, ray: &PreparedRay) -> f32 {
    let ray = LineRay::new(ray, f32::INFINITY);
    let (axis, [radius, growth]) = (leaf.axis(lane), leaf.radius(lane));
    let (foot, to) = ray.foot(leaf.start(lane));
    let along_ray = dot(axis, ray.direction) / ray.squared;
    let across = along(axis, ray.direction, -along_ray);
    let sphere = |foot: f32, to: [f32; 3], radius: f32| foot + ((radius * radius - dot(to, to)) / ray.squared).sqrt();
    let ends = sphere(foot, to, radius).max(sphere(foot + along_ray, along(to, across, 1.0), radius + growth));
    let slope = dot(axis, axis) - growth * growth;
    let share = (-dot(to, across) / dot(across, across).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    let out = along(to, across, share).map(|x| -x);
    let near = radius + share * growth;
    let axis_ray = along_ray * ray.squared;
    let e = near * growth + dot(axis, out);
    let a = ray.squared * (dot(across, across) - growth * growth) / slope;
    let b = -(e * axis_ray / slope);
    let c = dot(out, out) - near * near - e * e / slope;
    let after = (-b + (b * b - a * c).sqrt()) / a;
    let on_cone = slope > 0.0 && (0.0..=1.0).contains(&(share + (axis_ray * after + e) / slope));
    // NaN of what is not met drops out of a maximum.
    if on_cone { ends.max(foot + share * along_ray + after) } else { ends }
}
