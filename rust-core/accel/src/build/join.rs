//! The shares of a tree put one behind the other.

use super::collapse::LeafMaker;
use super::emit::Wide;
use crate::cancelled::Cancelled;
use crate::ray::NONE;
use crate::tree::node::{Node, WIDTH};
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

/// A share: what was made from one part, and the nodes of the part's roots with their numbers in the first share.
pub(crate) struct Share {
    pub(crate) wide: Wide,
    pub(crate) roots: Vec<(usize, Node)>,
}

/// Nodes or leaves that are made between two looks at the flag.
const BLOCK: usize = 1 << 17;

/// All nodes and all leaves of the shares.
pub(super) fn join<M: LeafMaker>(mut shares: Vec<Share>, maker: &M, cancel: &AtomicBool) -> Result<(Vec<Node>, Vec<M::Leaf>), Cancelled> {
    let (nodes, leaves) = (Places::new(shares.iter().map(|s| s.wide.nodes.len())), Places::new(shares.iter().map(|s| s.wide.leaves.len())));
    let moved = |share: usize, from: &Node| {
        let mut node = *from;
        for slot in (0..WIDTH).filter(|&slot| !from.bounds_of(slot).is_empty()) {
            node.children[slot] = node.children[slot].shifted(nodes.0[share], leaves.0[share]);
        }
        node
    };
    for share in 1..shares.len() {
        for (place, root) in std::mem::take(&mut shares[share].roots) {
            shares[0].wide.nodes[place] = moved(share, &root);
        }
    }
    let node = |index: usize| {
        let (share, place) = nodes.find(index);
        moved(share, &shares[share].wide.nodes[place])
    };
    let leaf = |index: usize| {
        let (share, place) = leaves.find(index);
        let primitives = &shares[share].wide.leaves[place];
        maker.leaf(&primitives[..primitives.iter().position(|&primitive| primitive == NONE).unwrap_or(WIDTH)])
    };
    Ok((in_blocks(nodes.all(), node, cancel)?, in_blocks(leaves.all(), leaf, cancel)?))
}

/// What is made of the numbers below a count, in their order.
fn in_blocks<T: Send>(count: usize, make: impl Fn(usize) -> T + Sync, cancel: &AtomicBool) -> Result<Vec<T>, Cancelled> {
    let mut made = Vec::with_capacity(count);
    while made.len() < count {
        Cancelled::check(cancel)?;
        let end = (made.len() + BLOCK).min(count);
        made.par_extend((made.len()..end).into_par_iter().map(&make));
    }
    Ok(made)
}

/// Where the shares begin in what they make together.
struct Places(Vec<usize>);

impl Places {
    fn new(lengths: impl Iterator<Item = usize>) -> Self {
        let mut starts = vec![0];
        let mut all = 0;
        for length in lengths {
            all += length;
            starts.push(all);
        }
        Places(starts)
    }

    fn all(&self) -> usize {
        self.0[self.0.len() - 1]
    }

    /// The share of one below all, and the place in it.
    fn find(&self, index: usize) -> (usize, usize) {
        let share = self.0.partition_point(|&start| start <= index) - 1;
        (share, index - self.0[share])
    }
}
