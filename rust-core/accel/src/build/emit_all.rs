//! All wide nodes of a planned tree in parts, written where they stay.

use super::division::Source;
use super::emit::{Pending, Size, Wide};
use super::flat_tree::{KeptBox, Link, box_at, boxes_at, root};
use super::wide_tree::WideNodes;
use crate::cancelled::Cancelled;
use crate::tree::node::{Bounds, Kind, Node, WIDTH};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// Roots whose trees become wide as one task.
const SHARE_ROOTS: usize = 128;

/// The binary trees of parts, and from a place on the top level over their pieces.
pub(super) struct Planned<'a, S> {
    pub(super) source: &'a S,
    pub(super) row: &'a [Link],
    pub(super) top: usize,
    /// Boxes of the nodes from a place on: of all, or of the top level's.
    pub(super) boxes: Vec<KeptBox>,
    pub(super) first_box: usize,
    pub(super) kind: Kind,
}

impl<S: Source> Planned<'_, S> {
    /// The wide nodes and leaves of the top level, the root first, behind them those of the parts in the order of their roots.
    pub(super) fn emit(self, cancel: &AtomicBool) -> Result<WideNodes, Cancelled> {
        let (top, met) = self.size_of_top();
        let mut nodes = vec![Node::EMPTY; top.nodes];
        let mut of_top = vec![[0; WIDTH]; top.leaves];
        let roots = self.emit_top(&mut nodes, &mut of_top, &met);
        let sizes: Vec<Size> = roots.par_chunks(SHARE_ROOTS).map(|roots| self.size_below(roots)).collect();
        let all = sizes.iter().fold(top, |all, size| all.and(*size));
        nodes.reserve_exact(all.nodes - top.nodes);
        nodes.par_extend(rayon::iter::repeat_n(Node::EMPTY, all.nodes - top.nodes));
        // Zeros of an array type come from the kernel as they are: the first to touch a page is the task that needs it.
        let mut leaves = vec![[0; WIDTH]; all.leaves];
        leaves[..top.leaves].copy_from_slice(&of_top);
        let mut shares = Vec::with_capacity(sizes.len());
        let (mut first, mut rest) = (top, (&mut nodes[top.nodes..], &mut leaves[top.leaves..]));
        for (roots, size) in roots.chunks(SHARE_ROOTS).zip(&sizes) {
            let (own, behind) = (rest.0.split_at_mut(size.nodes), rest.1.split_at_mut(size.leaves));
            shares.push((roots, Wide { kind: self.kind, first, nodes: own.0, leaves: behind.0, made: Size::default() }));
            (first, rest) = (first.and(*size), (own.1, behind.1));
        }
        let emitted = shares.into_par_iter().map(|(roots, wide)| self.emit_below(roots, wide, cancel));
        for (number, node) in emitted.collect::<Result<Vec<_>, Cancelled>>()?.into_iter().flatten() {
            nodes[number] = node;
        }
        let bounds = self.kept(self.top).unwrap_or(Bounds::EMPTY);
        Ok(WideNodes { nodes, leaves, bounds, depth: all.depth })
    }

    /// The box of a node, if it is kept.
    fn kept(&self, place: usize) -> Option<Bounds> {
        place.checked_sub(self.first_box).map(|number| self.boxes[number]).map(|[min, max]| Bounds { min, max })
    }

    /// What the top level takes with its root and the roots of the parts' trees, and the places in its slots whose boxes are not kept, in rising order.
    fn size_of_top(&self) -> (Size, Vec<usize>) {
        let (place, mut met) = (root(self.row, self.top), Vec::new());
        let mut size = Size { nodes: 1, leaves: 0, depth: 1 };
        if place >= self.top {
            let opens = |slot: usize| {
                if slot < self.first_box {
                    met.push(slot);
                }
                slot >= self.top
            };
            size = size.and(Size::below(self.row, place, 1, opens));
            met.sort_unstable();
        }
        (size, met)
    }

    /// Makes the nodes of the top level; gives the roots of the parts' trees, whose nodes are left empty.
    fn emit_top(&self, nodes: &mut [Node], leaves: &mut [[u32; WIDTH]], met: &[usize]) -> Vec<Pending> {
        let in_parts: Vec<Bounds> = met.par_iter().map(|place| box_at(self.source, self.row, *place)).collect();
        let found = |place: usize| met.binary_search(&place).map_or(Bounds::EMPTY, |found| in_parts[found]);
        let bounds = |place: usize| self.kept(place).unwrap_or_else(|| found(place));
        let made = Size { nodes: 1, ..Size::default() };
        let mut wide = Wide { kind: self.kind, first: Size::default(), nodes, leaves, made };
        let mut below = Vec::new();
        let mut pending = vec![Pending { place: root(self.row, self.top), node: 0, depth: 1 }];
        while let Some(next) = pending.pop() {
            if next.place < self.top {
                below.push(next);
            } else {
                wide.nodes[next.node] = wide.node(self.row, &bounds, next, &mut pending);
            }
        }
        below
    }

    fn size_below(&self, roots: &[Pending]) -> Size {
        roots.iter().fold(Size::default(), |all, root| all.and(Size::below(self.row, root.place, root.depth, |_| true)))
    }

    /// Makes the trees of some roots; gives the nodes of the roots with their numbers.
    fn emit_below(&self, roots: &[Pending], mut wide: Wide<'_>, cancel: &AtomicBool) -> Result<Vec<(usize, Node)>, Cancelled> {
        Cancelled::check(cancel)?;
        let mut boxes = Vec::new();
        let emitted = roots.iter().map(|root| {
            if root.place < self.first_box {
                boxes_at(self.source, self.row, root.place, &mut boxes);
            }
            let bounds = |place: usize| self.kept(place).unwrap_or_else(|| boxes[place - root.place]);
            (root.node, wide.tree(self.row, &bounds, *root))
        });
        Ok(emitted.collect())
    }
}
