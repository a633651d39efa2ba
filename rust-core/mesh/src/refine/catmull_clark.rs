//! Catmull-Clark subdivision of values (Catmull and Clark 1978), and its limit.

use super::TriangleRule;
use super::bilinear::{face_centers, sum};
use super::mask::{VertexMask, apply};
use super::topology::Level;

/// Weight of the face points at an edge whose two faces are triangles, under [`TriangleRule::Smooth`].
const SMOOTH_TRIANGLE_WEIGHT: f32 = 0.470;

/// (own, ring) weights of a smooth vertex; the ring is its neighbours and its faces' centres.
pub(crate) fn smooth_weights(valence: u32) -> (f32, f32) {
    let n = valence as f32;
    ((n - 2.0) / n, 1.0 / (n * n))
}

/// (own, ring) weights of the limit; the ring is 4 × its neighbours and the opposite corners of its quads.
pub(crate) fn limit_weights(valence: u32) -> (f32, f32) {
    let n = valence as f32;
    if valence == 2 { (1.0, 0.0) } else { (n / (n + 5.0), 1.0 / (n * (n + 5.0))) }
}

/// Values of the next level: those of vertices, edges, faces.
pub(crate) fn refine_values<const N: usize>(
    level: &Level,
    masks: &[VertexMask],
    triangles: TriangleRule,
    values: &[[f32; N]],
) -> Vec<[f32; N]> {
    let centers = face_centers(level, values);
    let mut refined = Vec::with_capacity(level.vertex_count + level.edge_vertices.len() + centers.len());
    apply(masks, values, &ring_sums(level, values, &centers), &mut refined);
    let faces = level.corner_faces();
    for (edge, (&[a, b], &sharpness)) in level.edge_vertices.iter().zip(&level.edge_sharpness).enumerate() {
        let mut point = sum(&values[a as usize], &values[b as usize]);
        if sharpness >= 1.0 {
            point = point.map(|x| 0.5 * x);
        } else {
            let [f, g] = level.edge_corners[edge].map(|corner| faces[corner as usize] as usize);
            let face_weight = (1.0 - sharpness) * smooth_face_weight(level, f, g, triangles);
            let end_weight = 0.5 - face_weight;
            for k in 0..N {
                point[k] = end_weight * point[k] + face_weight * (centers[f][k] + centers[g][k]);
            }
        }
        refined.push(point);
    }
    refined.extend_from_slice(&centers);
    refined
}

fn smooth_face_weight(level: &Level, f: usize, g: usize, triangles: TriangleRule) -> f32 {
    if triangles == TriangleRule::CatmullClark {
        return 0.25;
    }
    let weight = |face: usize| if level.corners(face).len() == 3 { SMOOTH_TRIANGLE_WEIGHT } else { 0.25 };
    0.5 * (weight(f) + weight(g))
}

fn ring_sums<const N: usize>(level: &Level, values: &[[f32; N]], centers: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut ring = neighbour_sums(level, values);
    for (face, center) in centers.iter().enumerate() {
        for &vertex in &level.corner_vertex[level.corners(face)] {
            let entry = &mut ring[vertex as usize];
            *entry = sum(entry, center);
        }
    }
    ring
}

/// Sum of the vertices at the other ends of each vertex's edges.
pub(crate) fn neighbour_sums<const N: usize>(level: &Level, values: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut ring = vec![[0.0; N]; level.vertex_count];
    for &[a, b] in &level.edge_vertices {
        let (a, b) = (a as usize, b as usize);
        ring[a] = sum(&ring[a], &values[b]);
        ring[b] = sum(&ring[b], &values[a]);
    }
    ring
}

/// Values on the limit surface of a level of quads.
pub(crate) fn limit_values<const N: usize>(level: &Level, masks: &[VertexMask], values: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut ring = neighbour_sums(level, values);
    for entry in &mut ring {
        *entry = entry.map(|x| 4.0 * x);
    }
    for quad in level.corner_vertex.as_chunks::<4>().0 {
        for (place, &vertex) in quad.iter().enumerate() {
            let opposite = &values[quad[(place + 2) % 4] as usize];
            let entry = &mut ring[vertex as usize];
            *entry = sum(entry, opposite);
        }
    }
    let mut limit = Vec::with_capacity(values.len());
    apply(masks, values, &ring, &mut limit);
    limit
}
