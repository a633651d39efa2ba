//! The wide nodes of planned binary trees.

use super::collapse::{is_leaf, planned};
use super::flat_tree::{FlatNode, children};
use crate::ray::NONE;
use crate::tree::node::{ChildRef, Kind, Node, WIDTH};

/// A binary node that becomes a wide node with a number of its own.
#[derive(Clone, Copy)]
pub(super) struct Pending {
    pub(super) place: usize,
    /// Number of the wide node.
    pub(super) node: usize,
    /// Nodes on the way down to it, itself among them.
    pub(super) depth: usize,
}

/// Wide nodes and leaves, numbered in the order in which they were made.
pub(crate) struct Wide {
    pub(super) kind: Kind,
    pub(super) nodes: Vec<Node>,
    /// Primitives of each leaf, sorted, behind them [`NONE`].
    pub(super) leaves: Vec<[u32; WIDTH]>,
    /// Nodes on the longest way down.
    pub(crate) depth: usize,
}

impl Wide {
    pub(super) fn new(kind: Kind) -> Self {
        Wide { kind, nodes: Vec::new(), leaves: Vec::new(), depth: 0 }
    }

    /// Makes the wide node of a binary node: its leaves, and the numbers of its children, which are put behind what is pending.
    pub(super) fn node(&mut self, row: &[FlatNode], place: usize, depth: usize, pending: &mut Vec<Pending>) -> Node {
        self.depth = self.depth.max(depth);
        let (slots, n) = slots(row, place);
        let mut node = Node::EMPTY;
        for (slot, &place) in slots[..n].iter().enumerate() {
            let child = if is_leaf(&row[place]) {
                self.leaves.push(leaf_primitives(row, place));
                ChildRef::new(self.kind, self.leaves.len() - 1)
            } else {
                pending.push(Pending { place, node: self.nodes.len(), depth: depth + 1 });
                self.nodes.push(Node::EMPTY);
                ChildRef::new(Kind::Inner, self.nodes.len() - 1)
            };
            node.set(slot, &row[place].bounds(), child);
        }
        node
    }

    /// Makes all that is below the wide node of a place, and the node itself, which gets no number here.
    pub(super) fn tree(&mut self, row: &[FlatNode], place: usize, depth: usize) -> Node {
        let mut pending = Vec::new();
        let root = self.node(row, place, depth, &mut pending);
        while let Some(Pending { place, node, depth }) = pending.pop() {
            self.nodes[node] = self.node(row, place, depth, &mut pending);
        }
        root
    }
}

/// The binary nodes in the slots of a wide node, largest area first.
fn slots(row: &[FlatNode], place: usize) -> ([usize; WIDTH], usize) {
    let mut slots = [(0.0f32, 0usize); WIDTH];
    let mut n = 0;
    let mut open = [(place, 1u8); WIDTH];
    let mut top = 1;
    let split = planned(&row[place], 1);
    if split != 0 {
        let [left, right] = children(row, place);
        (open[0], open[1], top) = ((right, WIDTH as u8 - split), (left, split), 2);
    }
    while top > 0 {
        top -= 1;
        let (place, mut budget) = open[top];
        let node = &row[place];
        while budget > 1 && planned(node, budget) == 0 {
            budget -= 1;
        }
        if budget > 1 {
            let [left, right] = children(row, place);
            let to_left = planned(node, budget);
            (open[top], open[top + 1]) = ((right, budget - to_left), (left, to_left));
            top += 2;
            continue;
        }
        let area = node.bounds().half_area();
        let mut slot = n;
        while slot > 0 && slots[slot - 1].0 < area {
            slots[slot] = slots[slot - 1];
            slot -= 1;
        }
        slots[slot] = (area, place);
        n += 1;
    }
    (slots.map(|(_, place)| place), n)
}

/// The primitives of a leaf's binary subtree, sorted, behind them [`NONE`].
fn leaf_primitives(row: &[FlatNode], place: usize) -> [u32; WIDTH] {
    let mut primitives = [NONE; WIDTH];
    let mut n = 0;
    let mut insert = |primitive: u32| {
        let mut lane = n;
        while lane > 0 && primitives[lane - 1] > primitive {
            primitives[lane] = primitives[lane - 1];
            lane -= 1;
        }
        primitives[lane] = primitive;
        n += 1;
    };
    let mut open = [place; WIDTH];
    let mut top = 1;
    while top > 0 {
        top -= 1;
        if let Some(item) = row[open[top]].item() {
            insert(item.first());
            if item.is_pair() {
                insert(item.first() + 1);
            }
        } else {
            let [left, right] = children(row, open[top]);
            (open[top], open[top + 1]) = (right, left);
            top += 2;
        }
    }
    primitives
}
