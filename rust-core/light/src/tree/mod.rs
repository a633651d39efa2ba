//! The light tree (light BVH), which selects one of many lights. Sets of lights are weighed by their importance at a point, then the parts of the
//! selected set, down to a light.
//!
//! Dozens of sets at the top are weighed for all lanes alike, without gathers; below, nodes have up to eight children. Infinite lights have no
//! place in the tree: their importances stand beside the top's.

mod bound;
mod build;
mod learn;
mod light_cache;
mod node;
mod receiver;
mod single;

use super::light_bounds::LightBounds;
use super::row::{ROW, Reader, field, flag};
use bound::Bound;
use build::{NONE, Nodes, TOP, WIDTH};
use gonio_simd::{F, Lanes, M, One, U};
pub use learn::Arrival;
pub use light_cache::LightCache;
use node::{Below, Node, WORDS};
pub(crate) use receiver::{Point, Receiver};

/// A light tree.
#[derive(Clone, Debug)]
pub(crate) struct LightTree {
    nodes: Nodes,
    /// The nodes at the top, unpacked.
    top: Vec<Node<One>>,
    /// The leaf of each light, none for infinite lights and dark ones.
    leaves: Vec<u32>,
    /// Infinite lights.
    infinite: Vec<u32>,
}

/// One of several weights, drawn.
#[derive(Clone, Copy, Debug)]
struct Drawn<L: Lanes> {
    index: U<L>,
    probability: F<L>,
    /// The number that drew it, spread over `[0, 1)` again.
    rest: F<L>,
}

/// A number in `[0, 1)` again after it was spread.
#[inline(always)]
fn below_one<L: Lanes>(u: F<L>) -> F<L> {
    u.clamp(0.0, 1.0 - f32::EPSILON)
}

/// Draws one of the weights that add up to `total`.
#[inline(always)]
fn draw<L: Lanes>(l: L, weights: &[F<L>], total: F<L>, u: F<L>) -> Drawn<L> {
    let target = u * total;
    let (mut index, mut own, mut before, mut sum) = (l.u(0), l.f(0.0), l.f(0.0), l.f(0.0));
    for (number, weight) in weights.iter().enumerate() {
        let reached = sum.le(target) & weight.gt(0.0);
        index = reached.select(l.u(number as u32), index);
        own = reached.select(*weight, own);
        before = reached.select(sum, before);
        sum += *weight;
    }
    let rest = below_one((target - before) / own.max(f32::MIN_POSITIVE));
    Drawn { index, probability: own.share_of(total), rest }
}

impl LightTree {
    /// A tree over the lights of these rows.
    pub(crate) fn new(rows: &[f32]) -> Self {
        Self::of(rows, |_| true)
    }

    /// A tree over some of them.
    pub(crate) fn of(rows: &[f32], chosen: impl Fn(u32) -> bool) -> Self {
        let rows = rows.as_chunks::<ROW>().0;
        let of = |infinite: bool| {
            let lights = rows.iter().enumerate().filter(|(light, row)| row[field::STRENGTH] > 0.0 && chosen(*light as u32));
            lights.filter(move |(_, row)| (row[field::FLAGS].to_bits() & flag::INFINITE != 0) == infinite)
        };
        let mut near: Vec<_> = of(false).map(|(light, row)| (light as u32, Bound::of_row(row))).collect();
        let nodes = build::build(&mut near);
        let mut leaves = vec![NONE; rows.len()];
        for (number, words) in nodes.words.as_chunks::<WORDS>().0.iter().enumerate() {
            if let Some(light) = node::light(words) {
                leaves[light as usize] = number as u32;
            }
        }
        let top = (0..nodes.top as u32).map(|node| Node::gather(One, &nodes.words, U(node))).collect();
        Self { nodes, top, leaves, infinite: of(true).map(|(light, _)| light as u32).collect() }
    }

    /// Selects a light for each receiver and gives its probability: 0 where no light can arrive.
    #[inline(always)]
    pub(crate) fn sample_light<L: Lanes>(&self, l: L, rows: &[f32], receiver: impl Receiver<L>, u: F<L>) -> (U<L>, F<L>) {
        let mut weights = [l.f(0.0); TOP + 1];
        weights[0] = self.infinite_importance(l, rows, receiver);
        let mut total = weights[0];
        for (node, weight) in self.top.iter().zip(&mut weights[1..]) {
            *weight = receiver.weigh_node(l, &Node::splat(l, node));
            total += *weight;
        }
        let drawn = draw(l, &weights[..=self.top.len()], total, u);
        let far = drawn.index.eq(0);
        let (near, probability) = self.descend(l, receiver, drawn, !far);
        if !far.any() {
            return (near, probability);
        }
        let (light, share) = self.sample_infinite(l, rows, receiver, drawn.rest);
        (far.select(light, near), far.select(drawn.probability * share, probability))
    }

