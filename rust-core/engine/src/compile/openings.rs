//! Luminous openings as the emitters that make their surface.

use crate::{
    light::{AngularType, Goniogram, LightKind, OpeningPart, ProjectedArea, size_factor},
    scene::{Opening, OpeningShape, Transform},
};
use gonio_simd::{One, Vec3};

/// What is flat and shines beyond its plane is as thick as this share of its greatest extent.
const THINNEST: f64 = 0.01;
/// Of light beyond the plane with less than this share of the peak the thickness is less in proportion: it would only make glare less than it is.
const STRAY: f64 = 0.01;
/// But no thinner than this share of the extent.
const LEAST: f64 = 1e-4;
/// Directions that decide whether a plane's side is lit lie this far off the plane, radians.
const OFF_PLANE: f64 = 2e-3;
/// As many of them.
const AROUND: u32 = 720;

/// One emitter of an opening.
pub(super) struct Part {
    pub(super) kind: LightKind,
    /// Local to world, its size in the axes as [`crate::light::LightRecord`] has them.
    pub(super) placed: Transform,
    /// What it knows of the whole; none of points.
    pub(super) opening: Option<OpeningPart>,
}

/// A one-sided face: half sides (half axes of a disk), centre, and the axis that it is across.
struct Face {
    kind: LightKind,
    sides: [[f64; 3]; 2],
    outward: [f64; 3],
    centre: [f64; 3],
    axis: usize,
}

/// The emitters of an opening, in world space; those alone that light leaves.
pub(super) fn parts(opening: &Opening, transform: &Transform, goniogram: Option<&Goniogram>) -> Vec<Part> {
    let Some((opening, is_flat)) = solid(opening, goniogram) else {
        return vec![Part { kind: LightKind::Point, placed: *transform, opening: None }];
    };
    let [x, y, z] = opening.size.map(|s| 0.5 * s);
    let luminaire = axes(transform);
    let (mut emitters, area) = match opening.shape {
        OpeningShape::Ellipsoid => {
            let placed = transform.after(&scaled([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], [0.0; 3]));
            (vec![(LightKind::Sphere, placed)], ProjectedArea::of_ellipsoid(axes(&placed)))
        }
        OpeningShape::VerticalCylinder if !is_flat => cylinder([[0.0, 0.0, z], [x, 0.0, 0.0], [0.0, y, 0.0]], transform, goniogram),
        OpeningShape::CylinderAlongX if !is_flat => cylinder([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], transform, goniogram),
        OpeningShape::CylinderAlongY if !is_flat => cylinder([[0.0, y, 0.0], [x, 0.0, 0.0], [0.0, 0.0, z]], transform, goniogram),
        _ => faces(&opening, is_flat, transform, goniogram),
    };
    let surface = |(kind, placed): &(LightKind, Transform)| size_factor(*kind, axes(placed), 0.0);
    let total: f64 = emitters.iter().map(surface).sum();
    let narrow = |axes: [[f64; 3]; 3]| axes.map(|axis| axis.map(|x| x as f32));
    let part = |emitter: (LightKind, Transform)| {
        let share = if total > 0.0 { (surface(&emitter) / total) as f32 } else { 0.0 };
        Part { kind: emitter.0, placed: emitter.1, opening: Some(OpeningPart { area, share, axes: narrow(luminaire) }) }
    };
    emitters.drain(..).map(part).collect()
}

