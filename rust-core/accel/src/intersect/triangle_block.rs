//! Leaf of a mesh tree: up to eight triangles, structure of arrays.

use crate::ray::NONE;
use crate::tree::node::WIDTH;
use bytemuck::{Pod, Zeroable};

/// Up to eight triangles sorted by their number; unused lanes hold NaN, which no test accepts.
///
/// The intersection test (Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013) shears the vertices into the ray's
/// space, where the three edge functions are differences of two products. Both products round monotonously, so a sign is never wrong, and a
/// zero is accepted from both sides: a closed mesh has no gap at edges or vertices.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct TriangleBlock {
    /// `vertices[corner][axis][lane]`.
    pub(crate) vertices: [[[f32; WIDTH]; 3]; 3],
    /// The triangles' numbers in the mesh, [`NONE`] in unused lanes.
    pub(crate) primitives: [u32; WIDTH],
}

impl TriangleBlock {
    /// A block without triangles.
    pub(crate) const EMPTY: TriangleBlock = TriangleBlock { vertices: [[[f32::NAN; WIDTH]; 3]; 3], primitives: [NONE; WIDTH] };

    pub(crate) fn set(&mut self, lane: usize, corners: [[f32; 3]; 3], primitive: u32) {
        for (rows, corner) in self.vertices.iter_mut().zip(corners) {
            for (row, x) in rows.iter_mut().zip(corner) {
                row[lane] = x;
            }
        }
        self.primitives[lane] = primitive;
    }

    /// All of it as one row: a coordinate of a corner begins at `24 corner + 8 axis`.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> &[f32; 10 * WIDTH] {
        bytemuck::cast_ref(self)
    }

    /// The number of triangles.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        let mut n = 0;
        for primitive in self.primitives {
            n += usize::from(primitive != NONE);
        }
        n
    }
}

/// Distances and barycentric coordinates of eight triangles, valid in the lanes of a mask.
#[derive(Clone, Copy, Default)]
#[repr(C, align(32))]
pub(crate) struct BlockHits {
    pub(crate) t: [f32; WIDTH],
    pub(crate) u: [f32; WIDTH],
    pub(crate) v: [f32; WIDTH],
}
