//! Binary trees by obvhs: locally ordered clustering, then reinsertion.

use super::effort::Effort;
use crate::cancelled::Cancelled;
use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::bvh2::{Bvh2, node::Bvh2Node};
use obvhs::ploc::{PlocBuilder, SortPrecision};
use std::sync::atomic::AtomicBool;

/// The memory of clusterings, kept from one to the next.
#[derive(Default)]
pub(super) struct Clusters {
    builder: PlocBuilder,
    tree: Bvh2,
    optimizer: ReinsertionOptimizer,
}

impl Clusters {
    /// The binary tree over boxes, of which there is at least one: the leaf of box `i` has first index `i`.
    pub(super) fn tree(&mut self, boxes: &[Aabb], effort: Effort, cancel: &AtomicBool) -> Result<&Bvh2, Cancelled> {
        let Clusters { builder, tree, optimizer } = self;
        tree.reset_for_reuse(boxes.len(), None);
        builder.current_nodes.clear();
        builder.current_nodes.extend(boxes.iter().enumerate().map(|(i, bounds)| Bvh2Node::new(without_ties(i, bounds), 1, i as u32)));
        let around = cube(&boxes.iter().fold(Aabb::empty(), |all, b| all.union(b)));
        if effort.far {
            builder.build_ploc_from_leaves::<24, false>(tree, around, SortPrecision::U64, effort.short_rounds);
        } else {
            builder.build_ploc_from_leaves::<6, false>(tree, around, SortPrecision::U64, effort.short_rounds);
        }
        // Reinsertion in ever smaller batches.
        for round in (1..32).step_by(2).filter(|_| effort.reinsertion > 0.0) {
            Cancelled::check(cancel)?;
            optimizer.run(tree, effort.reinsertion, Some(vec![1.0 / round as f32]));
        }
        Ok(tree)
    }
}

/// A box for the clustering, each plane moved outwards by a pseudo-random share, up to a thousandth, of the box's extent.
///
/// Without that, rows of equal boxes all prefer the same neighbour, one pair is joined a round, and the time grows with the square.
fn without_ties(i: usize, b: &Aabb) -> Aabb {
    let bits = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 4;
    let share = |first: u32| ((bits >> first) & 0x3ff) as f32;
    let unit = b.diagonal() * (1.0 / (1u32 << 20) as f32);
    Aabb::new(b.min - unit * Vec3A::new(share(0), share(10), share(20)), b.max + unit * Vec3A::new(share(30), share(40), share(50)))
}

/// The cube at a box's lowest corner that holds it: a Morton curve through it favours no axis.
fn cube(bounds: &Aabb) -> Aabb {
    Aabb::new(bounds.min, bounds.min + bounds.diagonal().max_element())
}
