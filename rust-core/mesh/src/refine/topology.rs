//! Faces, edges and their neighbourhood at one level of subdivision, in flat arrays.

/// No face or corner.
pub(crate) const NONE: u32 = u32::MAX;

/// Sharpness from which an edge or vertex stays sharp for ever (the USD and OpenSubdiv convention).
pub(crate) const INFINITE: f32 = 10.0;

/// Topology of one level, for the points or for one face-varying channel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Level {
    pub(crate) vertex_count: usize,
    /// Corners of every face where all are triangles or all are quads, else 0.
    pub(crate) face_size: usize,
    /// First corner of each face, and the end.
    pub(crate) face_start: Vec<u32>,
    pub(crate) corner_vertex: Vec<u32>,
    /// Edge from each corner to the next one of its face.
    pub(crate) corner_edge: Vec<u32>,
    pub(crate) edge_vertices: Vec<[u32; 2]>,
    /// The two corners that run along each edge, `NONE` where missing; more than two only with `is_manifold` false.
    pub(crate) edge_corners: Vec<[u32; 2]>,
    pub(crate) edge_sharpness: Vec<f32>,
    pub(crate) vertex_sharpness: Vec<f32>,
}

impl Level {
    /// Finds the edges of faces given by `face_start` and `corner_vertex`. Sharpness is 0 inside and infinite at
    /// boundaries and at edges that more than two faces, or two faces of opposite orientation, share.
    pub(crate) fn new(vertex_count: usize, face_start: Vec<u32>, corner_vertex: Vec<u32>) -> Self {
        let is_all = |size: u32| face_start.windows(2).all(|pair| pair[1] - pair[0] == size);
        let face_size = [3, 4].into_iter().find(|&size| is_all(size)).unwrap_or(0) as usize;
        let mut level = Self {
            vertex_count,
            face_size,
            corner_edge: vec![0; corner_vertex.len()],
            face_start,
            corner_vertex,
            vertex_sharpness: vec![0.0; vertex_count],
            ..Self::default()
        };
        let mut keys = level.edge_keys();
        keys.sort_unstable();
        let mut last = None;
        for &(ends, corner) in &keys {
            if last != Some(ends) {
                last = Some(ends);
                level.edge_vertices.push([(ends >> 32) as u32, ends as u32]);
            }
            level.corner_edge[corner as usize] = (level.edge_vertices.len() - 1) as u32;
        }
        level.edge_sharpness = vec![0.0; level.edge_vertices.len()];
        for edge in level.link_corners() {
            level.edge_sharpness[edge as usize] = INFINITE;
        }
        for edge in 0..level.edge_vertices.len() {
            if !level.is_manifold(edge) {
                level.edge_sharpness[edge] = INFINITE;
            }
        }
        level
    }

    /// (smaller vertex, larger vertex, corner) of each half-edge.
    fn edge_keys(&self) -> Vec<(u64, u32)> {
        let mut keys = Vec::with_capacity(self.corner_vertex.len());
        for face in 0..self.face_count() {
            for corner in self.corners(face) {
                let (a, b) = (self.corner_vertex[corner], self.corner_vertex[self.next(face, corner)]);
                keys.push((u64::from(a.min(b)) << 32 | u64::from(a.max(b)), corner as u32));
            }
        }
        keys
    }

    /// Fills `edge_corners`; returns the edges with more than two faces.
    pub(super) fn link_corners(&mut self) -> Vec<u32> {
        let mut crowded = Vec::new();
        self.edge_corners = vec![[NONE; 2]; self.edge_vertices.len()];
        for (corner, &edge) in self.corner_edge.iter().enumerate() {
            let slots = &mut self.edge_corners[edge as usize];
            match slots.iter_mut().find(|slot| **slot == NONE) {
                Some(slot) => *slot = corner as u32,
                None => crowded.push(edge),
            }
        }
        crowded
    }

    /// Whether two faces of the same orientation meet at the edge. Edges of more faces are recognised by their sharpness.
    pub(crate) fn is_manifold(&self, edge: usize) -> bool {
        let [a, b] = self.edge_corners[edge];
        let [from, to] = self.edge_vertices[edge];
        b != NONE && from != to && self.corner_vertex[a as usize] != self.corner_vertex[b as usize]
    }

    pub(crate) fn face_count(&self) -> usize {
        self.face_start.len() - 1
    }

    pub(crate) fn corners(&self, face: usize) -> std::ops::Range<usize> {
        self.face_start[face] as usize..self.face_start[face + 1] as usize
    }

    /// The corner after `corner` in its `face`.
    pub(crate) fn next(&self, face: usize, corner: usize) -> usize {
        if corner + 1 == self.face_start[face + 1] as usize { self.face_start[face] as usize } else { corner + 1 }
    }

    /// The corner before `corner` in its `face`.
    pub(crate) fn previous(&self, face: usize, corner: usize) -> usize {
        if corner == self.face_start[face] as usize { self.face_start[face + 1] as usize - 1 } else { corner - 1 }
    }

    /// The edge between two vertices, on a level made by [`Level::new`] (whose edges are sorted).
    pub(super) fn find_edge(&self, a: u32, b: u32) -> Option<usize> {
        self.edge_vertices.binary_search(&[a.min(b), a.max(b)]).ok()
    }

    /// (first corner of the face, number of its corners) of a corner. The common sizes are spelled out because this is
    /// the innermost step of all walks and division by a constant is cheap.
    #[inline]
    pub(crate) fn face_around(&self, corner: usize) -> (usize, usize) {
        match self.face_size {
            4 => (corner & !3, 4),
            3 => (corner - corner % 3, 3),
            _ => {
                let face = self.face_start.partition_point(|&start| start as usize <= corner) - 1;
                let first = self.face_start[face] as usize;
                (first, self.face_start[face + 1] as usize - first)
            }
        }
    }

    /// The corner after `corner` in its face.
    #[inline]
    pub(crate) fn after(&self, corner: usize) -> usize {
        let (first, size) = self.face_around(corner);
        if corner + 1 == first + size { first } else { corner + 1 }
    }

    /// The corner before `corner` in its face.
    #[inline]
    pub(crate) fn before(&self, corner: usize) -> usize {
        let (first, size) = self.face_around(corner);
        if corner == first { first + size - 1 } else { corner - 1 }
    }

    /// Face of each corner.
    pub(crate) fn corner_faces(&self) -> Vec<u32> {
        let mut faces = Vec::with_capacity(self.corner_vertex.len());
        for face in 0..self.face_count() {
            faces.resize(self.face_start[face + 1] as usize, face as u32);
        }
        faces
    }
}
