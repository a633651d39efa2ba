//! Collapse of a binary tree into 8-wide nodes, exact by dynamic programming.
//!
//! Ylitie, Karras, Laine: Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs (HPG 2017), section 3.1: for every binary
//! node and every number of slots 1 to 7, the cheapest forest that represents the subtree. Costs are half areas times one constant for a
//! node and one for a leaf block.

use super::Cancelled;
use super::flat_tree::FlatNode;
use super::node::{ChildRef, Kind, Node, WIDTH};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// How the primitives of one leaf are put together.
pub(super) trait LeafMaker: Sync {
    /// What a leaf holds.
    type Leaf: Send + Copy;
    /// The most primitives of a leaf, at most eight.
    const CAPACITY: u32;
    /// The kind that refers to these leaves.
    const KIND: Kind;
    /// The price of a leaf, in units of the price of a node.
    const COST: f32;
    /// Builds the leaf of these primitives (at least one, sorted).
    fn leaf(&self, primitives: &[u32]) -> Self::Leaf;
}

/// The wide tree: the root is node 0, `depth` the number of nodes on its longest way down.
pub(super) struct WideTree<L> {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<L>,
    pub(super) depth: usize,
}

/// Subtrees of at most this many leaves are collapsed as one parallel task.
const TASK_LEAVES: usize = 1 << 12;

/// Collapses a tree that is not empty.
pub(super) fn collapse<M: LeafMaker>(tree: &[FlatNode], maker: &M, cancel: &AtomicBool) -> Result<WideTree<M::Leaf>, Cancelled> {
    let check = || if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) };
    let splits = choose::<M>(tree, cancel)?;
    let mut top = Emitter { tree, splits: &splits, kind: M::KIND, nodes: vec![Node::EMPTY], leaves: Vec::new(), depth: 1 };
    let tasks = top.emit(Pending { place: 0, node: 0, depth: 1 }, TASK_LEAVES);
    let parts: Result<Vec<(Pending, Emitter)>, Cancelled> = tasks
        .into_par_iter()
        .map(|task| {
            check()?;
            let guess = tree[task.place as usize].count() as usize / 4 + 1;
            let (mut nodes, leaves) = (Vec::with_capacity(guess / 4), Vec::with_capacity(guess));
            nodes.push(Node::EMPTY);
            let mut part = Emitter { tree, splits: &splits, kind: M::KIND, nodes, leaves, depth: task.depth };
            part.emit(Pending { node: 0, ..task }, 0);
            Ok((task, part))
        })
        .collect();
    let (nodes, places, depth) = join(top, parts?);
    check()?;
    let leaves = places.par_iter().with_min_len(64).map(|&place| leaf(tree, maker, place as usize)).collect();
    Ok(WideTree { nodes, leaves, depth })
}

/// Puts the parts behind the top: a part's first node goes to its reserved place, the others behind.
fn join(top: Emitter, parts: Vec<(Pending, Emitter)>) -> (Vec<Node>, Vec<u32>, usize) {
    let Emitter { nodes: top_nodes, mut leaves, mut depth, .. } = top;
    // Only the tree's own memory shall stay, without the growth of the top's.
    let mut nodes = Vec::with_capacity(top_nodes.len() + parts.iter().map(|(_, part)| part.nodes.len() - 1).sum::<usize>());
    nodes.extend_from_slice(&top_nodes);
    leaves.reserve_exact(parts.iter().map(|(_, part)| part.leaves.len()).sum());
    for (task, part) in parts {
        // Node 1 of the part becomes node `nodes.len()`.
        let (node_shift, leaf_shift) = (nodes.len() - 1, leaves.len());
        let moved = |mut node: Node| {
            for child in &mut node.children {
                *child = child.shifted(node_shift, leaf_shift);
            }
            node
        };
        nodes[task.node as usize] = moved(part.nodes[0]);
        nodes.extend(part.nodes[1..].iter().map(|&node| moved(node)));
        leaves.extend_from_slice(&part.leaves);
        depth = depth.max(part.depth);
    }
    (nodes, leaves, depth)
}

