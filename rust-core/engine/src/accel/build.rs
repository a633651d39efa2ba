//! Construction of the two kinds of trees: boxes, binary tree, collapse.

use super::Cancelled;
use super::collapse::{LeafMaker, WideTree, collapse};
use super::flat_tree::{FlatNode, balanced, flatten};
use super::node::{Bounds, MAX_DEPTH, Node};
use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Boxes for the clustering, each plane moved outwards by a pseudo-random share, up to a thousandth, of the box's extent.
///
/// Without that, rows of equal boxes all prefer the same neighbour, one pair is joined a round, and the time grows with the square.
fn without_ties(boxes: &[Bounds]) -> Vec<Aabb> {
    let moved = |(i, b): (usize, &Bounds)| {
        let (mut min, mut max) = (b.min, b.max);
        let mut bits = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        for axis in 0..3 {
            bits = (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let extent = (b.max[axis] - b.min[axis]) / 1024.0;
            min[axis] -= extent * (bits >> 40) as f32 / (1u32 << 24) as f32;
            max[axis] += extent * (bits & 0xff_ffff) as f32 / (1u32 << 24) as f32;
        }
        Aabb::new(Vec3A::from_array(min), Vec3A::from_array(max))
    };
    boxes.par_iter().enumerate().map(moved).collect()
}

/// How much time goes into the binary tree.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    search_distance: PlocSearchDistance,
    /// First rounds of the clustering that look at direct neighbours alone.
    short_rounds: usize,
    /// Share of the nodes that is tried at other places.
    reinsertion: f32,
}

impl Effort {
    /// For meshes: twice the search and the reinsertion made the build slower, and no ray faster beyond the noise, in a room of 280 thousand triangles.
    pub(super) const MESH: Effort = Effort { search_distance: PlocSearchDistance::Low, short_rounds: 2, reinsertion: 0.02 };
    /// For the few boxes of a top level that every ray meets.
    pub(super) const SCENE: Effort = Effort { search_distance: PlocSearchDistance::High, short_rounds: 1, reinsertion: 0.5 };
}

/// Builds the wide tree over boxes; primitive `i` of the leaf maker is box `i`.
pub(super) fn build<M: LeafMaker>(
    boxes: &[Bounds],
    maker: &M,
    effort: Effort,
    cancel: &AtomicBool,
) -> Result<WideTree<M::Leaf>, Cancelled> {
    if boxes.is_empty() {
        return Ok(WideTree { nodes: vec![Node::EMPTY], leaves: Vec::new(), depth: 1 });
    }
    let tree = binary_tree(boxes, effort, cancel)?;
    let wide = collapse(&tree, maker, cancel)?;
    if wide.depth <= MAX_DEPTH {
        return Ok(wide);
    }
    collapse(&balanced(boxes), maker, cancel)
}

/// Locally ordered clustering, then reinsertion in ever smaller batches (obvhs).
fn binary_tree(boxes: &[Bounds], effort: Effort, cancel: &AtomicBool) -> Result<Vec<FlatNode>, Cancelled> {
    let check = || if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) };
    let aabbs = without_ties(boxes);
    let primitives = (0..boxes.len() as u32).collect();
    let mut builder = PlocBuilder::with_capacity(boxes.len());
    let mut tree: Bvh2 = builder.build(effort.search_distance, &aabbs, primitives, SortPrecision::U64, effort.short_rounds);
    drop((builder, aabbs));
    let mut optimizer = ReinsertionOptimizer::default();
    for round in (1..32).step_by(2) {
        check()?;
        optimizer.run(&mut tree, effort.reinsertion, Some(vec![1.0 / round as f32]));
    }
    check()?;
    Ok(flatten(&tree, boxes))
}
