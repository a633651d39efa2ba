//! A binary tree in preorder, the form the collapse reads.

use super::node::Bounds;
use obvhs::bvh2::Bvh2;

/// One node: a box, and either the place of its right child or the number of its primitive.
///
/// The left child of node `i` is node `i + 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatNode {
    pub(super) bounds: Bounds,
    /// Place of the right child; 0 for a leaf.
    pub(super) right: u32,
    /// The primitive of a leaf, unused in inner nodes.
    pub(super) payload: u32,
}

/// Brings a builder's tree, which must not be empty, into preorder, with the true boxes of the primitives.
pub(super) fn flatten(tree: &Bvh2, boxes: &[Bounds]) -> Vec<FlatNode> {
    let mut flat: Vec<FlatNode> = Vec::with_capacity(tree.nodes.len());
    // A pending right child carries the place of its parent.
    let mut stack: Vec<(u32, u32)> = vec![(0, u32::MAX)];
    while let Some((index, parent)) = stack.pop() {
        if parent != u32::MAX {
            flat[parent as usize].right = flat.len() as u32;
        }
        let mut index = index as usize;
        loop {
            let node = &tree.nodes[index];
            let place = flat.len() as u32;
            if node.is_leaf() {
                flat.push(FlatNode { bounds: boxes[node.first_index as usize], right: 0, payload: node.first_index });
                break;
            }
            flat.push(FlatNode { bounds: Bounds::EMPTY, right: 0, payload: 0 });
            stack.push((node.first_index + 1, place));
            index = node.first_index as usize;
        }
    }
    for place in (0..flat.len()).rev() {
        if flat[place].right != 0 {
            flat[place].bounds = flat[place + 1].bounds.union(&flat[flat[place].right as usize].bounds);
        }
    }
    flat
}

/// A balanced tree by median splits along the longest axis: the way out when the builder's tree grows too deep.
pub(super) fn balanced(boxes: &[Bounds]) -> Vec<FlatNode> {
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut flat: Vec<FlatNode> = Vec::with_capacity(2 * boxes.len());
    let mut stack = vec![(0usize, boxes.len(), u32::MAX)];
    if boxes.is_empty() {
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
            flat.push(FlatNode { bounds, right: 0, payload: order[start] });
            if end - start == 1 {
                break;
            }
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