/// The opening with the thickness that its light asks for, and whether it is flat and sends nothing beyond its plane; `None` for points.
fn solid(opening: &Opening, goniogram: Option<&Goniogram>) -> Option<(Opening, bool)> {
    let mut opening = *opening;
    let size = opening.size.map(|s| if s.is_finite() { s.abs() } else { 0.0 });
    let thinnest = THINNEST * size.iter().copied().fold(0.0, f64::max);
    if opening.shape == OpeningShape::Point || thinnest == 0.0 {
        return None;
    }
    opening.size = size;
    let flat = match opening.shape {
        OpeningShape::Rectangle | OpeningShape::Disk => Some(2),
        OpeningShape::DiskFacingX => Some(0),
        OpeningShape::DiskFacingY => Some(1),
        _ => None,
    };
    let Some(axis) = flat else {
        opening.size = size.map(|s| s.max(thinnest));
        opening.heights = opening.heights.map(|height| if height.is_finite() { height.clamp(0.0, opening.size[2]) } else { 0.0 });
        return Some((opening, false));
    };
    opening.size = std::array::from_fn(|k| if k == axis { 0.0 } else { size[k].max(thinnest) });
    let mut behind = [0.0; 3];
    behind[axis] = if axis == 2 { 1.0 } else { -1.0 };
    let beyond = brightest(goniogram, behind);
    if beyond <= 0.0 {
        return Some((opening, true));
    }
    opening.size[axis] = thinnest * (beyond / STRAY).clamp(LEAST / THINNEST, 1.0);
    opening.heights = [opening.size[2]; 4];
    opening.shape = match opening.shape {
        OpeningShape::Rectangle => OpeningShape::Box,
        OpeningShape::DiskFacingX => OpeningShape::CylinderAlongX,
        OpeningShape::DiskFacingY => OpeningShape::CylinderAlongY,
        _ => OpeningShape::VerticalCylinder,
    };
    Some((opening, false))
}

/// Whether a luminaire sends light into the half space that a unit vector points to; without a goniogram it does.
fn is_lit(goniogram: Option<&Goniogram>, normal: [f64; 3]) -> bool {
    goniogram.is_none_or(|goniogram| beyond(goniogram, normal).any(|factor| factor > 0.0))
}

/// The highest intensity in the half space that a unit vector points to, over the peak; 1 without a goniogram.
fn brightest(goniogram: Option<&Goniogram>, normal: [f64; 3]) -> f64 {
    let Some(goniogram) = goniogram else { return 1.0 };
    beyond(goniogram, normal).fold(0.0, f64::max) / f64::from(goniogram.peak()).max(f64::MIN_POSITIVE)
}

/// The factors in the half space that a unit vector points to, one after the other: who looks for any light stops at the first.
fn beyond(goniogram: &Goniogram, normal: [f64; 3]) -> impl Iterator<Item = f64> {
    let factor = move |w: [f64; 3]| f64::from(goniogram.factor(One, Vec3::splat(One, w.map(|x| x as f32))).to_array()[0]);
    let along = move |w: [f64; 3]| (0..3).map(|k| w[k] * normal[k]).sum::<f64>();
    let [horizontal, vertical] = goniogram.angles();
    let angular_type: AngularType = goniogram.angular_type();
    let direction = move |h: &f32, v: &f32| angular_type.direction(f64::from(*h), f64::from(*v));
    let tabulated =
        horizontal.iter().flat_map(move |h| vertical.iter().map(move |v| direction(h, v))).filter(move |w| along(*w) > OFF_PLANE);
    // Between the last dark knot and the first lit one light may still cross the plane.
    let around = (0..AROUND).map(move |k| beside(normal, f64::from(k) / f64::from(AROUND)));
    tabulated.chain(around).map(factor)
}

/// A direction that rises a little from the plane across a coordinate axis, at a share of a turn.
fn beside(normal: [f64; 3], turn: f64) -> [f64; 3] {
    let (sine, cosine) = (turn * std::f64::consts::TAU).sin_cos();
    let axis = normal.iter().position(|x| *x != 0.0).unwrap_or(0);
    let mut w = normal.map(|x| x * OFF_PLANE);
    (w[(axis + 1) % 3], w[(axis + 2) % 3]) = (cosine, sine);
    w
}

/// A cylinder with the caps that light leaves.
fn cylinder(local: [[f64; 3]; 3], transform: &Transform, goniogram: Option<&Goniogram>) -> (Vec<(LightKind, Transform)>, ProjectedArea) {
    let side = transform.after(&scaled(local, [0.0; 3]));
    let [along, first, second] = local;
    let axis = along.iter().position(|x| *x != 0.0).unwrap_or(0);
    let mut emitters = vec![(LightKind::Cylinder, side)];
    for sign in [-1.0, 1.0] {
        let mut outward = [0.0; 3];
        outward[axis] = sign;
        let cap = Face { kind: LightKind::Disk, sides: [first, second], outward, centre: along.map(|x| sign * x), axis };
        if is_lit(goniogram, outward) {
            emitters.push((cap.kind, cap.placed(transform)));
        }
    }
    (emitters, ProjectedArea::of_cylinder(axes(&side)))
}

