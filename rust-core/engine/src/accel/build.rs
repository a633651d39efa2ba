//! Construction of the two kinds of trees: boxes, binary tree, collapse.
//!
//! A large mesh is cut into groups of neighbours, each clustered on its own and in parallel, which also keeps it in the caches. Then the
//! largest nodes of these trees are opened, and what hangs below them is clustered anew across the groups' borders and improved by
//! reinsertion. Nothing depends on the number of threads.

mod groups;

use super::Cancelled;
use super::collapse::{LeafMaker, WideTree, collapse};
use super::flat_tree::{Below, FlatNode, Part, balanced, flatten};
use super::node::{Bounds, MAX_DEPTH, Node};
use glam::Vec3A;
use groups::groups;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use rayon::prelude::*;
use std::collections::BinaryHeap;
use std::sync::atomic::{AtomicBool, Ordering};

/// How a set of boxes is clustered.
#[derive(Clone, Copy)]
struct Clustering {
    search_distance: PlocSearchDistance,
    /// First rounds that look at direct neighbours alone.
    short_rounds: usize,
}

/// How much time goes into the binary tree.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// The clustering inside of groups; without it there are none.
    groups: Option<Clustering>,
    /// The clustering of what hangs below the opened nodes.
    top: Clustering,
    /// Share of the top tree's nodes that is tried at other places.
    reinsertion: f32,
}

impl Effort {
    /// For meshes: fewer opened nodes or a shorter search make cheaper builds, but trees some percent worse by the area heuristic.
    pub(super) const MESH: Effort = Effort {
        groups: Some(Clustering { search_distance: PlocSearchDistance::Low, short_rounds: 2 }),
        top: Clustering { search_distance: PlocSearchDistance::Medium, short_rounds: 0 },
        reinsertion: 0.15,
    };
    /// For the few boxes of a top level that every ray meets.
    pub(super) const SCENE: Effort =
        Effort { groups: None, top: Clustering { search_distance: PlocSearchDistance::High, short_rounds: 1 }, reinsertion: 0.5 };
}

/// A group's tree has one node in this many opened.
const OPENED: usize = 16;

/// Builds the wide tree over the boxes that are not empty; primitive `i` of the leaf maker is box `i`.
pub(super) fn build<M: LeafMaker>(
    boxes: &[Bounds],
    maker: &M,
    effort: Effort,
    cancel: &AtomicBool,
) -> Result<WideTree<M::Leaf>, Cancelled> {
    let used: Vec<u32> = (0..boxes.len() as u32).filter(|&i| !boxes[i as usize].is_empty()).collect();
    if used.is_empty() {
        return Ok(WideTree { nodes: vec![Node::EMPTY], leaves: Vec::new(), depth: 1 });
    }
    let tree = binary_tree(boxes, &used, effort, cancel)?;
    let wide = collapse(&tree, maker, cancel)?;
    if wide.depth <= MAX_DEPTH {
        return Ok(wide);
    }
    collapse(&balanced(boxes, used), maker, cancel)
}

fn check(cancel: &AtomicBool) -> Result<(), Cancelled> {
    if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
}

/// Locally ordered clustering of the groups and of the top, then reinsertion in ever smaller batches (obvhs).
fn binary_tree(boxes: &[Bounds], used: &[u32], effort: Effort, cancel: &AtomicBool) -> Result<Vec<FlatNode>, Cancelled> {
    let (parts, below, aabbs) = match effort.groups {
        None => {
            let aabbs = used.iter().map(|&i| without_ties(boxes, i)).collect();
            (Vec::new(), used.iter().map(|&i| Below::Primitive(i)).collect(), aabbs)
        }
        Some(clustering) => {
            let parts: Result<Vec<Part>, Cancelled> = groups(boxes, used)
                .into_par_iter()
                .map(|group| {
                    check(cancel)?;
                    Ok(part(boxes, group, clustering))
                })
                .collect();
            let parts = parts?;
            let opened: Vec<(Below, Aabb)> = parts.par_iter().enumerate().flat_map_iter(|(i, part)| opened(part, i as u32)).collect();
            let (below, aabbs) = opened.into_iter().unzip();
            (parts, below, aabbs)
        }
    };
    let below: Vec<Below> = below;
    let aabbs: Vec<Aabb> = aabbs;
    let mut top = cluster(&aabbs, (0..aabbs.len() as u32).collect(), effort.top);
    let mut optimizer = ReinsertionOptimizer::default();
    for round in (1..32).step_by(2) {
        check(cancel)?;
        optimizer.run(&mut top, effort.reinsertion, Some(vec![1.0 / round as f32]));
    }
    check(cancel)?;
    Ok(flatten(&top, &below, &parts, boxes))
}

fn cluster(aabbs: &[Aabb], primitives: Vec<u32>, clustering: Clustering) -> Bvh2 {
    let mut builder = PlocBuilder::with_capacity(aabbs.len());
    builder.build(clustering.search_distance, aabbs, primitives, SortPrecision::U64, clustering.short_rounds)
}

/// The tree of one group.
fn part(boxes: &[Bounds], group: Vec<u32>, clustering: Clustering) -> Part {
    let aabbs: Vec<Aabb> = group.iter().map(|&i| without_ties(boxes, i)).collect();
    let tree = cluster(&aabbs, group, clustering);
    let mut counts = vec![1; tree.nodes.len()];
    // The builder puts children behind their parents.
    for (i, node) in tree.nodes.iter().enumerate().rev() {
        if !node.is_leaf() {
            counts[i] = counts[node.first_index as usize] + counts[node.first_index as usize + 1];
        }
    }
    Part { tree, counts }
}

/// What hangs below the largest nodes of a group's tree.
fn opened(part: &Part, number: u32) -> Vec<(Below, Aabb)> {
    let nodes = &part.tree.nodes;
    let key = |node: u32| (nodes[node as usize].aabb().half_area().to_bits(), node);
    let below = |node: u32| {
        let found = &nodes[node as usize];
        let below = if found.is_leaf() { Below::Primitive(found.first_index) } else { Below::Subtree { part: number, node } };
        (below, *found.aabb())
    };
    let budget = nodes.len() / OPENED + 1;
    let (mut out, mut heap) = (Vec::with_capacity(budget + 1), BinaryHeap::from([key(0)]));
    let mut done = 0;
    while let Some((_, node)) = heap.pop() {
        if nodes[node as usize].is_leaf() {
            out.push(below(node));
            continue;
        }
        heap.extend([0, 1].map(|side| key(nodes[node as usize].first_index + side)));
        done += 1;
        if done == budget {
            break;
        }
    }
    out.extend(heap.into_iter().map(|(_, node)| below(node)));
    out
}

/// The box of a primitive for the clustering, each plane moved outwards by a pseudo-random share, up to a thousandth, of the box's extent.
///
/// Without that, rows of equal boxes all prefer the same neighbour, one pair is joined a round, and the time grows with the square.
fn without_ties(boxes: &[Bounds], i: u32) -> Aabb {
    let b = &boxes[i as usize];
    let (mut min, mut max) = (b.min, b.max);
    let mut bits = (u64::from(i) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for axis in 0..3 {
        bits = (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let extent = (b.max[axis] - b.min[axis]) / 1024.0;
        min[axis] -= extent * (bits >> 40) as f32 / (1u32 << 24) as f32;
        max[axis] += extent * (bits & 0xff_ffff) as f32 / (1u32 << 24) as f32;
    }
    Aabb::new(Vec3A::from_array(min), Vec3A::from_array(max))
}