/// Makes the leaf of the subtree at `place`.
fn leaf<M: LeafMaker>(tree: &[FlatNode], maker: &M, place: usize) -> M::Leaf {
    let mut primitives = [0u32; WIDTH];
    let mut n = 0;
    for node in &tree[place..place + 2 * tree[place].count() as usize - 1] {
        if node.right == 0 {
            let mut lane = n;
            while lane > 0 && primitives[lane - 1] > node.payload {
                primitives[lane] = primitives[lane - 1];
                lane -= 1;
            }
            primitives[lane] = node.payload;
            n += 1;
        }
    }
    maker.leaf(&primitives[..n])
}

/// A binary node that becomes a wide node at a reserved place.
#[derive(Clone, Copy)]
struct Pending {
    place: u32,
    node: u32,
    depth: usize,
}

struct Emitter<'a> {
    tree: &'a [FlatNode],
    splits: &'a [Split],
    /// What the leaves are.
    kind: Kind,
    nodes: Vec<Node>,
    /// The places of the binary nodes that become leaves.
    leaves: Vec<u32>,
    depth: usize,
}

impl Emitter<'_> {
    /// Emits the subtree below `start`; subtrees of at most `task_leaves` primitives are returned instead, their first node reserved.
    fn emit(&mut self, start: Pending, task_leaves: usize) -> Vec<Pending> {
        let mut tasks = Vec::new();
        let mut stack = vec![start];
        while let Some(pending) = stack.pop() {
            if self.tree[pending.place as usize].count() as usize <= task_leaves {
                tasks.push(pending);
                continue;
            }
            self.depth = self.depth.max(pending.depth);
            let (slots, n) = self.slots(pending.place);
            let mut node = Node::EMPTY;
            for (slot, &place) in slots[..n].iter().enumerate() {
                let child = if self.splits[place as usize][1] == 0 {
                    self.leaves.push(place);
                    ChildRef::new(self.kind, self.leaves.len() - 1)
                } else {
                    self.nodes.push(Node::EMPTY);
                    let index = self.nodes.len() - 1;
                    stack.push(Pending { place, node: index as u32, depth: pending.depth + 1 });
                    ChildRef::new(Kind::Inner, index)
                };
                node.set(slot, &self.tree[place as usize].bounds, child);
            }
            self.nodes[pending.node as usize] = node;
        }
        tasks
    }

    /// The binary nodes in the slots of a wide node, smallest area first.
    fn slots(&self, place: u32) -> ([u32; WIDTH], usize) {
        let mut slots = [(0.0f32, 0u32); WIDTH];
        let mut n = 0;
        let mut open = [(0u32, 0u8); WIDTH];
        let split = self.splits[place as usize][1];
        let mut top = 1;
        if split == 0 {
            open[0] = (place, 1);
        } else {
            open[0] = (self.tree[place as usize].right, WIDTH as u8 - split);
            open[1] = (place + 1, split);
            top = 2;
        }
        while top > 0 {
            top -= 1;
            let (place, mut budget) = open[top];
            let node = &self.tree[place as usize];
            let choice = &self.splits[place as usize];
            while budget > 1 && choice[budget as usize] == 0 {
                budget -= 1;
            }
            if budget > 1 {
                let left = choice[budget as usize];
                open[top] = (node.right, budget - left);
                open[top + 1] = (place + 1, left);
                top += 2;
                continue;
            }
            let area = node.bounds.half_area();
            let mut slot = n;
            while slot > 0 && slots[slot - 1].0 > area {
                slots[slot] = slots[slot - 1];
                slot -= 1;
            }
            slots[slot] = (area, place);
            n += 1;
        }
        (slots.map(|(_, place)| place), n)
    }
}

/// The outcome of the dynamic programme at one binary node.
///
/// Entry 1 is 0 for a leaf, else the slots of eight that go left when the node becomes a wide one. Entry `i` for 2 to 7 slots is the slots
/// that go left, or 0 where fewer slots are as cheap. Entry 0 is not used.
type Split = [u8; WIDTH];

