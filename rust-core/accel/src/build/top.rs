//! The top level of a tree in parts: a binary tree over the pieces of all, and the wide nodes above them.

use super::clusters::Clusters;
use super::collapse::{Forest, LeafRule, plan};
use super::effort::Effort;
use super::emit::{Pending, Wide};
use super::flat_tree::{FlatNode, balanced, flatten, root};
use super::part::Piece;
use crate::cancelled::Cancelled;
use crate::tree::node::{Kind, Node};
use obvhs::aabb::Aabb;
use std::sync::atomic::AtomicBool;

/// Writes a planned binary tree over pieces, at least one and in the order of their places, into a row of its length; balanced
/// without effort.
pub(super) fn plan_top(
    pieces: &[Piece],
    rule: LeafRule,
    effort: Option<Effort>,
    row: &mut [FlatNode],
    cancel: &AtomicBool,
) -> Result<(), Cancelled> {
    let boxes: Vec<Aabb> = pieces.iter().map(|piece| piece.forest.bounds).collect();
    let leaf = |i: usize| FlatNode::elsewhere(&boxes[i], pieces[i].place);
    match effort {
        Some(effort) => flatten(Clusters::default().tree(&boxes, effort, cancel)?, leaf, row),
        None => balanced(&boxes, leaf, row),
    }
    let forest = |node: &FlatNode| -> Option<Forest> {
        let found = pieces.binary_search_by_key(&node.elsewhere_place()?, |piece| piece.place);
        found.ok().map(|i| pieces[i].forest)
    };
    plan(row, rule, forest);
    Ok(())
}

/// The wide nodes and leaves of the top level that begins at a place of the row, the root first, and the roots of the parts' trees before it,
/// whose nodes are left empty.
pub(super) fn emit_top(row: &[FlatNode], top: usize, kind: Kind) -> (Wide, Vec<Pending>) {
    let mut wide = Wide::new(kind);
    wide.nodes.push(Node::EMPTY);
    let mut below = Vec::new();
    let mut pending = vec![Pending { place: root(row, top), node: 0, depth: 1 }];
    while let Some(next) = pending.pop() {
        if next.place < top {
            below.push(next);
        } else {
            wide.nodes[next.node] = wide.node(row, next.place, next.depth, &mut pending);
        }
    }
    (wide, below)
}