/// Flat faces, those alone that light leaves.
fn faces(
    opening: &Opening,
    is_flat: bool,
    transform: &Transform,
    goniogram: Option<&Goniogram>,
) -> (Vec<(LightKind, Transform)>, ProjectedArea) {
    let faces = if is_flat { vec![flat_face(opening)] } else { box_faces(opening) };
    let areas: Vec<(usize, [f64; 3])> = faces.iter().map(|face| (face.axis, face.area(transform))).collect();
    let lit = faces.iter().filter(|face| is_lit(goniogram, face.outward)).map(|face| (face.kind, face.placed(transform)));
    (lit.collect(), ProjectedArea::of_faces(&areas))
}

fn flat_face(opening: &Opening) -> Face {
    let [x, y, z] = opening.size.map(|s| 0.5 * s);
    let (kind, axis, sides, outward) = match opening.shape {
        OpeningShape::DiskFacingX => (LightKind::Disk, 0, [[0.0, y, 0.0], [0.0, 0.0, z]], [1.0, 0.0, 0.0]),
        OpeningShape::DiskFacingY => (LightKind::Disk, 1, [[x, 0.0, 0.0], [0.0, 0.0, z]], [0.0, 1.0, 0.0]),
        shape => {
            let kind = if shape == OpeningShape::Rectangle { LightKind::Rectangle } else { LightKind::Disk };
            (kind, 2, [[x, 0.0, 0.0], [0.0, y, 0.0]], [0.0, 0.0, -1.0])
        }
    };
    Face { kind, sides, outward, centre: [0.0; 3], axis }
}

/// Bottom, top, and the sides as high as they are said to be.
fn box_faces(opening: &Opening) -> Vec<Face> {
    let [x, y, z] = opening.size.map(|s| 0.5 * s);
    let face = |axis: usize, outward: [f64; 3], sides: [[f64; 3]; 2], centre: [f64; 3]| {
        let kind = LightKind::Rectangle;
        Face { kind, sides, outward, centre, axis }
    };
    let level = [[x, 0.0, 0.0], [0.0, y, 0.0]];
    let mut faces = vec![face(2, [0.0, 0.0, -1.0], level, [0.0, 0.0, -z]), face(2, [0.0, 0.0, 1.0], level, [0.0, 0.0, z])];
    for (number, outward) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]].into_iter().enumerate() {
        let half = 0.5 * opening.heights[number];
        if half > 0.0 {
            let along = if number % 2 == 0 { [0.0, y, 0.0] } else { [x, 0.0, 0.0] };
            let centre = [x * outward[0], y * outward[1], half - z];
            faces.push(face(number % 2, outward, [along, [0.0, 0.0, half]], centre));
        }
    }
    faces
}

impl Face {
    /// Local to world as flat emitters have it: they shine along −z.
    fn placed(&self, transform: &Transform) -> Transform {
        let [u, v] = self.sides;
        transform.after(&scaled([u, v, self.outward.map(|x| -x)], self.centre))
    }
    /// Its area times its outward normal, in world space.
    fn area(&self, transform: &Transform) -> [f64; 3] {
        let axes = axes(&self.placed(transform));
        let size = size_factor(self.kind, axes, 0.0);
        let [u, v, inward] = axes;
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let along: f64 = (0..3).map(|k| normal[k] * inward[k]).sum();
        let factor = if length > 0.0 { -along.signum() * size / length } else { 0.0 };
        normal.map(|x| x * factor)
    }
}

fn axes(transform: &Transform) -> [[f64; 3]; 3] {
    [transform.columns[0], transform.columns[1], transform.columns[2]]
}

fn scaled([x, y, z]: [[f64; 3]; 3], origin: [f64; 3]) -> Transform {
    Transform { columns: [x, y, z, origin] }
}
