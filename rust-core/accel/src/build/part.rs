//! The binary tree of one part, and its pieces, over which the top level is built.

use super::clusters::Clusters;
use super::collapse::{Forest, LeafRule, plan};
use super::division::{Item, Source};
use super::effort::Effort;
use super::flat_tree::{FlatNode, KeptBox, Link, balanced, flatten, nodes_over};
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
    tree: Vec<FlatNode>,
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
    /// Writes the binary tree of a part, planned below its pieces, into a row of its length, and its boxes if there is room for them.
    pub(super) fn part(&self, items: &[Item], row: &mut [Link], kept: &mut [KeptBox]) -> Result<Vec<Piece>, Cancelled> {
        Cancelled::check(self.cancel)?;
        let mut memory = self.memory.lock().ok().and_then(|mut memory| memory.pop()).unwrap_or_default();
        let PartMemory { boxes, clusters, tree } = &mut memory;
        boxes.clear();
        boxes.extend(items.iter().map(|item| item.bounds(self.source)));
        tree.clear();
        tree.resize(nodes_over(items.len()), FlatNode::NONE);
        let leaf = |i: usize| FlatNode::leaf(&boxes[i], items[i]);
        match self.effort {
            Some(effort) => flatten(clusters.tree(boxes, effort, self.cancel)?, leaf, tree),
            None => balanced(boxes, leaf, tree),
        }
        let forest = |node: &FlatNode| Some(Forest::leaf(node.aabb(), node.link.item()?.count(), self.rule));
        let ranges = pieces(tree, self.pieces);
        let planned = |range: Range<usize>| Some(Piece { place: range.start, forest: plan(&mut tree[range], self.rule, forest)? });
        let pieces = ranges.into_iter().filter_map(planned).collect();
        row.iter_mut().zip(&*tree).for_each(|(link, node)| *link = node.link);
        kept.iter_mut().zip(tree).for_each(|(kept, node)| *kept = node.kept_box());
        if let Ok(mut kept) = self.memory.lock() {
            kept.push(memory);
        }
        Ok(pieces)
    }
}

/// Opens the nodes of largest area until there are so many pieces: where they lie, in rising order.
fn pieces(tree: &[FlatNode], pieces: usize) -> Vec<Range<usize>> {
    let entry = |start: usize, end: usize| (tree[start].bounds().half_area().to_bits(), start, end);
    let (mut open, mut closed) = (BinaryHeap::from([entry(0, tree.len())]), Vec::new());
    while open.len() + closed.len() < pieces {
        let Some((_, start, end)) = open.pop() else { break };
        if tree[start].link.is_last() {
            closed.push((start, end));
        } else {
            let [left, right] = FlatNode::children(tree, start);
            open.extend([entry(left, right), entry(right, end)]);
        }
    }
    closed.extend(open.into_iter().map(|(_, start, end)| (start, end)));
    closed.sort_unstable();
    closed.into_iter().map(|(start, end)| start..end).collect()
}
