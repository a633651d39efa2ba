//! Sharpness of the base level: authored creases and corners, and the boundary rule.

use super::sector::{fan_counts, is_infinitely_sharp};
use super::topology::{INFINITE, Level, NONE};
use super::{BoundaryInterpolation, Creases};
use crate::MeshProblem;

/// Sets the edge and vertex sharpness of the base level of the points, and marks the faces that
/// [`BoundaryInterpolation::None`] drops in `holes`. Returns what of the creases could not be used.
pub(super) fn sharpen(level: &mut Level, creases: &Creases, boundary: BoundaryInterpolation, holes: &mut [bool]) -> Vec<MeshProblem> {
    let fans = fan_counts(level, |edge| is_infinitely_sharp(level, edge));
    let base: Vec<bool> = level.edge_sharpness.iter().map(|&sharpness| sharpness >= INFINITE).collect();
    // Authored values count from smooth, so that a boundary's own sharpness can be told from its topological one.
    level.edge_sharpness.fill(0.0);
    let mut problems = Vec::new();
    problems.extend(sharpen_edges(level, creases));
    problems.extend(sharpen_corners(level, creases));
    if boundary == BoundaryInterpolation::None {
        drop_boundary_faces(level, &base, holes);
    }
    for (sharpness, is_base) in level.edge_sharpness.iter_mut().zip(base) {
        if is_base {
            *sharpness = INFINITE;
        }
    }
    sharpen_topology(level, boundary, &fans);
    problems
}

fn sharpen_edges(level: &mut Level, creases: &Creases) -> Option<MeshProblem> {
    let total: u64 = creases.crease_lengths.iter().map(|&length| u64::from(length)).sum();
    let edges: u64 = creases.crease_lengths.iter().map(|&length| u64::from(length.saturating_sub(1))).sum();
    let given = creases.crease_sharpnesses.len() as u64;
    if total != creases.crease_indices.len() as u64 {
        let found = creases.crease_indices.len();
        return Some(MeshProblem::Crease { message: format!("{found} crease indices, but the crease lengths add up to {total}") });
    }
    // Where both counts agree each chain is one edge and both readings mean the same.
    let per_chain = given == creases.crease_lengths.len() as u64;
    if !per_chain && given != edges {
        let chains = creases.crease_lengths.len();
        return Some(MeshProblem::Crease {
            message: format!("{given} crease sharpnesses, expected {chains} (per crease) or {edges} (per edge)"),
        });
    }
    let (mut start, mut edge_number, mut missing) = (0usize, 0usize, 0usize);
    for (chain, &length) in creases.crease_lengths.iter().enumerate() {
        for pair in creases.crease_indices[start..start + length as usize].windows(2) {
            let sharpness = creases.crease_sharpnesses[if per_chain { chain } else { edge_number }];
            edge_number += 1;
            match level.find_edge(pair[0], pair[1]) {
                Some(edge) => level.edge_sharpness[edge] = usable(sharpness),
                None => missing += 1,
            }
        }
        start += length as usize;
    }
    (missing > 0).then(|| MeshProblem::Crease { message: format!("{missing} crease edges are no edges of the mesh and are ignored") })
}

fn sharpen_corners(level: &mut Level, creases: &Creases) -> Option<MeshProblem> {
    let (indices, sharpnesses) = (&creases.corner_indices, &creases.corner_sharpnesses);
    if indices.len() != sharpnesses.len() {
        let (found, expected) = (sharpnesses.len(), indices.len());
        return Some(MeshProblem::Crease { message: format!("{found} corner sharpnesses, expected {expected}") });
    }
    let mut missing = 0;
    for (&vertex, &sharpness) in indices.iter().zip(sharpnesses) {
        match level.vertex_sharpness.get_mut(vertex as usize) {
            Some(entry) => *entry = usable(sharpness),
            None => missing += 1,
        }
    }
    (missing > 0).then(|| MeshProblem::Crease { message: format!("{missing} corner indices are no points of the mesh and are ignored") })
}

/// Faces at a vertex that has a boundary edge not authored as infinitely sharp are dropped.
fn drop_boundary_faces(level: &Level, base: &[bool], holes: &mut [bool]) {
    let mut is_open = vec![false; level.vertex_count];
    for (edge, &[a, b]) in level.edge_vertices.iter().enumerate() {
        let is_boundary = base[edge] && level.edge_corners[edge][1] == NONE;
        if is_boundary && level.edge_sharpness[edge] < INFINITE {
            is_open[a as usize] = true;
            is_open[b as usize] = true;
        }
    }
    for (face, hole) in holes.iter_mut().enumerate() {
        *hole |= level.corner_vertex[level.corners(face)].iter().any(|&vertex| is_open[vertex as usize]);
    }
}

/// Sharpens the vertices of a single face where the boundary rule says so, and non-manifold vertices except those
/// inside a chain of non-manifold edges.
fn sharpen_topology(level: &mut Level, boundary: BoundaryInterpolation, fans: &[u32]) {
    let mut faces = vec![0u32; level.vertex_count];
    let mut edges = vec![0u32; level.vertex_count];
    let mut boundaries = vec![0u32; level.vertex_count];
    let mut non_manifold = vec![0u32; level.vertex_count];
    for &vertex in &level.corner_vertex {
        faces[vertex as usize] += 1;
    }
    let crowd = edge_face_counts(level);
    for (edge, ends) in level.edge_vertices.iter().enumerate() {
        for &vertex in ends {
            edges[vertex as usize] += 1;
            boundaries[vertex as usize] += u32::from(crowd[edge] == 1);
            non_manifold[vertex as usize] += u32::from(crowd[edge] > 2 || (crowd[edge] == 2 && !level.is_manifold(edge)));
        }
    }
    for vertex in 0..level.vertex_count {
        let is_corner = faces[vertex] == 1 && edges[vertex] == 2 && boundary == BoundaryInterpolation::EdgeAndCorner;
        let is_chain = non_manifold[vertex] == 2 && boundaries[vertex] == 0 && faces[vertex] > edges[vertex];
        if is_corner || ((fans[vertex] > 1 || non_manifold[vertex] > 0) && !is_chain) {
            level.vertex_sharpness[vertex] = INFINITE;
        }
    }
}

fn edge_face_counts(level: &Level) -> Vec<u32> {
    let mut counts = vec![0; level.edge_vertices.len()];
    for &edge in &level.corner_edge {
        counts[edge as usize] += 1;
    }
    counts
}

/// Sharpness as the rules can use it: NaN and negative values are smooth.
fn usable(sharpness: f32) -> f32 {
    sharpness.clamp(0.0, INFINITE).max(0.0)
}
