//! Construction of the two kinds of trees: division into parts, a tree for each, and a tree over the pieces of all.

use super::collapse::{LeafMaker, LeafRule};
use super::division::{Item, Source, divide_all};
use super::effort::Effort;
use super::emit::{Pending, Wide};
use super::flat_tree::{FlatNode, MAX_NODES, nodes_over};
use super::join::{Share, join};
use super::part::{PartWork, Piece};
use super::top::{emit_top, plan_top};
use crate::cancelled::Cancelled;
use crate::tree::node::{Bounds, Kind, MAX_DEPTH, Node};
use rayon::prelude::*;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

/// The wide tree: the root is node 0.
pub(crate) struct WideTree<L> {
    pub(crate) nodes: Vec<Node>,
    pub(crate) leaves: Vec<L>,
    /// The box of all.
    pub(crate) bounds: Bounds,
    /// Primitives in the leaves.
    pub(crate) primitives: usize,
}

/// The most subtrees of a part that the top level is built over, and the least.
const PIECES: usize = 512;
const LEAST_PIECES: usize = 8;

/// The most pieces of all parts together, if that leaves each part the least.
const ALL_PIECES: usize = 1 << 16;

/// Roots whose trees become wide as one task.
const SHARE_ROOTS: usize = 128;

/// Builds the wide tree over a source; primitives of the leaf maker are numbers of the source. The outcome does not depend on the threads.
pub(crate) fn build<S: Source, M: LeafMaker>(
    source: &S,
    maker: &M,
    effort: Effort,
    cancel: &AtomicBool,
) -> Result<WideTree<M::Leaf>, Cancelled> {
    let lists = divide_all(source, M::CAPACITY > 1, cancel)?;
    if lists.is_empty() {
        return Ok(WideTree { nodes: vec![Node::EMPTY], leaves: Vec::new(), bounds: Bounds::EMPTY, primitives: 0 });
    }
    let primitives = lists.par_iter().flatten().map(|item| item.count() as usize).sum();
    let rule = LeafRule { capacity: M::CAPACITY, cost: M::COST };
    let (mut shares, mut bounds) = shares(source, &lists, rule, M::KIND, Some(effort), cancel)?;
    if shares.iter().any(|share| share.wide.depth > MAX_DEPTH) {
        (shares, bounds) = self::shares(source, &lists, rule, M::KIND, None, cancel)?;
    }
    drop(lists);
    let (nodes, leaves) = join(shares, maker, cancel)?;
    Ok(WideTree { nodes, leaves, bounds, primitives })
}

/// The shares of a tree, the top level's first, and the box of all; balanced without effort.
pub(crate) fn shares<S: Source>(
    source: &S,
    lists: &[Vec<Item>],
    rule: LeafRule,
    kind: Kind,
    effort: Option<Effort>,
    cancel: &AtomicBool,
) -> Result<(Vec<Share>, Bounds), Cancelled> {
    let alone = lists.len() == 1;
    let part_effort = if alone { effort } else { effort.map(Effort::part) };
    let pieces = if alone { 1 } else { (ALL_PIECES / lists.len()).clamp(LEAST_PIECES, PIECES) };
    let work = PartWork { source, rule, effort: part_effort, pieces, memory: Mutex::new(Vec::new()), cancel };
    let top = lists.iter().map(|items| nodes_over(items.len())).sum();
    let top_pieces = lists.iter().map(|items| items.len().min(pieces)).sum();
    assert!(top + nodes_over(top_pieces) <= MAX_NODES, "a binary tree has at most {MAX_NODES} nodes");
    // Zeros of an array type come from the kernel as they are: the first to touch a page is the task that needs it.
    let mut memory = vec![[0u32; size_of::<FlatNode>() / size_of::<u32>()]; top + nodes_over(top_pieces)];
    let row: &mut [FlatNode] = bytemuck::cast_slice_mut(&mut memory);
    let pieces = plan_parts(&work, lists, &mut row[..top])?;
    let (top_row, effort) = (&mut row[top..][..nodes_over(pieces.len())], effort.map(|_| Effort::top(pieces.len())));
    plan_top(&pieces, rule, effort, top_row, cancel)?;
    let row = &*row;
    let (wide, roots) = emit_top(row, top, kind);
    let share = |roots: &[Pending]| {
        Cancelled::check(cancel)?;
        let mut wide = Wide::new(kind);
        let roots = roots.iter().map(|&Pending { place, node, depth }| (node, wide.tree(row, place, depth))).collect();
        Ok(Share { wide, roots })
    };
    let below: Vec<Share> = roots.par_chunks(SHARE_ROOTS).map(share).collect::<Result<_, Cancelled>>()?;
    Ok((std::iter::once(Share { wide, roots: Vec::new() }).chain(below).collect(), row[top].bounds()))
}

/// Plans the binary trees of all parts, one behind the other in the row; their pieces in the order of their places.
fn plan_parts<S: Source>(work: &PartWork<S>, lists: &[Vec<Item>], mut row: &mut [FlatNode]) -> Result<Vec<Piece>, Cancelled> {
    let mut tasks = Vec::with_capacity(lists.len());
    let mut start = 0;
    for items in lists {
        let (part, rest) = row.split_at_mut(nodes_over(items.len()));
        tasks.push((start, items, part));
        (start, row) = (start + nodes_over(items.len()), rest);
    }
    let planned = |(start, items, row): (usize, &Vec<Item>, &mut [FlatNode])| {
        let pieces = work.part(items, row)?;
        Ok(pieces.into_iter().map(|piece| Piece { place: start + piece.place, ..piece }).collect())
    };
    let pieces: Vec<Vec<Piece>> = tasks.into_par_iter().map(planned).collect::<Result<_, Cancelled>>()?;
    Ok(pieces.into_iter().flatten().collect())
}
