//! Loop subdivision of values on triangles (Loop 1987), and its limit.

use super::bilinear::sum;
use super::catmull_clark::neighbour_sums;
use super::mask::{VertexMask, apply};
use super::topology::Level;

/// Loop's β: weight of each neighbour of a smooth vertex.
fn beta(valence: u32) -> f64 {
    let n = f64::from(valence);
    let inner = 0.375 + 0.25 * (std::f64::consts::TAU / n).cos();
    (0.625 - inner * inner) / n
}

/// (own, ring) weights of a smooth vertex; the ring is its neighbours.
pub(crate) fn smooth_weights(valence: u32) -> (f32, f32) {
    let beta = beta(valence);
    ((1.0 - f64::from(valence) * beta) as f32, beta as f32)
}

/// (own, ring) weights of the limit.
pub(crate) fn limit_weights(valence: u32) -> (f32, f32) {
    let ring = 1.0 / (f64::from(valence) + 0.375 / beta(valence));
    ((1.0 - f64::from(valence) * ring) as f32, ring as f32)
}

/// Values of the next level: those of vertices, edges.
pub(crate) fn refine_values<const N: usize>(level: &Level, masks: &[VertexMask], values: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut refined = Vec::with_capacity(level.vertex_count + level.edge_vertices.len());
    apply(masks, values, &neighbour_sums(level, values), &mut refined);
    for (edge, (&[a, b], &sharpness)) in level.edge_vertices.iter().zip(&level.edge_sharpness).enumerate() {
        let mut point = sum(&values[a as usize], &values[b as usize]);
        if sharpness >= 1.0 {
            point = point.map(|x| 0.5 * x);
        } else {
            let [c, d] = level.edge_corners[edge].map(|corner| &values[opposite(level, corner as usize)]);
            let opposite_weight = 0.125 * (1.0 - sharpness);
            let end_weight = 0.5 - opposite_weight;
            for k in 0..N {
                point[k] = end_weight * point[k] + opposite_weight * (c[k] + d[k]);
            }
        }
        refined.push(point);
    }
    refined
}

/// Vertex of the corner's triangle that is not on the corner's edge.
fn opposite(level: &Level, corner: usize) -> usize {
    let first = corner - corner % 3;
    level.corner_vertex[first + (corner - first + 2) % 3] as usize
}

/// Values on the limit surface.
pub(crate) fn limit_values<const N: usize>(level: &Level, masks: &[VertexMask], values: &[[f32; N]]) -> Vec<[f32; N]> {
    let mut limit = Vec::with_capacity(values.len());
    apply(masks, values, &neighbour_sums(level, values), &mut limit);
    limit
}
