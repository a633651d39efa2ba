//! Normals of a refined level, one per sector: from the tangents of the limit surface where the vertex is smooth or on a
//! crease, else from the faces, weighted by angle. Corners between different sharp edges get normals of their own.

use super::Scheme;
use super::sector::{Sector, for_each_sector, is_sharp};
use super::topology::Level;
use crate::vector::{Vec3, add, angle_between, cross, dot, normalized, scale, sub};
use crate::{FacePrimvar, Interpolation};

/// The surface whose normals are wanted.
pub(super) struct Surface<'a> {
    pub(super) level: &'a Level,
    /// Points that the level's limit tangents follow from; `None` where only the faces count.
    pub(super) control: Option<&'a [Vec3]>,
    /// Points as they will be drawn.
    pub(super) points: &'a [Vec3],
    pub(super) scheme: Scheme,
    pub(super) left_handed: bool,
}

/// The face-varying primvar `normals`, indexed, one element per sector.
pub(super) fn normals(surface: &Surface) -> FacePrimvar {
    let level = surface.level;
    let facing = if surface.left_handed { -1.0 } else { 1.0 };
    let sharp_edges = sharp_edge_counts(level);
    let circles = Circles::new();
    let mut values: Vec<f32> = Vec::with_capacity(3 * level.vertex_count);
    let mut indices = vec![0; level.corner_vertex.len()];
    for_each_sector(
        level,
        |edge| is_sharp(level, edge),
        |sector| {
            let is_corner = level.vertex_sharpness[sector.vertex as usize] > 0.0 || sharp_edges[sector.vertex as usize] > 2;
            let tangential = surface.control.and_then(|control| match (is_corner, sector.corners) {
                (false, _) => tangent_normal(surface, sector, control, &circles),
                (true, &[corner]) => corner_normal(surface, corner, control),
                (true, _) => None,
            });
            // Folded rings can turn the tangents' normal over; the faces that are drawn decide.
            let facing_out = tangential.filter(|&normal| dot(normal, area_sum(surface, sector)) >= 0.0);
            let normal = facing_out.or_else(|| face_mean(surface, sector)).unwrap_or([0.0, 0.0, 1.0]);
            for &corner in sector.corners {
                indices[corner as usize] = (values.len() / 3) as u32;
            }
            values.extend(normal.map(|x| facing * x));
        },
    );
    FacePrimvar { name: "normals".into(), interpolation: Interpolation::FaceVarying, components: 3, values, indices: Some(indices) }
}

fn sharp_edge_counts(level: &Level) -> Vec<u32> {
    let mut counts = vec![0; level.vertex_count];
    for (ends, _) in level.edge_vertices.iter().zip(&level.edge_sharpness).filter(|(_, sharpness)| **sharpness > 0.0) {
        for &vertex in ends {
            counts[vertex as usize] += 1;
        }
    }
    counts
}

/// Mean of the normals that the sector's faces have at the vertex, weighted by angle.
fn face_mean(surface: &Surface, sector: &Sector) -> Option<Vec3> {
    let center = surface.points[sector.vertex as usize];
    let mut total = [0.0; 3];
    for &corner in sector.corners {
        let ring = Ring::new(surface, corner);
        let (next, previous) = (sub(surface.points[ring.next], center), sub(surface.points[ring.previous], center));
        if let Some(normal) = normalized(cross(next, previous)) {
            total = add(total, scale(normal, angle_between(next, previous)));
        }
    }
    normalized(total)
}

/// Sum of the cross products of the sector's faces at the vertex.
fn area_sum(surface: &Surface, sector: &Sector) -> Vec3 {
    let center = surface.points[sector.vertex as usize];
    let mut total = [0.0; 3];
    for &corner in sector.corners {
        let ring = Ring::new(surface, corner);
        total = add(total, cross(sub(surface.points[ring.next], center), sub(surface.points[ring.previous], center)));
    }
    total
}

/// The other vertices of a corner's face.
struct Ring {
    next: usize,
    opposite: usize,
    previous: usize,
}

impl Ring {
    fn new(surface: &Surface, corner: u32) -> Self {
        let level = surface.level;
        let next = level.after(corner as usize);
        let at = |corner: usize| level.corner_vertex[corner] as usize;
        Self { next: at(next), opposite: at(level.after(next)), previous: at(level.before(corner as usize)) }
    }
}

fn tangent_normal(surface: &Surface, sector: &Sector, control: &[Vec3], circles: &Circles) -> Option<Vec3> {
    let first = Ring::new(surface, sector.corners[0]);
    let last = Ring::new(surface, *sector.corners.last()?);
    let is_dart = !sector.is_closed && first.next == last.previous;
    let (along, across) = match (surface.scheme, sector.is_closed || is_dart) {
        (Scheme::Bilinear, _) => return None,
        (_, true) if sector.corners.len() < 3 => return None,
        (_, true) => smooth_tangents(surface, sector, control, circles),
        (_, false) => {
            let ends = [control[first.next], control[last.previous]];
            (sub(ends[0], ends[1]), crease_tangent(surface, sector, control, ends, circles))
        }
    };
    normalized(cross(along, across))
}