    /// Probability that [`Self::sample_light`] selects `light` for a receiver.
    #[inline(always)]
    pub(crate) fn probability<L: Lanes>(&self, l: L, rows: &[f32], receiver: impl Receiver<L>, light: U<L>) -> F<L> {
        let mut total = self.infinite_importance(l, rows, receiver);
        for node in &self.top {
            total += receiver.weigh_node(l, &Node::splat(l, node));
        }
        let leaf = l.gather_integers(&self.leaves, light);
        let near = leaf.ne(NONE);
        let (node, share) = self.climb(l, receiver, leaf, near);
        let weight = if near.any() { receiver.weigh_node(l, &Node::gather(l, &self.nodes.words, node)) * share } else { l.f(0.0) };
        let weight = near.select(weight, receiver.weigh(l, &LightBounds::gather(&Reader::new(l, rows, light))));
        weight.share_of(total)
    }

    /// Importances of the children of each lane's node, zero beyond the last, and their sum.
    #[inline(always)]
    fn children<L: Lanes>(&self, l: L, receiver: impl Receiver<L>, parent: Below<L>, inner: M<L>) -> ([F<L>; WIDTH], F<L>) {
        let (first, count) = (parent.index(), parent.count().keep_if(inner));
        let (mut weights, mut total) = ([l.f(0.0); WIDTH], l.f(0.0));
        for (child, weight) in weights.iter_mut().enumerate() {
            let present = l.u(child as u32).lt(count);
            if !present.any() {
                break;
            }
            *weight = receiver.weigh_node(l, &Node::gather(l, &self.nodes.words, first + child as u32)).keep_if(present);
            total += *weight;
        }
        (weights, total)
    }

    /// From a node at the top down to a light, and the probability of all selections on the way.
    #[inline(always)]
    fn descend<L: Lanes>(&self, l: L, receiver: impl Receiver<L>, top: Drawn<L>, near: M<L>) -> (U<L>, F<L>) {
        let mut probability = top.probability;
        if !near.any() {
            return (l.u(0), probability);
        }
        let mut rest = top.rest;
        let mut node = Below::gather(l, &self.nodes.words, top.index - 1);
        loop {
            let inner = near.and_not(node.is_leaf());
            if !inner.any() {
                return (node.index(), probability);
            }
            let (weights, total) = self.children(l, receiver, node, inner);
            let drawn = draw(l, &weights, total, rest);
            let chosen = Below::gather(l, &self.nodes.words, node.index() + drawn.index);
            node = node.replaced_by(chosen, inner);
            probability = inner.select(probability * drawn.probability, probability);
            rest = inner.select(drawn.rest, rest);
        }
    }

    /// From a leaf up to the top, and the probability of its being selected from there, for MIS.
    #[inline(always)]
    fn climb<L: Lanes>(&self, l: L, receiver: impl Receiver<L>, leaf: U<L>, near: M<L>) -> (U<L>, F<L>) {
        let (mut node, mut probability) = (leaf, l.f(1.0));
        while near.any() {
            let parent = l.gather_integers(&self.nodes.parents, node);
            let below = near & parent.ne(NONE);
            if !below.any() {
                break;
            }
            let (_, total) = self.children(l, receiver, Below::gather(l, &self.nodes.words, parent), below);
            let own = receiver.weigh_node(l, &Node::gather(l, &self.nodes.words, node));
            let share = own.share_of(total);
            probability = below.select(probability * share, probability);
            node = below.select(parent, node);
        }
        (node, probability)
    }

    /// Importances of the infinite lights, added up.
    #[inline(always)]
    fn infinite_importance<L: Lanes>(&self, l: L, rows: &[f32], receiver: impl Receiver<L>) -> F<L> {
        let mut total = l.f(0.0);
        for light in &self.infinite {
            total += receiver.weigh(l, &LightBounds::splat(l, &rows[*light as usize * ROW..]));
        }
        total
    }

    /// Selects one of the infinite lights.
    #[inline(always)]
    fn sample_infinite<L: Lanes>(&self, l: L, rows: &[f32], receiver: impl Receiver<L>, u: F<L>) -> (U<L>, F<L>) {
        let total = self.infinite_importance(l, rows, receiver);
        let target = u * total;
        let (mut light, mut own, mut sum) = (l.u(0), l.f(0.0), l.f(0.0));
        for candidate in &self.infinite {
            let weight = receiver.weigh(l, &LightBounds::splat(l, &rows[*candidate as usize * ROW..]));
            let reached = sum.le(target) & weight.gt(0.0);
            light = reached.select(l.u(*candidate), light);
            own = reached.select(weight, own);
            sum += weight;
        }
        (light, own.share_of(total))
    }
}
