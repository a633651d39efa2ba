//! The wide nodes of planned binary trees.

use super::collapse::{is_leaf, planned};
use super::flat_tree::{Link, children};
use crate::ray::NONE;
use crate::tree::node::{Bounds, ChildRef, Kind, Node, WIDTH};

/// A binary node that becomes a wide node with a number of its own.
#[derive(Clone, Copy)]
pub(super) struct Pending {
    pub(super) place: usize,
    /// Number of the wide node.
    pub(super) node: usize,
    /// Nodes on the way down to it, itself among them.
    pub(super) depth: usize,
}

/// Wide nodes and leaves, and nodes on the longest way down.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Size {
    pub(super) nodes: usize,
    pub(super) leaves: usize,
    pub(super) depth: usize,
}

impl Size {
    /// What is below the wide node of a place; of what lies in a slot `opens` says whether that counts which is below it.
    pub(super) fn below(row: &[Link], place: usize, depth: usize, mut opens: impl FnMut(usize) -> bool) -> Self {
        let mut size = Size::default();
        let mut open = vec![(place, depth)];
        while let Some((place, depth)) = open.pop() {
            size.depth = size.depth.max(depth);
            let (slots, n) = slots(row, place);
            for &slot in &slots[..n] {
                let is_opened = opens(slot);
                if is_leaf(row[slot]) {
                    size.leaves += 1;
                    continue;
                }
                size.nodes += 1;
                if is_opened {
                    open.push((slot, depth + 1));
                }
            }
        }
        size
    }

    /// Both together.
    pub(super) fn and(self, other: Size) -> Self {
        Size { nodes: self.nodes + other.nodes, leaves: self.leaves + other.leaves, depth: self.depth.max(other.depth) }
    }
}

/// Room for wide nodes and leaves, which get numbers in the order in which they are made.
pub(super) struct Wide<'a> {
    pub(super) kind: Kind,
    /// The numbers of the first node and of the first leaf.
    pub(super) first: Size,
    pub(super) nodes: &'a mut [Node],
    /// Primitives of each leaf, sorted, behind them [`NONE`].
    pub(super) leaves: &'a mut [[u32; WIDTH]],
    /// What has a number.
    pub(super) made: Size,
}

impl Wide<'_> {
    /// Makes the wide node of a binary node: its leaves, and the numbers of its children, which are put behind what is pending.
    pub(super) fn node(&mut self, row: &[Link], bounds: &impl Fn(usize) -> Bounds, of: Pending, pending: &mut Vec<Pending>) -> Node {
        let (slots, n) = by_area(slots(row, of.place), bounds);
        let mut node = Node::EMPTY;
        for (slot, (bounds, place)) in slots[..n].iter().enumerate() {
            let child = if is_leaf(row[*place]) {
                self.leaves[self.made.leaves] = leaf_primitives(row, *place);
                self.made.leaves += 1;
                ChildRef::new(self.kind, self.first.leaves + self.made.leaves - 1)
            } else {
                self.made.nodes += 1;
                let number = self.first.nodes + self.made.nodes - 1;
                pending.push(Pending { place: *place, node: number, depth: of.depth + 1 });
                ChildRef::new(Kind::Inner, number)
            };
            node.set(slot, bounds, child);
        }
        node
    }

    /// Makes all that is below the wide node of a place, and the node itself, which gets no number here.
    pub(super) fn tree(&mut self, row: &[Link], bounds: &impl Fn(usize) -> Bounds, of: Pending) -> Node {
        let mut pending = Vec::new();
        let root = self.node(row, bounds, of, &mut pending);
        while let Some(next) = pending.pop() {
            self.nodes[next.node - self.first.nodes] = self.node(row, bounds, next, &mut pending);
        }
        root
    }
}

/// The places of the binary nodes in the slots of a wide node, and how many there are.
fn slots(row: &[Link], place: usize) -> ([usize; WIDTH], usize) {
    let mut slots = [0usize; WIDTH];
    let mut n = 0;
    let mut open = [(place, 1u8); WIDTH];
    let mut top = 1;
    let split = planned(row[place], 1);
    if split != 0 {
        let [left, right] = children(row, place);
        (open[0], open[1], top) = ((right, WIDTH as u8 - split), (left, split), 2);
    }
    while top > 0 {
        top -= 1;
        let (place, mut budget) = open[top];
        while budget > 1 && planned(row[place], budget) == 0 {
            budget -= 1;
        }
        if budget > 1 {
            let [left, right] = children(row, place);
            let to_left = planned(row[place], budget);
            (open[top], open[top + 1]) = ((right, budget - to_left), (left, to_left));
            top += 2;
            continue;
        }
        slots[n] = place;
        n += 1;
    }
    (slots, n)
}

/// Slots with their boxes, largest area first.
fn by_area((places, n): ([usize; WIDTH], usize), bounds: &impl Fn(usize) -> Bounds) -> ([(Bounds, usize); WIDTH], usize) {
    let mut slots = [(Bounds::EMPTY, 0); WIDTH];
    let mut areas = [0.0f32; WIDTH];
    for (end, &place) in places[..n].iter().enumerate() {
        let bounds = bounds(place);
        let area = bounds.half_area();
        let mut slot = end;
        while slot > 0 && areas[slot - 1] < area {
            (slots[slot], areas[slot]) = (slots[slot - 1], areas[slot - 1]);
            slot -= 1;
        }
        (slots[slot], areas[slot]) = ((bounds, place), area);
    }
    (slots, n)
}

/// The primitives of a leaf's binary subtree, sorted, behind them [`NONE`].
fn leaf_primitives(row: &[Link], place: usize) -> [u32; WIDTH] {
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