/// Normal of a lone face at a sharp corner, where the boundary curves leave along the control edges.
fn corner_normal(surface: &Surface, corner: u32, control: &[Vec3]) -> Option<Vec3> {
    let ring = Ring::new(surface, corner);
    let center = control[surface.level.corner_vertex[corner as usize] as usize];
    normalized(cross(sub(control[ring.next], center), sub(control[ring.previous], center)))
}

/// Tangents at a smooth interior vertex: the eigenvectors of the subdivision matrix to the subdominant eigenvalue.
fn smooth_tangents(surface: &Surface, sector: &Sector, control: &[Vec3], circles: &Circles) -> (Vec3, Vec3) {
    let count = sector.corners.len();
    let circle = circles.of(count);
    let center = control[sector.vertex as usize];
    let opposite_weight = catmull_clark_opposite_weight(count);
    let (mut cosine, mut sine) = ([0.0; 3], [0.0; 3]);
    for (i, &corner) in sector.corners.iter().enumerate() {
        let ring = Ring::new(surface, corner);
        let (here, after) = (circle(i), circle(i + 1));
        let edge = sub(control[ring.next], center);
        if surface.scheme == Scheme::Loop {
            cosine = add(cosine, scale(edge, here[0]));
            sine = add(sine, scale(edge, here[1]));
        } else {
            let diagonal = scale(sub(control[ring.opposite], center), opposite_weight);
            cosine = add(cosine, add(scale(edge, 4.0 * here[0]), scale(diagonal, here[0] + after[0])));
            sine = add(sine, add(scale(edge, 4.0 * here[1]), scale(diagonal, here[1] + after[1])));
        }
    }
    (cosine, sine)
}

/// Weight of the opposite corners relative to a quarter of the neighbours', from the subdominant eigenvalue.
fn catmull_clark_opposite_weight(valence: usize) -> f32 {
    if valence == 4 {
        return 1.0;
    }
    let angle = std::f64::consts::TAU / valence as f64;
    let eigenvalue = (5.0 + angle.cos() + (0.5 * angle).cos() * (2.0 * (9.0 + angle.cos())).sqrt()) / 16.0;
    (1.0 / (4.0 * eigenvalue - 1.0)) as f32
}

/// Tangent across a crease, into the sector (Biermann, Levin and Zorin 2000).
fn crease_tangent(surface: &Surface, sector: &Sector, control: &[Vec3], ends: [Vec3; 2], circles: &Circles) -> Vec3 {
    let count = sector.corners.len();
    let center = control[sector.vertex as usize];
    let end_sum = add(sub(ends[0], center), sub(ends[1], center));
    if count == 1 {
        return end_sum;
    }
    let circle = circles.of(2 * count);
    let [cosine, sine] = circle(1);
    let is_loop = surface.scheme == Scheme::Loop;
    let (end_weight, edge_weight) = match (is_loop, count) {
        // Two triangles: the middle edge alone; the closed form's end weights vanish there.
        (true, 2) => (0.0, 1.0),
        (true, 3) => (-0.5, 2.0 / 3.0f32.sqrt()),
        (true, _) => (-sine, 2.0 - 2.0 * cosine),
        (false, _) => (-(cosine + 1.0) / sine * (1.0 + 2.0 * cosine), 4.0),
    };
    let mut tangent = scale(end_sum, end_weight);
    for (i, &corner) in sector.corners.iter().enumerate() {
        let ring = Ring::new(surface, corner);
        let (here, after) = (circle(i)[1], circle(i + 1)[1]);
        if i > 0 {
            tangent = add(tangent, scale(sub(control[ring.next], center), edge_weight * here));
        }
        if !is_loop {
            tangent = add(tangent, scale(sub(control[ring.opposite], center), here + after));
        }
    }
    tangent
}

/// Cosines and sines of the fractions of a circle, kept for common numbers of parts.
struct Circles {
    tables: Vec<Vec<[f32; 2]>>,
}

impl Circles {
    fn new() -> Self {
        Self { tables: (0..=32).map(|parts| (0..=parts).map(|i| on_circle(i, parts)).collect()).collect() }
    }

    fn of(&self, parts: usize) -> impl Fn(usize) -> [f32; 2] {
        let table = self.tables.get(parts);
        move |i| table.map_or_else(|| on_circle(i, parts), |table| table[i])
    }
}

fn on_circle(i: usize, parts: usize) -> [f32; 2] {
    let (sine, cosine) = (std::f64::consts::TAU * i as f64 / parts.max(1) as f64).sin_cos();
    [cosine as f32, sine as f32]
}
