//! Construction of the two kinds of trees: division into parts, a tree for each, and a tree over the pieces of all.

use super::collapse::{LeafMaker, LeafRule};
use super::division::{Item, Source, divide_all};
use super::effort::Effort;
use super::emit_all::Planned;
use super::flat_tree::{KeptBox, Link, MAX_NODES, nodes_over};
use super::part::{PartWork, Piece};
use super::top::plan_top;
use crate::cancelled::Cancelled;
use crate::ray::NONE;
use crate::tree::node::{Bounds, Kind, MAX_DEPTH, Node, WIDTH};
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

/// Wide nodes, the primitives of their leaves with [`NONE`] behind them, the box of all, and nodes on the longest way down.
pub(crate) struct WideNodes {
    pub(crate) nodes: Vec<Node>,
    pub(crate) leaves: Vec<[u32; WIDTH]>,
    pub(crate) bounds: Bounds,
    pub(crate) depth: usize,
}

/// Leaves that are made between two looks at the flag.
const BLOCK: usize = 1 << 17;

/// Builds the wide tree over a source; primitives of the leaf maker are numbers of the source. The outcome does not depend on the threads.
pub(crate) fn build<S: Source, M: LeafMaker>(
    source: &S,
    maker: &M,
    effort: Effort,
    cancel: &AtomicBool,
) -> Result<WideTree<M::Leaf>, Cancelled> {
    let WideTree { nodes, leaves, bounds, primitives } = build_lists(source, M::RULE, M::KIND, effort, cancel)?;
    let leaf = |list: &[u32; WIDTH]| maker.leaf(&list[..count(list)]);
    let mut made = Vec::with_capacity(leaves.len());
    for block in leaves.chunks(BLOCK) {
        Cancelled::check(cancel)?;
        made.par_extend(block.par_iter().map(leaf));
    }
    Ok(WideTree { nodes, leaves: made, bounds, primitives })
}

/// How many primitives a leaf has.
pub(crate) fn count(list: &[u32; WIDTH]) -> usize {
    list.iter().position(|primitive| *primitive == NONE).unwrap_or(WIDTH)
}

/// [`build`] with leaves that are their primitives, sorted, with [`NONE`] behind them.
pub(crate) fn build_lists<S: Source>(
    source: &S,
    rule: LeafRule,
    kind: Kind,
    effort: Effort,
    cancel: &AtomicBool,
) -> Result<WideTree<[u32; WIDTH]>, Cancelled> {
    let lists = divide_all(source, rule.capacity > 1, cancel)?;
    if lists.is_empty() {
        return Ok(WideTree { nodes: vec![Node::EMPTY], leaves: Vec::new(), bounds: Bounds::EMPTY, primitives: 0 });
    }
    let primitives = lists.par_iter().flatten().map(|item| item.count() as usize).sum();
    let mut wide = wide_nodes(source, &lists, rule, kind, Some(effort), cancel)?;
    if wide.depth > MAX_DEPTH {
        wide = wide_nodes(source, &lists, rule, kind, None, cancel)?;
    }
    Ok(WideTree { nodes: wide.nodes, leaves: wide.leaves, bounds: wide.bounds, primitives })
}

/// The wide nodes over the items of parts; balanced without effort.
pub(crate) fn wide_nodes<S: Source>(
    source: &S,
    lists: &[Vec<Item>],
    rule: LeafRule,
    kind: Kind,
    effort: Option<Effort>,
    cancel: &AtomicBool,
) -> Result<WideNodes, Cancelled> {
    let alone = lists.len() == 1;
    let part_effort = if alone { effort } else { effort.map(Effort::part) };
    let pieces = if alone { 1 } else { (ALL_PIECES / lists.len()).clamp(LEAST_PIECES, PIECES) };
    let work = PartWork { source, rule, effort: part_effort, pieces, memory: Mutex::new(Vec::new()), cancel };
    let top = lists.iter().map(|items| nodes_over(items.len())).sum();
    let top_pieces = lists.iter().map(|items| items.len().min(pieces)).sum();
    assert!(top + nodes_over(top_pieces) <= MAX_NODES, "a binary tree has at most {MAX_NODES} nodes");
    // Zeros of an array type come from the kernel as they are: the first to touch a page is the task that needs it.
    let mut memory = vec![[0u32; size_of::<Link>() / size_of::<u32>()]; top + nodes_over(top_pieces)];
    let row: &mut [Link] = bytemuck::cast_slice_mut(&mut memory);
    let first_box = if S::KEEPS_BOXES { 0 } else { top };
    let mut boxes = vec![KeptBox::default(); top - first_box];
    let pieces = plan_parts(&work, lists, &mut row[..top], &mut boxes)?;
    drop(work);
    let (top_row, effort) = (&mut row[top..][..nodes_over(pieces.len())], effort.map(|_| Effort::top(pieces.len())));
    boxes.append(&mut plan_top(&pieces, rule, effort, top_row, cancel)?);
    drop(pieces);
    Planned { source, row, top, boxes, first_box, kind }.emit(cancel)
}

/// Plans the binary trees of all parts, one behind the other in the row; their pieces in the order of their places.
fn plan_parts<S: Source>(
    work: &PartWork<S>,
    lists: &[Vec<Item>],
    mut row: &mut [Link],
    mut boxes: &mut [KeptBox],
) -> Result<Vec<Piece>, Cancelled> {
    let mut tasks = Vec::with_capacity(lists.len());
    let mut start = 0;
    for items in lists {
        let nodes = nodes_over(items.len());
        let (part, rest) = row.split_at_mut(nodes);
        let (kept, behind) = boxes.split_at_mut(nodes.min(boxes.len()));
        tasks.push((start, items, part, kept));
        (start, row, boxes) = (start + nodes, rest, behind);
    }
    let planned = |(start, items, row, kept): (usize, &Vec<Item>, &mut [Link], &mut [KeptBox])| {
        let pieces = work.part(items, row, kept)?;
        Ok(pieces.into_iter().map(|piece| Piece { place: start + piece.place, ..piece }).collect())
    };
    let pieces: Vec<Vec<Piece>> = tasks.into_par_iter().map(planned).collect::<Result<_, Cancelled>>()?;
    Ok(pieces.into_iter().flatten().collect())
}
