//! Refitting a BLAS: the tree of a mesh whose points moved, fitted to them rather than built anew.

use super::blas::{Blas, corners, outline, sah_cost, triangle_bounds};
use super::node::{Bounds, ChildRef, Node, WIDTH};
use crate::intersect::smooth::Smooth;
use crate::intersect::triangle_block::TriangleBlock;
use crate::ray::NONE;
use rayon::prelude::*;

/// A fitted tree whose boxes have grown by more than this over those of the built one is not worth having.
const MOST_GROWTH: f32 = 1.4;

impl Blas {
    /// The tree for the same triangles over points that moved, in a tenth of the time of a build; `triangles` are those it was built from.
    ///
    /// None if a triangle was or is left out that is or was in it, or if rays would be much slower than in a built tree. Runs in the current
    /// rayon pool.
    pub fn refit(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Option<Blas> {
        let placed = |triangle: &[u32; 3]| {
            let corners = corners(positions, triangle)?;
            Some((corners, triangle_bounds(&corners)?))
        };
        if !self.is_still() {
            return None;
        }
        // Where all are in the tree, none can enter, and one that leaves is found below.
        let all = self.triangles == triangles.len();
        if !all && triangles.par_iter().filter_map(placed).count() != self.triangles {
            return None;
        }
        let fitted = |block: &TriangleBlock| fitted(block, |triangle| placed(&triangles[triangle]));
        let (blocks, boxes): (Vec<TriangleBlock>, Vec<Option<Bounds>>) = self.blocks.par_iter().map(fitted).unzip();
        let boxes: Vec<Bounds> = boxes.into_iter().collect::<Option<_>>()?;
        let (nodes, bounds) = fit_nodes(&self.nodes, &boxes);
        let fitting = sah_cost(&nodes, &bounds) <= self.sah_cost * MOST_GROWTH;
        let outline = outline(&nodes, bounds);
        fitting.then_some(Blas {
            nodes,
            blocks,
            key_blocks: Vec::new(),
            keys: 0,
            smooth: Smooth::Nothing,
            moving_smooth: None,
            outline,
            triangles: self.triangles,
            sah_cost: self.sah_cost,
        })
    }
}

/// A block with its triangles where they are now, and their box, if all of them are usable.
fn fitted(block: &TriangleBlock, placed: impl Fn(usize) -> Option<([[f32; 3]; 3], Bounds)>) -> (TriangleBlock, Option<Bounds>) {
    let mut moved = TriangleBlock::EMPTY;
    let mut all = Some(Bounds::EMPTY);
    for (lane, &primitive) in block.primitives.iter().enumerate().filter(|(_, primitive)| **primitive != NONE) {
        let triangle = placed(primitive as usize);
        if let Some((corners, _)) = triangle {
            moved.set(lane, corners, primitive);
        }
        all = all.zip(triangle).map(|(all, (_, bounds))| all.union(&bounds));
    }
    (moved, all)
}

/// The nodes with boxes from those of the leaves, and the box of all; children lie behind their parents.
fn fit_nodes(nodes: &[Node], leaves: &[Bounds]) -> (Vec<Node>, Bounds) {
    let mut nodes = nodes.to_vec();
    let mut boxes = vec![Bounds::EMPTY; nodes.len()];
    for place in (0..nodes.len()).rev() {
        let node = &mut nodes[place];
        for slot in 0..WIDTH {
            let child = node.children[slot];
            if child != ChildRef::ROOT {
                let bounds = if child.is_inner() { boxes[child.index()] } else { leaves[child.index()] };
                node.set(slot, &bounds, child);
                boxes[place] = boxes[place].union(&bounds);
            }
        }
    }
    (nodes, boxes[0])
}
