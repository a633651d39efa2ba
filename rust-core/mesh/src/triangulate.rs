//! Triangles from polygons of any valence.

use super::PolygonMesh;
use super::ear_clip::{ear_clip, is_convex, turn};
use super::triangulation::Triangulation;
use super::vector::{Vec3, newell};

/// Cuts all faces of `mesh` but its holes into triangles. A quad is cut from its corner 0 to 2, unless it is concave at 1
/// or 3; convex polygons become a fan about corner 0, others are ear-clipped in the plane of their Newell normal.
/// Left-handed meshes get their corners in reverse, so that the geometric normal is outward.
#[must_use]
pub fn triangulate(mesh: &PolygonMesh) -> Triangulation {
    let holes = mesh.hole_mask();
    triangulate_faces(mesh, |face| holes[face as usize])
}

/// As [`triangulate`], leaving out the faces that `is_left_out`.
pub(super) fn triangulate_faces(mesh: &PolygonMesh, is_left_out: impl Fn(u32) -> bool) -> Triangulation {
    let mut result = Triangulation::default();
    let triangle_count = mesh.corners.len().saturating_sub(2 * mesh.face_counts.len().min(mesh.corners.len() / 3));
    result.triangles.reserve(triangle_count);
    result.corner_of.reserve(triangle_count);
    result.face_of.reserve(triangle_count);
    let mut scratch = Scratch::default();
    let mut used = 0;
    for (face, range) in mesh.usable_faces().filter(|&(face, _)| !is_left_out(face)) {
        used += 1;
        scratch.cut_face(mesh, range.clone());
        for &[a, b, c] in &scratch.triangles {
            let places = if mesh.left_handed { [a, c, b] } else { [a, b, c] };
            let corners = places.map(|place| range.start as u32 + place);
            result.triangles.push(corners.map(|corner| mesh.corners[corner as usize]));
            result.corner_of.push(corners);
            result.face_of.push(face);
        }
    }
    let left_out = (0..mesh.face_counts.len() as u32).filter(|&face| is_left_out(face)).count();
    result.skipped_faces = mesh.face_counts.len() - left_out - used;
    result
}

/// Buffers of one face at a time, kept so that faces cost no allocation.
#[derive(Default)]
struct Scratch {
    polygon: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
}

impl Scratch {
    /// Sets `triangles` to places within the face.
    fn cut_face(&mut self, mesh: &PolygonMesh, range: std::ops::Range<usize>) {
        self.triangles.clear();
        let vertices = &mesh.corners[range];
        if vertices.len() == 3 {
            self.triangles.push([0, 1, 2]);
            return;
        }
        project(&mesh.points, vertices, &mut self.polygon);
        let polygon = &self.polygon;
        if vertices.len() == 4 {
            let is_concave_at = |i: usize| turn(polygon[(i + 3) % 4], polygon[i], polygon[(i + 1) % 4]) < 0.0;
            let cut_other_way = is_concave_at(1) || is_concave_at(3);
            self.triangles.extend_from_slice(if cut_other_way { &[[1, 2, 3], [1, 3, 0]] } else { &[[0, 1, 2], [0, 2, 3]] });
        } else if is_convex(polygon) {
            self.triangles.extend((2..vertices.len() as u32).map(|end| [0, end - 1, end]));
        } else {
            ear_clip(polygon, &mut self.triangles);
        }
    }
}

/// The face seen along its Newell normal, counter-clockwise, by dropping the axis along which the normal is longest.
fn project(points: &[Vec3], vertices: &[u32], polygon: &mut Vec<[f64; 2]>) {
    let normal = newell(points, vertices);
    let axis = (0..3).fold(0, |longest, axis| if normal[axis].abs() > normal[longest].abs() { axis } else { longest });
    let (mut u, mut v) = ((axis + 1) % 3, (axis + 2) % 3);
    if normal[axis] < 0.0 {
        std::mem::swap(&mut u, &mut v);
    }
    polygon.clear();
    polygon.extend(vertices.iter().map(|&vertex| points[vertex as usize]).map(|point| [f64::from(point[u]), f64::from(point[v])]));
}
