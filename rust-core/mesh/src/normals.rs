//! Normals for meshes that have none: per face, per point, and per corner with sharp angles kept.

use super::vector::{Vec3, add, angle_between, dot, newell, normalized, scale, sub};
use super::{FacePrimvar, Interpolation, PolygonMesh};
use std::ops::Range;

/// What a face without area gets.
const FALLBACK: Vec3 = [0.0, 0.0, 1.0];

/// Unit normal of each face, outward also for left-handed meshes; +Z for faces without area.
#[must_use]
pub fn facet_normals(mesh: &PolygonMesh) -> Vec<[f32; 3]> {
    let mut normals = vec![FALLBACK; mesh.face_counts.len()];
    for (face, range) in mesh.usable_faces() {
        normals[face as usize] = face_normal(mesh, range).unwrap_or(FALLBACK);
    }
    normals
}

/// Unit normal of each point: the mean of its faces' normals weighted by their angles at the point (Thürmer and
/// Wüthrich 1998). Holes do not count. Points without faces get +Z.
#[must_use]
pub fn smooth_normals(mesh: &PolygonMesh) -> Vec<[f32; 3]> {
    let mut sums = vec![[0.0; 3]; mesh.points.len()];
    let holes = mesh.hole_mask();
    for (face, range) in mesh.usable_faces() {
        let Some(normal) = face_normal(mesh, range.clone()).filter(|_| !holes[face as usize]) else {
            continue;
        };
        for corner in range.clone() {
            let vertex = mesh.corners[corner] as usize;
            sums[vertex] = add(sums[vertex], scale(normal, corner_angle(mesh, &range, corner)));
        }
    }
    sums.into_iter().map(|sum| normalized(sum).unwrap_or(FALLBACK)).collect()
}

/// Normals per face corner: at each point the faces whose normals differ by less than `sharp_angle` (radians) from the
/// face's own are averaged by angle. A face-varying primvar `normals` of 3 components.
#[must_use]
pub fn corner_normals(mesh: &PolygonMesh, sharp_angle: f32) -> FacePrimvar {
    let facets = facet_normals(mesh);
    let (starts, incident) = corners_by_point(mesh);
    let threshold = sharp_angle.clamp(0.0, std::f32::consts::PI).cos();
    let mut values = vec![0.0; mesh.corners.len() * 3];
    for (face, range) in mesh.usable_faces() {
        let own = facets[face as usize];
        for corner in range {
            let vertex = mesh.corners[corner] as usize;
            let around = &incident[starts[vertex] as usize..starts[vertex + 1] as usize];
            let mut sum = [0.0; 3];
            for &(other, angle) in around.iter().take(MAX_AROUND) {
                let normal = facets[other as usize];
                if dot(own, normal) >= threshold {
                    sum = add(sum, scale(normal, angle));
                }
            }
            values[3 * corner..3 * corner + 3].copy_from_slice(&normalized(sum).unwrap_or(own));
        }
    }
    FacePrimvar { name: "normals".into(), interpolation: Interpolation::FaceVarying, components: 3, values, indices: None }
}

/// Faces that one corner looks at: bounds the quadratic cost of points with very many faces.
const MAX_AROUND: usize = 1024;

/// For each point the (face, angle) pairs of its corners, as a list of starts and one of entries.
fn corners_by_point(mesh: &PolygonMesh) -> (Vec<u32>, Vec<(u32, f32)>) {
    let mut starts = vec![0u32; mesh.points.len() + 1];
    for (_, range) in mesh.usable_faces() {
        for corner in range {
            starts[mesh.corners[corner] as usize + 1] += 1;
        }
    }
    for point in 0..mesh.points.len() {
        starts[point + 1] += starts[point];
    }
    let mut fill = starts.clone();
    let mut entries = vec![(0, 0.0); starts[mesh.points.len()] as usize];
    for (face, range) in mesh.usable_faces() {
        for corner in range.clone() {
            let slot = &mut fill[mesh.corners[corner] as usize];
            entries[*slot as usize] = (face, corner_angle(mesh, &range, corner));
            *slot += 1;
        }
    }
    (starts, entries)
}

fn face_normal(mesh: &PolygonMesh, range: Range<usize>) -> Option<Vec3> {
    let normal = newell(&mesh.points, &mesh.corners[range]);
    let largest = normal[0].abs().max(normal[1].abs()).max(normal[2].abs());
    let sign = if mesh.left_handed { -1.0 } else { 1.0 };
    normalized(normal.map(|x| (sign * x / largest) as f32))
}

/// Angle of a face at one of its corners, radians.
fn corner_angle(mesh: &PolygonMesh, face: &Range<usize>, corner: usize) -> f32 {
    let at = |corner: usize| mesh.points[mesh.corners[corner] as usize];
    let next = if corner + 1 == face.end { face.start } else { corner + 1 };
    let previous = if corner == face.start { face.end - 1 } else { corner - 1 };
    let here = at(corner);
    angle_between(sub(at(next), here), sub(at(previous), here))
}