/// The least cost of a subtree with 1 to 7 slots.
type Costs = [f32; WIDTH - 1];

/// Runs the dynamic programme: small subtrees in parallel, then what lies above them.
fn choose<M: LeafMaker>(tree: &[FlatNode], cancel: &AtomicBool) -> Result<Vec<Split>, Cancelled> {
    let ranges = cut(tree);
    let mut splits: Vec<Split> = vec![[0; WIDTH]; tree.len()];
    let mut parts = Vec::with_capacity(ranges.len());
    let mut rest = &mut splits[..];
    for &(start, end) in &ranges {
        let (part, behind) = std::mem::take(&mut rest).split_at_mut(end - start);
        parts.push((start, part));
        rest = behind;
    }
    let is_above = |start: usize, places: usize| places == 1 && tree[start].right != 0;
    let roots: Vec<Costs> = parts
        .par_iter_mut()
        .map(|(start, part)| {
            let mut stack = Vec::new();
            if !is_above(*start, part.len()) && !cancel.load(Ordering::Relaxed) {
                for place in (0..part.len()).rev() {
                    step::<M>(&tree[*start + place], &mut part[place], &mut stack);
                }
            }
            stack.pop().unwrap_or_default()
        })
        .collect();
    let mut stack = Vec::new();
    for ((start, part), costs) in parts.iter_mut().zip(roots).rev() {
        if is_above(*start, part.len()) {
            step::<M>(&tree[*start], &mut part[0], &mut stack);
        } else {
            stack.push(costs);
        }
    }
    if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(splits) }
}

/// Cuts the tree into the largest subtrees of at most `TASK_LEAVES` leaves and the single nodes above them, in rising order.
fn cut(tree: &[FlatNode]) -> Vec<(usize, usize)> {
    let mut ranges = Vec::new();
    let mut stack = vec![(0, tree.len())];
    while let Some((place, end)) = stack.pop() {
        if end - place < 2 * TASK_LEAVES {
            ranges.push((place, end));
            continue;
        }
        ranges.push((place, place + 1));
        let right = tree[place].right as usize;
        stack.push((right, end));
        stack.push((place + 1, right));
    }
    ranges
}

/// One node of a walk against the preorder: takes the costs of its children, the left one's on top, from the stack and leaves its own.
#[inline(always)]
fn step<M: LeafMaker>(node: &FlatNode, split: &mut Split, stack: &mut Vec<Costs>) {
    let leaf_area = node.bounds.half_area() * M::COST;
    if node.right == 0 {
        stack.push([leaf_area; WIDTH - 1]);
        return;
    }
    let (Some(left), Some(right)) = (stack.pop(), stack.pop()) else { return };
    let leaf_cost = if node.count() <= M::CAPACITY { leaf_area } else { f32::INFINITY };
    let (below, to_left) = cheapest::<WIDTH>(&left, &right);
    let inner_cost = below + node.bounds.half_area();
    let mut costs: Costs = [leaf_cost.min(inner_cost); WIDTH - 1];
    split[1] = if leaf_cost <= inner_cost { 0 } else { to_left };
    let shared = [
        cheapest::<2>(&left, &right),
        cheapest::<3>(&left, &right),
        cheapest::<4>(&left, &right),
        cheapest::<5>(&left, &right),
        cheapest::<6>(&left, &right),
        cheapest::<7>(&left, &right),
    ];
    for (i, (sum, to_left)) in shared.into_iter().enumerate() {
        let better = sum < costs[i];
        costs[i + 1] = if better { sum } else { costs[i] };
        split[i + 2] = if better { to_left } else { 0 };
    }
    stack.push(costs);
}

/// The cheapest way to share slots between two subtrees: the cost, and the slots of the left one.
#[inline(always)]
fn cheapest<const SLOTS: usize>(left: &Costs, right: &Costs) -> (f32, u8) {
    let mut best = (f32::INFINITY, 1u8);
    for to_left in 1..SLOTS {
        let sum = left[to_left - 1] + right[SLOTS - to_left - 1];
        best = if sum < best.0 { (sum, to_left as u8) } else { best };
    }
    best
}
