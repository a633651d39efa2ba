//! Linear subdivision of values: faces get their mean, edges their midpoint.

use super::topology::Level;

/// Values of the next level of quads: those of vertices, edges, faces.
pub(crate) fn refine_values<const N: usize>(level: &Level, values: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut refined = refine_edges(level, values);
    refined.extend(face_centers(level, values));
    refined
}

/// Values of the next level of triangles: those of vertices, edges.
pub(crate) fn refine_edges<const N: usize>(level: &Level, values: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut refined = Vec::with_capacity(level.vertex_count + level.edge_vertices.len() + level.face_count());
    refined.extend_from_slice(values);
    let middle = |&[a, b]: &[u32; 2]| sum(&values[a as usize], &values[b as usize]).map(|x| 0.5 * x);
    refined.extend(level.edge_vertices.iter().map(middle));
    refined
}

/// Mean of each face's corners.
pub(crate) fn face_centers<const N: usize>(level: &Level, values: &[[f32; N]]) -> Vec<[f32; N]> {
    let center = |face: usize| {
        let vertices = &level.corner_vertex[level.corners(face)];
        let total = vertices.iter().fold([0.0; N], |total, &vertex| sum(&total, &values[vertex as usize]));
        let weight = 1.0 / vertices.len() as f32;
        total.map(|x| weight * x)
    };
    (0..level.face_count()).map(center).collect()
}

pub(crate) fn sum<const N: usize>(a: &[f32; N], b: &[f32; N]) -> [f32; N] {
    let mut total = *a;
    for k in 0..N {
        total[k] += b[k];
    }
    total
}
