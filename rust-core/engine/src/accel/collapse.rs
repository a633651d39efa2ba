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
const TASK_LEAVES: usize = 1 << 14;

/// Collapses a tree that is not empty.
pub(super) fn collapse<M: LeafMaker>(tree: &[FlatNode], maker: &M, cancel: &AtomicBool) -> Result<WideTree<M::Leaf>, Cancelled> {
    let choices = choose::<M>(tree, cancel)?;
    let mut top = Emitter { tree, choices: &choices, maker, nodes: vec![Node::EMPTY], leaves: Vec::new(), depth: 1 };
    let tasks = top.emit(Pending { place: 0, node: 0, depth: 1 }, TASK_LEAVES);
    let parts: Vec<(Pending, Emitter<M>)> = tasks
        .into_par_iter()
        .map(|task| {
            let guess = choices[task.place as usize].count as usize / 3 + 1;
            let (mut nodes, leaves) = (Vec::with_capacity(guess), Vec::with_capacity(guess));
            nodes.push(Node::EMPTY);
            let mut part = Emitter { tree, choices: &choices, maker, nodes, leaves, depth: task.depth };
            if !cancel.load(Ordering::Relaxed) {
                part.emit(Pending { node: 0, ..task }, 0);
            }
            (task, part)
        })
        .collect();
    if cancel.load(Ordering::Relaxed) {
        return Err(Cancelled);
    }
    Ok(join(top, parts))
}

/// Puts the parts behind the top: a part's first node goes to its reserved place, the others behind.
fn join<M: LeafMaker>(top: Emitter<M>, parts: Vec<(Pending, Emitter<M>)>) -> WideTree<M::Leaf> {
    let Emitter { mut nodes, mut leaves, mut depth, .. } = top;
    nodes.reserve_exact(parts.iter().map(|(_, part)| part.nodes.len() - 1).sum());
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
    WideTree { nodes, leaves, depth }
}

/// A binary node that becomes a wide node at a reserved place.
#[derive(Clone, Copy)]
struct Pending {
    place: u32,
    node: u32,
    depth: usize,
}

struct Emitter<'a, M: LeafMaker> {
    tree: &'a [FlatNode],
    choices: &'a [Choice],
    maker: &'a M,
    nodes: Vec<Node>,
    leaves: Vec<M::Leaf>,
    depth: usize,
}

