//! Binary trees in preorder in one row of memory, the form the collapse reads.

use super::division::{Item, Source};
use crate::tree::node::Bounds;
use bytemuck::{Pod, Zeroable};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;

/// What is kept of a node until wide nodes are made: what is below, and how the collapse shares its slots. Boxes take three times as much, and
/// lie apart where they are kept.
///
/// The left child of an inner node is the next node.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Link {
    /// How far behind the right child lies, or with its kind's bit the item of a leaf or the place of a root elsewhere in the row.
    to: u32,
    /// See `collapse.rs`.
    pub(super) plan: u32,
}

/// A box that is kept: lowest and highest corner. Memory for many comes from the kernel as zeros.
pub(super) type KeptBox = [[f32; 3]; 2];

/// One node of a tree that is built and planned.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatNode {
    bounds: Bounds,
    pub(super) link: Link,
}

const LEAF: u32 = 1 << 31;
const ELSEWHERE: u32 = 1 << 30;

/// The most nodes of a row: links hold places below.
pub(super) const MAX_NODES: usize = ELSEWHERE as usize;

impl Link {
    /// What a leaf holds.
    pub(super) fn item(self) -> Option<Item> {
        (self.to & LEAF != 0).then_some(Item(self.to & !LEAF))
    }

    /// Where the root lies that this stands for.
    pub(super) fn elsewhere_place(self) -> Option<usize> {
        (self.to & (LEAF | ELSEWHERE) == ELSEWHERE).then_some((self.to & !ELSEWHERE) as usize)
    }

    /// Whether it has no children of its own.
    pub(super) fn is_last(self) -> bool {
        self.to & (LEAF | ELSEWHERE) != 0
    }
}

impl FlatNode {
    /// Of no tree.
    pub(super) const NONE: FlatNode = FlatNode { bounds: Bounds::EMPTY, link: Link { to: 0, plan: 0 } };

    fn new(bounds: &Aabb, to: u32) -> Self {
        FlatNode { bounds: as_bounds(bounds), link: Link { to, plan: 0 } }
    }

    /// A leaf with this box.
    pub(super) fn leaf(bounds: &Aabb, item: Item) -> Self {
        FlatNode::new(bounds, item.0 | LEAF)
    }

    /// What stands for the tree whose root, with this box, lies at a place.
    pub(super) fn elsewhere(bounds: &Aabb, place: usize) -> Self {
        FlatNode::new(bounds, place as u32 | ELSEWHERE)
    }

    pub(super) fn aabb(&self) -> Aabb {
        Aabb::new(self.bounds.min.into(), self.bounds.max.into())
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.bounds
    }

    pub(super) fn kept_box(&self) -> KeptBox {
        [self.bounds.min, self.bounds.max]
    }

    pub(super) fn set_box(&mut self, bounds: &Aabb) {
        self.bounds = as_bounds(bounds);
    }

    /// Left and right child of the inner node at a place of a tree.
    pub(super) fn children(tree: &[FlatNode], place: usize) -> [usize; 2] {
        [place + 1, place + tree[place].link.to as usize]
    }
}

fn as_bounds(bounds: &Aabb) -> Bounds {
    Bounds { min: bounds.min.to_array(), max: bounds.max.to_array() }
}

/// Left and right child of the inner node at a place.
#[inline(always)]
pub(super) fn children(row: &[Link], place: usize) -> [usize; 2] {
    [place + 1, place + row[place].to as usize].map(|child| root(row, child))
}

/// The place of the node that the one at a place stands for.
#[inline(always)]
pub(super) fn root(row: &[Link], place: usize) -> usize {
    row[place].elsewhere_place().unwrap_or(place)
}

/// The part of a row that is the tree of a place, which nothing elsewhere belongs to.
fn tree_at(row: &[Link], place: usize) -> &[Link] {
    let mut open = 1;
    let mut nodes = 0;
    while open > 0 {
        open = if row[place + nodes].is_last() { open - 1 } else { open + 1 };
        nodes += 1;
    }
    &row[place..place + nodes]
}

