//! A binary tree in preorder, the form the collapse reads.

use super::node::Bounds;
use obvhs::bvh2::Bvh2;
use rayon::prelude::*;
use std::mem::MaybeUninit;

/// One node: a box, and either the place of its right child or the number of its primitive.
///
/// The left child of node `i` is node `i + 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatNode {
    pub(super) bounds: Bounds,
    /// Place of the right child; 0 for a leaf.
    pub(super) right: u32,
    /// The primitive of a leaf; the number of primitives below an inner node.
    pub(super) payload: u32,
}

impl FlatNode {
    fn leaf(bounds: Bounds, primitive: u32) -> Self {
        FlatNode { bounds, right: 0, payload: primitive }
    }

    /// The number of primitives in the subtree.
    #[inline(always)]
    pub(super) fn count(&self) -> u32 {
        if self.right == 0 { 1 } else { self.payload }
    }

    /// An inner node of these two children.
    fn parent(left: &FlatNode, right: &FlatNode, place: u32) -> Self {
        FlatNode { bounds: left.bounds.union(&right.bounds), right: place, payload: left.count() + right.count() }
    }
}

/// A builder's tree over a part of the primitives; a leaf's first index is its primitive.
pub(super) struct Part {
    pub(super) tree: Bvh2,
    /// Primitives below each node.
    pub(super) counts: Vec<u32>,
}

/// What a leaf of the top tree stands for.
#[derive(Clone, Copy)]
pub(super) enum Below {
    Primitive(u32),
    Subtree { part: u32, node: u32 },
}

/// The stretch of the flat tree that one leaf of the top tree fills.
struct Stretch<'a> {
    start: usize,
    below: Below,
    places: &'a mut [MaybeUninit<FlatNode>],
}

/// Brings a top tree, whose leaves are numbers in `below`, and the subtrees below it into preorder, with the true boxes of the primitives.
pub(super) fn flatten(top: &Bvh2, below: &[Below], parts: &[Part], boxes: &[Bounds]) -> Vec<FlatNode> {
    let primitives = |below: &Below| match *below {
        Below::Primitive(_) => 1,
        Below::Subtree { part, node } => parts[part as usize].counts[node as usize] as usize,
    };
    let total = 2 * below.iter().map(primitives).sum::<usize>() - 1;
    let mut flat: Vec<FlatNode> = Vec::with_capacity(total);
    let (mut stretches, mut inner, mut rights) = (Vec::with_capacity(below.len()), Vec::new(), Vec::new());
    let (mut rest, mut place) = (&mut flat.spare_capacity_mut()[..total], 0);
    // A pending right child carries the place of its parent.
    let mut stack = vec![(0u32, usize::MAX)];
    while let Some((index, parent)) = stack.pop() {
        if parent != usize::MAX {
            rights.push((parent, place));
        }
        let mut index = index as usize;
        while !top.nodes[index].is_leaf() {
            let (slot, behind) = std::mem::take(&mut rest).split_at_mut(1);
            slot[0].write(FlatNode::leaf(Bounds::EMPTY, 0));
            inner.push(place);
            stack.push((top.nodes[index].first_index + 1, place));
            (rest, place) = (behind, place + 1);
            index = top.nodes[index].first_index as usize;
        }
        let below = below[top.nodes[index].first_index as usize];
        let (places, behind) = std::mem::take(&mut rest).split_at_mut(2 * primitives(&below) - 1);
        (rest, place) = (behind, place + places.len());
        stretches.push(Stretch { start: place - places.len(), below, places });
    }
    assert!(rest.is_empty(), "the top tree refers to every subtree once");
    stretches.into_par_iter().with_min_len(64).for_each_init(Vec::new, |stack, stretch| flatten_stretch(stretch, parts, boxes, stack));
    // SAFETY: the walk cut all `total` places into single slots, written at once, and stretches, which `flatten_stretch` filled.
    unsafe { flat.set_len(total) };
    for (parent, place) in rights {
        flat[parent].right = place as u32;
    }
    for place in inner.into_iter().rev() {
        let right = flat[place].right;
        flat[place] = FlatNode::parent(&flat[place + 1], &flat[right as usize], right);
    }
    flat
}

/// Writes every place of a stretch; the empty stack is there for its memory.
fn flatten_stretch(stretch: Stretch, parts: &[Part], boxes: &[Bounds], stack: &mut Vec<u32>) {
    let Stretch { start, below, places } = stretch;
    let (part, root) = match below {
        Below::Primitive(primitive) => {
            places[0].write(FlatNode::leaf(boxes[primitive as usize], primitive));
            return;
        }
        Below::Subtree { part, node } => (&parts[part as usize], node),
    };
    stack.push(root);
    let mut written = 0;
    while let Some(index) = stack.pop() {
        let mut node = &part.tree.nodes[index as usize];
        while !node.is_leaf() {
            let left = node.first_index;
            let right = start + written + 2 * part.counts[left as usize] as usize;
            places[written].write(FlatNode { bounds: Bounds::EMPTY, right: right as u32, payload: 0 });
            written += 1;
            stack.push(left + 1);
            node = &part.tree.nodes[left as usize];
        }
        let primitive = node.first_index;
        places[written].write(FlatNode::leaf(boxes[primitive as usize], primitive));
        written += 1;
    }
    assert_eq!(written, places.len(), "the counts of a part are those of its tree");
    // SAFETY: all places are written, as just asserted.
    let places = unsafe { places.assume_init_mut() };
    for place in (0..places.len()).rev() {
        let right = places[place].right;
        if right != 0 {
            places[place] = FlatNode::parent(&places[place + 1], &places[right as usize - start], right);
        }
    }
}

/// A balanced tree by median splits along the longest axis: the way out when the builder's tree grows too deep.
pub(super) fn balanced(boxes: &[Bounds], mut order: Vec<u32>) -> Vec<FlatNode> {
    let mut flat: Vec<FlatNode> = Vec::with_capacity(2 * order.len());
    let mut stack = vec![(0usize, order.len(), u32::MAX)];
    if order.is_empty() {
        return flat;
    }
    while let Some((start, mut end, parent)) = stack.pop() {
        if parent != u32::MAX {
            flat[parent as usize].right = flat.len() as u32;
        }
        loop {
            let mut bounds = Bounds::EMPTY;
            for &i in &order[start..end] {
                bounds = bounds.union(&boxes[i as usize]);
            }
            let place = flat.len() as u32;
            if end - start == 1 {
                flat.push(FlatNode::leaf(bounds, order[start]));
                break;
            }
            flat.push(FlatNode { bounds, right: 0, payload: (end - start) as u32 });
            let middle = start + (end - start) / 2;
            split_at_median(boxes, &mut order[start..end], middle - start, &bounds);
            stack.push((middle, end, place));
            end = middle;
        }
    }
    flat
}

fn split_at_median(boxes: &[Bounds], order: &mut [u32], middle: usize, bounds: &Bounds) {
    let extent = |axis: usize| bounds.max[axis] - bounds.min[axis];
    let axis = if extent(0) >= extent(1) && extent(0) >= extent(2) { 0 } else { 1 + usize::from(extent(2) > extent(1)) };
    let centre = |i: u32| boxes[i as usize].min[axis] + boxes[i as usize].max[axis];
    order.select_nth_unstable_by(middle, |&a, &b| centre(a).total_cmp(&centre(b)).then(a.cmp(&b)));
}
