//! What lights are selected for: points, and whole ways through media.

use super::node::Node;
use crate::context::LightSampleContext;
use crate::light_bounds::LightBounds;
use crate::way::LightWay;
use gonio_simd::{F, Lanes, Vec3};

/// What a light is wanted for, in each lane: how important lights, and nodes of the tree, are to it.
pub(crate) trait Receiver<L: Lanes>: Copy {
    /// Of a light.
    fn weigh(self, l: L, light: &LightBounds<L>) -> F<L>;
    /// Of all lights below a node.
    fn weigh_node(self, l: L, node: &Node<L>) -> F<L>;
}

/// A surface point with its normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<L: Lanes> {
    pub(super) p: Vec3<L>,
    pub(super) n: Vec3<L>,
}

impl<L: Lanes> Point<L> {
    #[inline(always)]
    pub(crate) fn of(from: &LightSampleContext<L>) -> Self {
        Self { p: from.position, n: from.normal }
    }
}

impl<L: Lanes> Receiver<L> for Point<L> {
    #[inline(always)]
    fn weigh(self, l: L, light: &LightBounds<L>) -> F<L> {
        light.importance(l, self.p, self.n)
    }

    #[inline(always)]
    fn weigh_node(self, l: L, node: &Node<L>) -> F<L> {
        node.importance(l, self.p, self.n)
    }
}

impl<L: Lanes> Receiver<L> for LightWay<L> {
    #[inline(always)]
    fn weigh(self, l: L, light: &LightBounds<L>) -> F<L> {
        light.importance_along(l, &self)
    }

    #[inline(always)]
    fn weigh_node(self, _: L, node: &Node<L>) -> F<L> {
        node.importance_along(&self)
    }
}