/// The box of all that is below a place, which nothing elsewhere belongs to.
pub(super) fn box_at(source: &impl Source, row: &[Link], place: usize) -> Bounds {
    let items = tree_at(row, place).iter().filter_map(|link| link.item());
    as_bounds(&items.fold(Aabb::empty(), |all, item| all.union(&item.bounds(source))))
}

/// The boxes of all nodes of the tree of a place, which nothing elsewhere belongs to.
pub(super) fn boxes_at(source: &impl Source, row: &[Link], place: usize, boxes: &mut Vec<Bounds>) {
    let tree = tree_at(row, place);
    boxes.clear();
    boxes.resize(tree.len(), Bounds::EMPTY);
    for (at, link) in tree.iter().enumerate().rev() {
        boxes[at] = match link.item() {
            Some(item) => as_bounds(&item.bounds(source)),
            None => boxes[at + 1].union(&boxes[at + link.to as usize]),
        };
    }
}

/// Nodes of a binary tree of so many leaves, at least one.
pub(super) fn nodes_over(leaves: usize) -> usize {
    2 * leaves - 1
}

/// Writes nodes in preorder.
struct Writer<'a> {
    row: &'a mut [FlatNode],
    next: usize,
}

impl Writer<'_> {
    fn push(&mut self, node: FlatNode) -> usize {
        self.row[self.next] = node;
        self.next += 1;
        self.next - 1
    }

    /// The next node is the right child of the one at a place.
    fn begin_right_of(&mut self, parent: Option<usize>) {
        if let Some(parent) = parent {
            self.row[parent].link.to = (self.next - parent) as u32;
        }
    }
}

/// Writes a builder's tree, whose leaf of box `i` becomes the leaf `i`, in preorder; inner nodes keep the builder's boxes.
pub(super) fn flatten(tree: &Bvh2, leaf: impl Fn(usize) -> FlatNode, row: &mut [FlatNode]) {
    let mut writer = Writer { row, next: 0 };
    // A pending right child comes with its parent.
    let mut stack: Vec<(usize, Option<usize>)> = vec![(0, None)];
    while let Some((mut index, parent)) = stack.pop() {
        writer.begin_right_of(parent);
        loop {
            let node = &tree.nodes[index];
            index = node.first_index as usize;
            if node.is_leaf() {
                writer.push(leaf(index));
                break;
            }
            let place = writer.push(FlatNode::new(node.aabb(), 0));
            stack.push((index + 1, Some(place)));
        }
    }
}

/// Writes a balanced tree by median splits along the longest axis: the way out when the builder's tree grows too deep.
pub(super) fn balanced(boxes: &[Aabb], leaf: impl Fn(usize) -> FlatNode, row: &mut [FlatNode]) {
    let mut writer = Writer { row, next: 0 };
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut stack: Vec<(usize, usize, Option<usize>)> = vec![(0, boxes.len(), None)];
    while let Some((start, mut end, parent)) = stack.pop() {
        writer.begin_right_of(parent);
        while end - start > 1 {
            let bounds = order[start..end].iter().fold(Aabb::empty(), |all, &i| all.union(&boxes[i as usize]));
            let middle = start + (end - start) / 2;
            split_at_median(boxes, &mut order[start..end], middle - start, &bounds);
            let place = writer.push(FlatNode::new(&bounds, 0));
            stack.push((middle, end, Some(place)));
            end = middle;
        }
        writer.push(leaf(order[start] as usize));
    }
}

fn split_at_median(boxes: &[Aabb], order: &mut [u32], middle: usize, bounds: &Aabb) {
    let axis = bounds.diagonal().max_position();
    let centre = |i: u32| boxes[i as usize].min[axis] + boxes[i as usize].max[axis];
    order.select_nth_unstable_by(middle, |&a, &b| centre(a).total_cmp(&centre(b)).then(a.cmp(&b)));
}
