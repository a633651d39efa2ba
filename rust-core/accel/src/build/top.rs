//! The top level of a tree in parts: a binary tree over the pieces of all.

use super::clusters::Clusters;
use super::collapse::{Forest, LeafRule, plan};
use super::effort::Effort;
use super::flat_tree::{FlatNode, KeptBox, Link, balanced, flatten, nodes_over};
use super::part::Piece;
use crate::cancelled::Cancelled;
use obvhs::aabb::Aabb;
use std::sync::atomic::AtomicBool;

/// Writes a planned binary tree over pieces, at least one and in the order of their places, into a row of its length; balanced
/// without effort. Gives the boxes of its nodes.
pub(super) fn plan_top(
    pieces: &[Piece],
    rule: LeafRule,
    effort: Option<Effort>,
    row: &mut [Link],
    cancel: &AtomicBool,
) -> Result<Vec<KeptBox>, Cancelled> {
    let boxes: Vec<Aabb> = pieces.iter().map(|piece| piece.forest.bounds).collect();
    let leaf = |i: usize| FlatNode::elsewhere(&boxes[i], pieces[i].place);
    let mut tree = vec![FlatNode::NONE; nodes_over(pieces.len())];
    match effort {
        Some(effort) => flatten(Clusters::default().tree(&boxes, effort, cancel)?, leaf, &mut tree),
        None => balanced(&boxes, leaf, &mut tree),
    }
    let forest = |node: &FlatNode| -> Option<Forest> {
        let found = pieces.binary_search_by_key(&node.link.elsewhere_place()?, |piece| piece.place);
        found.ok().map(|i| pieces[i].forest)
    };
    plan(&mut tree, rule, forest);
    row.iter_mut().zip(&tree).for_each(|(link, node)| *link = node.link);
    Ok(tree.iter().map(FlatNode::kept_box).collect())
}
