//! The 8-wide node shared by both levels of the tree.

use bytemuck::{Pod, Zeroable};

/// Children of a node, and triangles of a block.
pub(crate) const WIDTH: usize = 8;

/// Depth up to which a tree may grow; deeper trees are rebuilt balanced. Seven entries wait on the stack for every level.
pub(crate) const MAX_DEPTH: usize = 72;

/// Entries of a traversal stack, a power of two above `MAX_DEPTH * (WIDTH - 1) + 1`.
pub(crate) const STACK: usize = 512;

/// What a child slot refers to, or an entry of a traversal stack: three bits of kind and 29 bits of index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct ChildRef(pub(crate) u32);

/// Kinds of children. Those from 4 on lie in a mesh; 2 and 6 are free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum Kind {
    /// A node of the same tree.
    Inner = 0,
    /// One instance of the scene.
    Instance = 1,
    /// A block of triangles of the scene, in world space.
    WorldTriangles = 3,
    /// A node of a mesh, as in a stream, whose stacks hold nodes of the scene as well.
    MeshInner = 4,
    /// A block of triangles of a mesh.
    Triangles = 5,
    /// A block of pieces of curves, or of points, of a geometry that has no triangles.
    Smooth = 7,
}

/// Kinds that three bits can tell apart.
pub(crate) const KINDS: usize = 8;

const KIND_SHIFT: u32 = 29;
const INDEX_MASK: u32 = (1 << KIND_SHIFT) - 1;

impl ChildRef {
    /// The root of every tree.
    pub(crate) const ROOT: ChildRef = ChildRef(0);

    /// What lies below all entries of a traversal stack: a value that no child has, as its index is too large.
    pub(crate) const END: ChildRef = ChildRef(u32::MAX);

    pub(crate) fn new(kind: Kind, index: usize) -> Self {
        debug_assert!(index <= MAX_INDEX);
        ChildRef(((kind as u32) << KIND_SHIFT) | index as u32)
    }

    #[inline(always)]
    pub(crate) fn is_inner(self) -> bool {
        self.0 <= INDEX_MASK
    }

    #[inline(always)]
    pub(crate) fn is(self, kind: Kind) -> bool {
        self.0 >> KIND_SHIFT == kind as u32
    }

    /// The number of its kind, [`KINDS`] for the end of a stack: the carry of its index, so that no branch asks.
    #[inline(always)]
    pub(crate) fn kind_or_end(self) -> usize {
        ((u64::from(self.0) + 1) >> KIND_SHIFT) as usize
    }

    /// 1 in a mesh, else 0.
    #[inline(always)]
    pub(crate) fn space(self) -> usize {
        (self.0 >> 31) as usize
    }

    /// The bits that a node's children have from it: that of a mesh.
    #[inline(always)]
    pub(crate) fn child_bits(self) -> u32 {
        self.0 & (1 << 31)
    }

    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & INDEX_MASK) as usize
    }
}

/// The most leaf blocks or nodes a tree can address; one more is the index of [`ChildRef::END`].
pub(crate) const MAX_INDEX: usize = INDEX_MASK as usize - 1;

/// Eight boxes and what is in them; 256 bytes, four cache lines.
///
/// Slots are sorted by surface area, largest first; empty slots come last and hold an empty box, which no ray hits. The inner children of
/// a node lie next to each other in memory.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Rows: lowest x, y, z, then highest x, y, z.
    pub(crate) bounds: [[f32; WIDTH]; 6],
    /// What lies in each box.
    pub(crate) children: [ChildRef; WIDTH],
    /// Fills the last cache line.
    pub(crate) rest: [u32; WIDTH],
}

impl Node {
    /// A node without children.
    pub(crate) const EMPTY: Node = Node {
        bounds: [[f32::INFINITY; 8], [f32::INFINITY; 8], [f32::INFINITY; 8], [-f32::INFINITY; 8], [-f32::INFINITY; 8], [-f32::INFINITY; 8]],
        children: [ChildRef::ROOT; WIDTH],
        rest: [0; WIDTH],
    };

    /// All of it as one row: plane `axis`, slot `slot` at `8 axis + slot`.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> &[f32; 8 * WIDTH] {
        bytemuck::cast_ref(self)
    }

    pub(crate) fn set(&mut self, slot: usize, bounds: &Bounds, child: ChildRef) {
        for axis in 0..3 {
            self.bounds[axis][slot] = bounds.min[axis];
            self.bounds[axis + 3][slot] = bounds.max[axis];
        }
        self.children[slot] = child;
    }

    pub(crate) fn bounds_of(&self, slot: usize) -> Bounds {
        let [min, max] = [0, 3].map(|row| [0, 1, 2].map(|axis| self.bounds[row + axis][slot]));
        Bounds { min, max }
    }
}

/// An axis-aligned box; empty when `min > max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) min: [f32; 3],
    pub(crate) max: [f32; 3],
}

impl Bounds {
    pub(crate) const EMPTY: Bounds = Bounds { min: [f32::INFINITY; 3], max: [-f32::INFINITY; 3] };

    pub(crate) fn union(&self, other: &Bounds) -> Bounds {
        let mut out = *self;
        for axis in 0..3 {
            out.min[axis] = if other.min[axis] < out.min[axis] { other.min[axis] } else { out.min[axis] };
            out.max[axis] = if other.max[axis] > out.max[axis] { other.max[axis] } else { out.max[axis] };
        }
        out
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.min[0] > self.max[0]
    }

    /// Half the surface area, the measure of the surface area heuristic.
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.max[axis] - self.min[axis]);
        x * y + y * z + z * x
    }

    /// Widened by the share of the rounding error bound that depends on the coordinates (see `prepared.rs`).
    pub(crate) fn padded(&self) -> Self {
        let mut largest = 0.0f32;
        for axis in 0..3 {
            largest = largest.max(self.min[axis].abs()).max(self.max[axis].abs());
        }
        let pad = largest * ROUNDING_PAD;
        Bounds { min: self.min.map(|x| x - pad), max: self.max.map(|x| x + pad) }
    }
}

/// Boxes are widened by this share of the largest coordinate in play: eight units in the last place (2^-24) of f32.
///
/// What it must cover, in units of 2^-24 times the largest coordinate: 2.5 for the sheared vertex of the triangle test, 2.5 for the plane
/// distances of the box test.
pub(crate) const ROUNDING_PAD: f32 = 8.0 / (1u32 << 24) as f32;

/// Coordinates beyond this (in metres) are left out of the trees, so that no product in the tests overflows.
pub(crate) const LARGEST_COORDINATE: f32 = 1e12;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_child_is_the_end_of_a_stack() {
        for kind in [Kind::Inner, Kind::Instance, Kind::WorldTriangles, Kind::MeshInner, Kind::Triangles, Kind::Smooth] {
            for index in [0, 1, MAX_INDEX] {
                let child = ChildRef::new(kind, index);
                assert!(child != ChildRef::END && child.is(kind) && child.index() == index);
                assert_eq!(child.kind_or_end(), kind as usize);
            }
        }
        assert_eq!(ChildRef::END.kind_or_end(), KINDS);
    }
}
