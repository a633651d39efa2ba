//! The binary tree of one part, and its pieces, over which the top level is built.

use super::clusters::Clusters;
use super::collapse::{Forest, LeafRule, plan};
use super::division::{Item, Source};
use super::effort::Effort;
use super::flat_tree::{FlatNode, balanced, children, flatten};
use crate::cancelled::Cancelled;
use obvhs::aabb::Aabb;
use std::collections::BinaryHeap;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

/// A subtree of a part for the top level.
pub(super) struct Piece {
    /// Where its root lies in the part.
    pub(super) place: usize,
    pub(super) forest: Forest,
}

/// What a thread needs to build a part, kept from one to the next.
#[derive(Default)]
pub(super) struct PartMemory {
    boxes: Vec<Aabb>,
    clusters: Clusters,
}

/// What all parts have in common.
pub(super) struct PartWork<'a, S> {
    pub(super) source: &'a S,
    pub(super) rule: LeafRule,
    /// None for balanced trees.
    pub(super) effort: Option<Effort>,
    /// The most pieces.
    pub(super) pieces: usize,
    pub(super) memory: Mutex<Vec<PartMemory>>,
    pub(super) cancel: &'a AtomicBool,
}

impl<S: Source> PartWork<'_, S> {
    /// Writes the binary tree of a part, planned below its pieces, into a row of its length.
    pub(super) fn part(&self, items: &[Item], row: &mut [FlatNode]) -> Result<Vec<Piece>, Cancelled> {
        Cancelled::check(self.cancel)?;
        let mut memory = self.memory.lock().ok().and_then(|mut memory| memory.pop()).unwrap_or_default();
        let PartMemory { boxes, clusters } = &mut memory;
        boxes.clear();
        boxes.extend(items.iter().map(|item| item.bounds(self.source)));
        let leaf = |i: usize| FlatNode::leaf(&boxes[i], items[i]);
        match self.effort {
            Some(effort) => flatten(clusters.tree(boxes, effort, self.cancel)?, leaf, row),
            None => balanced(boxes, leaf, row),
        }
        if let Ok(mut kept) = self.memory.lock() {
            kept.push(memory);
        }
        let forest = |node: &FlatNode| Some(Forest::leaf(node.aabb(), node.item()?.count(), self.rule));
        let ranges = pieces(row, self.pieces);
        let planned = |range: Range<usize>| Some(Piece { place: range.start, forest: plan(&mut row[range], self.rule, forest)? });
        Ok(ranges.into_iter().filter_map(planned).collect())
    }
}

/// Opens the nodes of largest area until there are so many pieces: where they lie, in rising order.
fn pieces(tree: &[FlatNode], pieces: usize) -> Vec<Range<usize>> {
    let entry = |start: usize, end: usize| (tree[start].bounds().half_area().to_bits(), start, end);
    let (mut open, mut closed) = (BinaryHeap::from([entry(0, tree.len())]), Vec::new());
    while open.len() + closed.len() < pieces {
        let Some((_, start, end)) = open.pop() else { break };
        if tree[start].is_last() {
            closed.push((start, end));
        } else {
            let [left, right] = children(tree, start);
            open.extend([entry(left, right), entry(right, end)]);
        }
    }
    closed.extend(open.into_iter().map(|(_, start, end)| (start, end)));
    closed.sort_unstable();
    closed.into_iter().map(|(start, end)| start..end).collect()
}
