//! The kinds of leaves that a BLAS may have: what a reference to one of them means.

use super::blas::Blas;
use super::node::{ChildRef, Kind};
use crate::intersect::leaf::LeafVisitor;
use gonio_simd::prefetch;

impl Blas {
    /// Has memory fetch a child of a node.
    #[inline(always)]
    pub(crate) fn fetch(&self, child: ChildRef) {
        if child.is_inner() {
            prefetch(&self.nodes, child.index());
        } else if child.is(Kind::Triangles) {
            prefetch(&self.blocks, child.index());
        } else {
            self.smooth.fetch(child.index());
        }
    }

    /// Shows a visitor a leaf of a tree that stands still.
    #[inline(always)]
    pub(crate) fn leaf<V: LeafVisitor>(&self, leaf: ChildRef, visitor: V) -> V::Outcome {
        if leaf.is(Kind::Triangles) { visitor.visit(&self.blocks[leaf.index()]) } else { visitor.visit(self.smooth.leaf(leaf.index())) }
    }

    /// Shows a visitor a leaf as it is at a time of the shutter.
    #[inline(always)]
    pub(crate) fn leaf_at<V: LeafVisitor>(&self, leaf: ChildRef, time: f32, visitor: V) -> V::Outcome {
        if self.is_still() {
            self.leaf(leaf, visitor)
        } else if leaf.is(Kind::Triangles) {
            visitor.visit(&self.block_at(leaf.index(), time))
        } else {
            self.moved_smooth(leaf.index(), time, visitor)
        }
    }

    /// A leaf of curves or points that move; apart, because triangles shall not pay for its room on the stack.
    #[inline(never)]
    fn moved_smooth<V: LeafVisitor>(&self, leaf: usize, time: f32, visitor: V) -> V::Outcome {
        visitor.visit(self.smooth_at(leaf, time).leaf())
    }
}
