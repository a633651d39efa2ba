//! Collapse of a binary tree into 8-wide nodes, exact by dynamic programming.
//!
//! Ylitie, Karras, Laine: Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs (HPG 2017), section 3.1: for every binary
//! node and every number of slots 1 to 7, the cheapest forest that represents the subtree. Costs are half areas times one constant for a
//! node and one for a leaf block. Only the decisions are kept, in `Link::plan`: three bits for every number of slots.

use super::flat_tree::{FlatNode, Link};
use crate::tree::node::{Kind, WIDTH};
use obvhs::aabb::Aabb;

/// How the primitives of one leaf are put together.
pub(crate) trait LeafMaker: Sync {
    /// What a leaf holds.
    type Leaf: Send + Copy;
    /// What may lie in a leaf.
    const RULE: LeafRule;
    /// The kind that refers to these leaves.
    const KIND: Kind;
    /// Builds the leaf of these primitives (at least one, sorted).
    fn leaf(&self, primitives: &[u32]) -> Self::Leaf;
}

/// What may lie in one leaf, and its price.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafRule {
    /// The most primitives of a leaf, at most eight.
    pub(crate) capacity: u32,
    /// The price of a leaf, in units of the price of a node.
    pub(crate) cost: f32,
}

/// The outcome of the dynamic programme at one binary node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forest {
    pub(crate) bounds: Aabb,
    /// Primitives below.
    count: u32,
    /// The least cost with 1 to 7 slots.
    cost: [f32; WIDTH - 1],
}

/// Bits of a plan for one number of slots.
const PLAN_BITS: u32 = 3;

/// For one slot: 0 for a leaf, else the slots of eight that go left when the node becomes a wide one. For 2 to 7 slots: the slots that go
/// left, or 0 where fewer slots are as cheap.
pub(super) fn planned(node: Link, slots: u8) -> u8 {
    ((node.plan >> (PLAN_BITS * u32::from(slots - 1))) & 7) as u8
}

/// The node is to become a leaf.
pub(super) fn is_leaf(node: Link) -> bool {
    planned(node, 1) == 0
}

impl Forest {
    /// The outcome at a leaf of the binary tree.
    pub(crate) fn leaf(bounds: Aabb, count: u32, rule: LeafRule) -> Self {
        Forest { bounds, count, cost: [bounds.half_area() * rule.cost; WIDTH - 1] }
    }
}

/// Runs the dynamic programme over one tree in preorder, from the outcomes at its leaves, and gives the inner nodes their boxes; the outcome at
/// its root, if there is one.
pub(super) fn plan(tree: &mut [FlatNode], rule: LeafRule, leaf: impl Fn(&FlatNode) -> Option<Forest>) -> Option<Forest> {
    // Backwards, both subtrees of a node lie on the stack when it is met, the left one on top.
    let mut stack: Vec<Forest> = Vec::new();
    for node in tree.iter_mut().rev() {
        if node.link.is_last() {
            stack.push(leaf(node)?);
        } else {
            let (left, right) = (stack.pop()?, stack.pop()?);
            let (forest, plan) = forest(&left, &right, rule);
            node.set_box(&forest.bounds);
            node.link.plan = plan;
            stack.push(forest);
        }
    }
    stack.pop()
}

/// The outcome at a node, and its plan, from those at its children.
fn forest(left: &Forest, right: &Forest, rule: LeafRule) -> (Forest, u32) {
    let bounds = left.bounds.union(&right.bounds);
    let area = bounds.half_area();
    let count = left.count + right.count;
    let leaf_cost = if count <= rule.capacity { area * rule.cost } else { f32::INFINITY };
    let mut cost = [0.0; WIDTH - 1];
    let (below, split) = cheapest(left, right, WIDTH);
    let inner_cost = below + area;
    cost[0] = leaf_cost.min(inner_cost);
    let mut plan = if leaf_cost <= inner_cost { 0 } else { split };
    for slots in 2..WIDTH {
        let (sum, to_left) = cheapest(left, right, slots);
        let better = sum < cost[slots - 2];
        cost[slots - 1] = if better { sum } else { cost[slots - 2] };
        plan |= if better { to_left << (PLAN_BITS * (slots as u32 - 1)) } else { 0 };
    }
    (Forest { bounds, count, cost }, plan)
}

/// The cheapest way to share slots between two subtrees: the cost, and the slots of the left one.
#[inline(always)]
fn cheapest(left: &Forest, right: &Forest, slots: usize) -> (f32, u32) {
    let mut best = (f32::INFINITY, 1u32);
    for to_left in 1..slots {
        let sum = left.cost[to_left - 1] + right.cost[slots - to_left - 1];
        if sum < best.0 {
            best = (sum, to_left as u32);
        }
    }
    best
}
