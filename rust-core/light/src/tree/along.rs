//! Selection of a light for a whole way through a medium, down the tree.

use super::node::{Below, Node};
use super::{Drawn, LightTree, TOP, WIDTH, draw};
use crate::light_bounds::LightBounds;
use crate::row::ROW;
use crate::way::LightWay;
use gonio_simd::{F, Lanes, M, U};

impl LightTree {
    /// Selects a light for each way and gives its probability.
    #[inline(always)]
    pub(crate) fn sample_along<L: Lanes>(&self, l: L, rows: &[f32], way: &LightWay<L>, u: F<L>) -> (U<L>, F<L>) {
        let far = |light: u32| LightBounds::splat(l, &rows[light as usize * ROW..]).importance_along(l, way);
        let mut weights = [l.f(0.0); TOP + 1];
        for light in &self.infinite {
            weights[0] += far(*light);
        }
        let mut total = weights[0];
        for (node, weight) in self.top.iter().zip(&mut weights[1..]) {
            *weight = Node::splat(l, node).importance_along(way);
            total += *weight;
        }
        let drawn = draw(l, &weights[..=self.top.len()], total, u);
        let at_infinity = drawn.index.eq(0);
        let (near, probability) = self.descend_along(l, way, drawn, !at_infinity);
        if !at_infinity.any() {
            return (near, probability);
        }
        let target = drawn.rest * weights[0];
        let (mut light, mut own, mut sum) = (l.u(0), l.f(0.0), l.f(0.0));
        for candidate in &self.infinite {
            let weight = far(*candidate);
            let reached = sum.le(target) & weight.gt(0.0);
            light = reached.select(l.u(*candidate), light);
            own = reached.select(weight, own);
            sum += weight;
        }
        (at_infinity.select(light, near), at_infinity.select(drawn.probability * own.share_of(weights[0]), probability))
    }

    /// From a node at the top down to a light, and the probability of all selections on the way.
    #[inline(always)]
    fn descend_along<L: Lanes>(&self, l: L, way: &LightWay<L>, top: Drawn<L>, near: M<L>) -> (U<L>, F<L>) {
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
            let (first, count) = (node.index(), node.count().keep_if(inner));
            let (mut weights, mut total) = ([l.f(0.0); WIDTH], l.f(0.0));
            for (child, weight) in weights.iter_mut().enumerate() {
                let present = l.u(child as u32).lt(count);
                if !present.any() {
                    break;
                }
                *weight = Node::gather(l, &self.nodes.words, first + child as u32).importance_along(way).keep_if(present);
                total += *weight;
            }
            let drawn = draw(l, &weights, total, rest);
            let chosen = Below::gather(l, &self.nodes.words, node.index() + drawn.index);
            node = node.replaced_by(chosen, inner);
            probability = inner.select(probability * drawn.probability, probability);
            rest = inner.select(drawn.rest, rest);
        }
    }
}
