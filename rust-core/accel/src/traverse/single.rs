//! Traversal of one tree with one ray.

use crate::intersect::lanes8::Lanes8;
use crate::intersect::prepared::PreparedRay;
use crate::tree::node::{ChildRef, Node, STACK, WIDTH};

/// What happens at the leaves of a traversal.
pub(crate) trait Visitor<K: Lanes8> {
    /// True when nearer children are to be visited first.
    const ORDERED: bool;
    /// Nothing beyond this distance is of interest.
    fn t_max(&self) -> f32;
    /// Has memory fetch a child that is pushed.
    fn fetch(&self, child: ChildRef);
    /// Visits a leaf; true ends the traversal.
    fn leaf(&mut self, lanes: K, ray: &PreparedRay, leaf: ChildRef) -> bool;
}

/// The traversal stack: the bits of the distance above the reference, so that whole entries sort by distance.
pub(crate) type Stack = [u64; STACK];

/// An empty stack.
pub(crate) const EMPTY_STACK: Stack = [0; STACK];

#[inline(always)]
fn entry(near: f32, child: ChildRef) -> u64 {
    (u64::from(near.to_bits()) << 32) | u64::from(child.0)
}

#[inline(always)]
fn push<V: Visitor<K>, K: Lanes8>(stack: &mut Stack, top: &mut usize, entry: u64, visitor: &V) {
    visitor.fetch(ChildRef(entry as u32));
    stack[*top % STACK] = entry;
    *top += 1;
}

/// Visits the leaves below `start` whose boxes the ray meets; true when the visitor ended the traversal.
#[inline(always)]
pub(crate) fn traverse<K: Lanes8, V: Visitor<K>>(
    lanes: K,
    nodes: &[Node],
    start: ChildRef,
    ray: &PreparedRay,
    stack: &mut Stack,
    visitor: &mut V,
) -> bool {
    let mut top = 0;
    let mut current = start;
    let mut near = [0.0; WIDTH];
    loop {
        if current.is_inner() {
            let node = &nodes[current.index()];
            let mask = lanes.boxes(node, ray, visitor.t_max(), &mut near);
            if mask != 0 {
                current = descend(node, mask, &near, stack, &mut top, visitor);
                continue;
            }
        } else if visitor.leaf(lanes, ray, current) {
            return true;
        }
        loop {
            if top == 0 {
                return false;
            }
            top -= 1;
            let popped = stack[top % STACK];
            if !V::ORDERED || f32::from_bits((popped >> 32) as u32) <= visitor.t_max() {
                current = ChildRef(popped as u32);
                break;
            }
        }
    }
}

/// Chooses the next child among those of a mask that is not zero, and leaves the others on the stack.
#[inline(always)]
fn descend<V: Visitor<K>, K: Lanes8>(
    node: &Node,
    mask: u32,
    near: &[f32; WIDTH],
    stack: &mut Stack,
    top: &mut usize,
    visitor: &V,
) -> ChildRef {
    let first = mask.trailing_zeros() as usize % WIDTH;
    let rest = mask & (mask - 1);
    if rest == 0 {
        return node.children[first];
    }
    if !V::ORDERED {
        // Smallest box first: often a leaf, and a likely end of the search.
        let (mut slot, mut rest) = (first, rest);
        while rest != 0 {
            push(stack, top, entry(0.0, node.children[slot]), visitor);
            slot = rest.trailing_zeros() as usize % WIDTH;
            rest &= rest - 1;
        }
        return node.children[slot];
    }
    let second = rest.trailing_zeros() as usize % WIDTH;
    let (a, b) = (entry(near[first], node.children[first]), entry(near[second], node.children[second]));
    let (mut low, mut high) = (a.min(b), a.max(b));
    let mut rest = rest & (rest - 1);
    if rest == 0 {
        push(stack, top, high, visitor);
        return ChildRef(low as u32);
    }
    let third = rest.trailing_zeros() as usize % WIDTH;
    let c = entry(near[third], node.children[third]);
    rest &= rest - 1;
    if rest == 0 {
        let middle = low.max(c);
        low = low.min(c);
        push(stack, top, high.max(middle), visitor);
        push(stack, top, high.min(middle), visitor);
        return ChildRef(low as u32);
    }
    let fourth = rest.trailing_zeros() as usize % WIDTH;
    let d = entry(near[fourth], node.children[fourth]);
    rest &= rest - 1;
    let (low2, high2) = (c.min(d), c.max(d));
    let (inner1, inner2) = (low.max(low2), high.min(high2));
    low = low.min(low2);
    high = high.max(high2);
    if rest == 0 {
        push(stack, top, high, visitor);
        push(stack, top, inner1.max(inner2), visitor);
        push(stack, top, inner1.min(inner2), visitor);
        return ChildRef(low as u32);
    }
    let mut sorted = [high, inner1.max(inner2), inner1.min(inner2), low, 0, 0, 0, 0];
    let mut n = 4;
    while rest != 0 {
        let slot = rest.trailing_zeros() as usize % WIDTH;
        let e = entry(near[slot], node.children[slot]);
        let mut place = n;
        while place > 0 && sorted[(place - 1) % WIDTH] < e {
            sorted[place % WIDTH] = sorted[(place - 1) % WIDTH];
            place -= 1;
        }
        sorted[place % WIDTH] = e;
        n += 1;
        rest &= rest - 1;
    }
    for &e in &sorted[..n - 1] {
        push(stack, top, e, visitor);
    }
    ChildRef(sorted[n - 1] as u32)
}