impl<M: LeafMaker> Emitter<'_, M> {
    /// Emits the subtree below `start`; subtrees of at most `task_leaves` primitives are returned instead, their first node reserved.
    fn emit(&mut self, start: Pending, task_leaves: usize) -> Vec<Pending> {
        let mut tasks = Vec::new();
        let mut stack = vec![start];
        while let Some(pending) = stack.pop() {
            if self.choices[pending.place as usize].count as usize <= task_leaves {
                tasks.push(pending);
                continue;
            }
            self.depth = self.depth.max(pending.depth);
            let (slots, n) = self.slots(pending.place);
            let mut node = Node::EMPTY;
            for (slot, &place) in slots[..n].iter().enumerate() {
                let child = if self.choices[place as usize].split[1] == 0 {
                    self.emit_leaf(place)
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
        let split = self.choices[place as usize].split[1];
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
            let choice = &self.choices[place as usize].split;
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

    fn emit_leaf(&mut self, place: u32) -> ChildRef {
        let count = self.choices[place as usize].count as usize;
        let mut primitives = [0u32; WIDTH];
        let mut n = 0;
        for node in &self.tree[place as usize..place as usize + 2 * count - 1] {
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
        self.leaves.push(self.maker.leaf(&primitives[..n]));
        ChildRef::new(M::KIND, self.leaves.len() - 1)
    }
}

/// The outcome of the dynamic programme at one binary node.
#[derive(Clone, Copy)]
struct Choice {
    /// Primitives below.
    count: u32,
    /// The least cost with 1 to 7 slots.
    cost: [f32; WIDTH - 1],
    /// `split[1]` is 0 for a leaf, else the slots of eight that go left when the node becomes a wide one. `split[i]` for 2 to 7 slots is
    /// the slots that go left, or 0 where fewer slots are as cheap.
    split: [u8; WIDTH],
}

/// Runs the dynamic programme: small subtrees in parallel, then what lies above them.
fn choose<M: LeafMaker>(tree: &[FlatNode], cancel: &AtomicBool) -> Result<Vec<Choice>, Cancelled> {
    let (subtrees, above) = cut(tree);
    let mut choices = vec![Choice { count: 1, cost: [0.0; WIDTH - 1], split: [0; WIDTH] }; tree.len()];
    let mut parts = Vec::with_capacity(subtrees.len());
    let (mut rest, mut done) = (&mut choices[..], 0);
    for &(start, end) in &subtrees {
        let (_, from) = std::mem::take(&mut rest).split_at_mut(start - done);
        let (part, behind) = from.split_at_mut(end - start);
        parts.push((start, part));
        (rest, done) = (behind, end);
    }
    parts.into_par_iter().for_each(|(start, part)| {
        if !cancel.load(Ordering::Relaxed) {
            for place in (0..part.len()).rev() {
                part[place] = choice::<M>(&tree[start + place], part, start, start + place);
            }
        }
    });
    for &place in above.iter().rev() {
        choices[place] = choice::<M>(&tree[place], &choices, 0, place);
    }
    if cancel.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(choices) }
}

/// The ranges of the largest subtrees of at most `TASK_LEAVES` leaves, and the nodes above them, both in rising order.
fn cut(tree: &[FlatNode]) -> (Vec<(usize, usize)>, Vec<usize>) {
    let (mut subtrees, mut above) = (Vec::new(), Vec::new());
    let mut stack = vec![(0, tree.len())];
    while let Some((place, end)) = stack.pop() {
        if end - place < 2 * TASK_LEAVES {
            subtrees.push((place, end));
            continue;
        }
        above.push(place);
        let right = tree[place].right as usize;
        stack.push((right, end));
        stack.push((place + 1, right));
    }
    (subtrees, above)
}

/// The choice at one node from those at its children; `choices[0]` belongs to node `first`.
fn choice<M: LeafMaker>(node: &FlatNode, choices: &[Choice], first: usize, place: usize) -> Choice {
    let area = node.bounds.half_area();
    if node.right == 0 {
        return Choice { count: 1, cost: [area * M::COST; WIDTH - 1], split: [0; WIDTH] };
    }
    let (left, right) = (&choices[place + 1 - first], &choices[node.right as usize - first]);
    let count = left.count + right.count;
    let leaf_cost = if count <= M::CAPACITY { area * M::COST } else { f32::INFINITY };
    let mut out = Choice { count, cost: [0.0; WIDTH - 1], split: [0; WIDTH] };
    let (below, split) = cheapest(left, right, WIDTH);
    let inner_cost = below + area;
    out.cost[0] = leaf_cost.min(inner_cost);
    out.split[1] = if leaf_cost <= inner_cost { 0 } else { split };
    for slots in 2..WIDTH {
        let (sum, to_left) = cheapest(left, right, slots);
        let better = sum < out.cost[slots - 2];
        out.cost[slots - 1] = if better { sum } else { out.cost[slots - 2] };
        out.split[slots] = if better { to_left } else { 0 };
    }
    out
}

/// The cheapest way to share slots between two subtrees: the cost, and the slots of the left one.
#[inline(always)]
fn cheapest(left: &Choice, right: &Choice, slots: usize) -> (f32, u8) {
    let mut best = (f32::INFINITY, 1u8);
    for to_left in 1..slots {
        let sum = left.cost[to_left - 1] + right.cost[slots - to_left - 1];
        if sum < best.0 {
            best = (sum, to_left as u8);
        }
    }
    best
}
