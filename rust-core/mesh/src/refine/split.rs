//! The topology of the next level: each corner becomes a quad (Catmull-Clark, bilinear), or each triangle four (Loop).
//!
//! Vertices of the next level are numbered: those from vertices, then from edges, then (quads only) from faces. Edges:
//! two from each edge, the half at its first vertex first, then one from each corner.

use super::topology::{INFINITE, Level, NONE};

impl Level {
    /// The next level of quads; the face from corner `c` has number `c`.
    pub(crate) fn split_to_quads(&self) -> Self {
        let corner_count = self.corner_vertex.len();
        let mut child = self.child(self.vertex_count + self.edge_vertices.len() + self.face_count(), 4 * corner_count);
        let first_edge = self.vertex_count as u32;
        let first_face = first_edge + self.edge_vertices.len() as u32;
        let first_inner = 2 * self.edge_vertices.len() as u32;
        for face in 0..self.face_count() {
            let center = first_face + face as u32;
            for corner in self.corners(face) {
                let before = self.previous(face, corner);
                let (vertex, edge, edge_before) = (self.corner_vertex[corner], self.corner_edge[corner], self.corner_edge[before]);
                child.corner_vertex.extend_from_slice(&[vertex, first_edge + edge, center, first_edge + edge_before]);
                child.corner_edge.extend_from_slice(&[
                    self.half_edge(edge, vertex),
                    first_inner + corner as u32,
                    first_inner + before as u32,
                    self.half_edge(edge_before, vertex),
                ]);
                child.edge_vertices.push([first_edge + edge, center]);
            }
        }
        child.face_start = (0..=corner_count as u32).map(|face| 4 * face).collect();
        child.face_size = 4;
        child.close();
        child
    }

    /// The next level of triangles, all faces being triangles; face `f` becomes `4 f` to `4 f + 3`, the middle one last.
    pub(crate) fn split_to_triangles(&self) -> Self {
        let corner_count = self.corner_vertex.len();
        let mut child = self.child(self.vertex_count + self.edge_vertices.len(), 4 * corner_count);
        let first_edge = self.vertex_count as u32;
        let first_inner = 2 * self.edge_vertices.len() as u32;
        for face in 0..self.face_count() {
            for corner in self.corners(face) {
                let before = self.previous(face, corner);
                let (vertex, edge, edge_before) = (self.corner_vertex[corner], self.corner_edge[corner], self.corner_edge[before]);
                child.corner_vertex.extend_from_slice(&[vertex, first_edge + edge, first_edge + edge_before]);
                child.corner_edge.extend_from_slice(&[
                    self.half_edge(edge, vertex),
                    first_inner + corner as u32,
                    self.half_edge(edge_before, vertex),
                ]);
                child.edge_vertices.push([first_edge + edge, first_edge + edge_before]);
            }
            for corner in self.corners(face) {
                child.corner_vertex.push(first_edge + self.corner_edge[corner]);
                child.corner_edge.push(first_inner + self.next(face, corner) as u32);
            }
        }
        child.face_start = (0..=4 * self.face_count() as u32).map(|face| 3 * face).collect();
        child.face_size = 3;
        child.close();
        child
    }

    /// What both splits share: halved edges, sharpness one less.
    fn child(&self, vertex_count: usize, corner_count: usize) -> Self {
        let edge_count = 2 * self.edge_vertices.len() + self.corner_vertex.len();
        let mut child = Self {
            vertex_count,
            corner_vertex: Vec::with_capacity(corner_count),
            corner_edge: Vec::with_capacity(corner_count),
            edge_vertices: Vec::with_capacity(edge_count),
            edge_sharpness: Vec::with_capacity(edge_count),
            vertex_sharpness: self.vertex_sharpness.iter().map(|&sharpness| reduced(sharpness)).collect(),
            ..Self::default()
        };
        for (edge, (&[a, b], &sharpness)) in self.edge_vertices.iter().zip(&self.edge_sharpness).enumerate() {
            let middle = (self.vertex_count + edge) as u32;
            child.edge_vertices.extend_from_slice(&[[a, middle], [middle, b]]);
            child.edge_sharpness.extend_from_slice(&[reduced(sharpness); 2]);
        }
        child.edge_sharpness.resize(edge_count, 0.0);
        child.vertex_sharpness.resize(vertex_count, 0.0);
        child
    }

    /// Links corners with their edges. Edges that fold back on themselves leave halves without faces, which must not pass
    /// for smooth.
    fn close(&mut self) {
        self.link_corners();
        for (sharpness, corners) in self.edge_sharpness.iter_mut().zip(&self.edge_corners) {
            if corners[1] == NONE {
                *sharpness = INFINITE;
            }
        }
    }

    /// Number of the half of `edge` that touches `vertex`.
    fn half_edge(&self, edge: u32, vertex: u32) -> u32 {
        2 * edge + u32::from(self.edge_vertices[edge as usize][0] != vertex)
    }
}

/// Sharpness one level further.
pub(crate) fn reduced(sharpness: f32) -> f32 {
    if sharpness >= INFINITE { sharpness } else { (sharpness - 1.0).max(0.0) }
}
