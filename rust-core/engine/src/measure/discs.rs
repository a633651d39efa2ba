//! The discs of all meters in a tree, so that each segment of a light path is asked of few.

use super::{disc::Disc, vector::Vector};
use crate::transport::Segment;

/// Discs of a leaf.
const LEAF: usize = 4;

/// Some discs, and the tree over those with room.
#[derive(Debug)]
pub(super) struct Discs {
    all: Vec<Disc>,
    /// Numbers of discs, in the order of the leaves.
    order: Vec<u32>,
    /// The first is the root.
    nodes: Vec<Node>,
}

/// A box, and what is in it.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: Vector,
    high: Vector,
    content: Content,
}

#[derive(Clone, Copy, Debug)]
enum Content {
    /// First disc in the order, and the end.
    Leaf(usize, usize),
    /// The other child follows its parent.
    Second(usize),
}

impl Discs {
    pub(super) fn new(all: Vec<Disc>) -> Self {
        let order = (0..all.len() as u32).filter(|disc| all[*disc as usize].radius > 0.0).collect();
        let mut discs = Self { all, order, nodes: Vec::new() };
        if !discs.order.is_empty() {
            discs.divide(0, discs.order.len());
        }
        discs
    }

    pub(super) fn all(&self) -> &[Disc] {
        &self.all
    }

    /// Whether none has room.
    pub(super) fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Makes the node of some discs and all below it.
    fn divide(&mut self, first: usize, end: usize) {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for disc in self.order[first..end].iter().map(|disc| &self.all[*disc as usize]) {
            for axis in 0..3 {
                low[axis] = low[axis].min(disc.position[axis] - disc.radius);
                high[axis] = high[axis].max(disc.position[axis] + disc.radius);
            }
        }
        let number = self.nodes.len();
        self.nodes.push(Node { low, high, content: Content::Leaf(first, end) });
        if end - first <= LEAF {
            return;
        }
        let longest = (0..3).max_by(|a, b| (high[*a] - low[*a]).total_cmp(&(high[*b] - low[*b]))).unwrap_or(0);
        let place = |disc: &u32| self.all[*disc as usize].position[longest];
        let middle = (first + end) / 2;
        self.order[first..end].select_nth_unstable_by(middle - first, |a, b| place(a).total_cmp(&place(b)));
        self.divide(first, middle);
        self.nodes[number].content = Content::Second(self.nodes.len());
        self.divide(middle, end);
    }

    /// Tells of each disc that a segment crosses: its number, where the segment does, and how much of the flux counts.
    pub(super) fn crossed(&self, segment: &Segment, waiting: &mut Vec<usize>, mut found: impl FnMut(usize, f64, f64)) {
        waiting.clear();
        waiting.extend((!self.nodes.is_empty()).then_some(0));
        let inverse = segment.direction.map(|x| 1.0 / f64::from(x));
        while let Some(number) = waiting.pop() {
            let node = &self.nodes[number];
            if !node.is_met(segment, inverse) {
                continue;
            }
            match node.content {
                Content::Second(second) => waiting.extend([second, number + 1]),
                Content::Leaf(first, end) => {
                    for disc in &self.order[first..end] {
                        if let Some((at, weight)) = self.all[*disc as usize].crossed(segment) {
                            found(*disc as usize, at, weight);
                        }
                    }
                }
            }
        }
    }
}

impl Node {
    /// Whether the line of a segment meets the box, before the segment's end or a little behind: discs on surfaces lie about there.
    fn is_met(&self, segment: &Segment, inverse: Vector) -> bool {
        let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
        for (axis, inverse) in inverse.into_iter().enumerate() {
            let origin = f64::from(segment.origin[axis]);
            let [a, b] = [self.low[axis], self.high[axis]].map(|side| (side - origin) * inverse);
            // Along a side 0 · ∞ is no number, and does not count.
            enters = enters.max(a.min(b));
            leaves = leaves.min(a.max(b));
        }
        enters <= leaves && leaves >= f64::from(segment.from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_all_discs_find() {
        let numbers = |seed: u32| (0..6).map(move |k| ((seed * 6 + k) as f64 * 0.754_877_666).fract()).collect::<Vec<f64>>();
        let discs: Vec<Disc> =
            (0..200).map(|seed| Disc::for_test([0, 1, 2].map(|k| numbers(seed)[k]), 0.02 + 0.1 * numbers(seed)[3])).collect();
        let tree = Discs::new(discs.clone());
        let (mut waiting, mut count) = (Vec::new(), 0);
        for seed in 0..300 {
            let [a, b] = [0, 3].map(|from| [0, 1, 2].map(|k| numbers(1000 + seed)[from + k]));
            let way = [0, 1, 2].map(|k| b[k] - a[k]);
            let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            let direction = way.map(|x| (x / length) as f32);
            let segment = Segment { origin: a.map(|x| x as f32), direction, from: 0.0, to: length as f32 };
            let mut found = Vec::new();
            tree.crossed(&segment, &mut waiting, |disc, _, _| found.push(disc));
            found.sort_unstable();
            let expected: Vec<usize> = (0..discs.len()).filter(|disc| discs[*disc].crossed(&segment).is_some()).collect();
            assert_eq!(found, expected);
            count += found.len();
        }
        assert!(count > 100, "{count}");
    }
}
