//! Light selection (the light sampler): one light by its importance at each point, all of them weighed where lights are few, by a light tree where
//! they are many. The learned light cache, where there is one, comes before the tree. Receivers that do not see all lights select in `linked_sampler`.

use super::context::LightSampleContext;
use super::light_bounds::LightBounds;
use super::row::{ROW, Reader};
use super::table::{LightSampler, LightTable, MOST_EXHAUSTIVE};
use super::tree::{Arrival, LightCache, LightTree, Point, Receiver};
use gonio_simd::{F, Lanes, U, Vec3};

/// Up to this many there is a kernel with less room.
const FEW: usize = 16;

impl LightTable {
    /// Importances of all lights at a point, added up.
    #[inline(always)]
    fn total_importance<L: Lanes>(&self, l: L, p: Vec3<L>, n: Vec3<L>) -> F<L> {
        let mut total = l.f(0.0);
        for row in self.rows.chunks_exact(ROW) {
            total += LightBounds::splat(l, row).importance(l, p, n);
        }
        total
    }

    /// Whether lights are too many to weigh all of them.
    pub fn has_tree(&self) -> bool {
        match &self.linked {
            Some(linked) => linked.has_tree(&self.sampler),
            None => matches!(self.sampler, LightSampler::Tree(_)),
        }
    }

    /// What light that arrived somewhere tells about which lights do; none where all are weighed anyway.
    pub fn learn(&self, arrivals: &[Arrival]) -> Option<LightCache> {
        match (&self.linked, &self.sampler) {
            (Some(linked), whole) => LightCache::learn(arrivals, |class| linked.tree(class, whole)),
            (None, LightSampler::Tree(tree)) => LightCache::learn(arrivals, |_| Some(tree)),
            (None, LightSampler::Exhaustive) => None,
        }
    }

    /// Selects a light for each point of a class of receivers and gives its probability: 0 where no light can arrive.
    #[inline(always)]
    pub fn sample_light<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, from: &LightSampleContext<L>, u: F<L>) -> (U<L>, F<L>) {
        match &self.linked {
            None => self.sample_all(l, light_cache, 0, from, u),
            Some(linked) => self.sample_linked(l, linked, light_cache, from, u),
        }
    }

    /// Selects one of all lights; the class tells which cells of the cache are meant.
    #[inline(always)]
    pub(super) fn sample_all<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        class: u32,
        from: &LightSampleContext<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        match &self.sampler {
            LightSampler::Exhaustive => self.sample_exhaustive(l, Point::of(from), u),
            LightSampler::Tree(tree) => self.sample_tree(l, (tree, light_cache), class, from, u),
        }
    }

    /// Selects a light of a tree; what is learned about the class' cells comes first.
    #[inline(always)]
    pub(super) fn sample_tree<L: Lanes>(
        &self,
        l: L,
        (tree, light_cache): (&LightTree, Option<&LightCache>),
        class: u32,
        from: &LightSampleContext<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        match light_cache {
            Some(light_cache) => light_cache.sample_light(l, tree, &self.rows, class, from, u),
            None => tree.sample_light(l, &self.rows, Point::of(from), u),
        }
    }

    /// Selects one of at most [`MOST_EXHAUSTIVE`] lights by the importances of them all.
    #[inline(always)]
    pub(super) fn sample_exhaustive<L: Lanes, R: Receiver<L>>(&self, l: L, receiver: R, u: F<L>) -> (U<L>, F<L>) {
        match self.count {
            // One light wants no registers of the receiver.
            0 | 1 => (l.u(0), l.f(1.0)),
            // Most scenes have few; room for 64 would be cleared each time.
            2..=FEW => self.sample_all_of::<L, R, FEW>(l, receiver, u),
            _ => self.sample_all_of::<L, R, MOST_EXHAUSTIVE>(l, receiver, u),
        }
    }

    /// The same of at most `MOST`.
    #[inline(always)]
    fn sample_all_of<L: Lanes, R: Receiver<L>, const MOST: usize>(&self, l: L, receiver: R, u: F<L>) -> (U<L>, F<L>) {
        let mut importances = [l.f(0.0); MOST];
        let mut total = l.f(0.0);
        for (row, importance) in self.rows.chunks_exact(ROW).zip(&mut importances) {
            *importance = receiver.weigh(l, &LightBounds::splat(l, row));
            total += *importance;
        }
        let target = u * total;
        let (mut light, mut chosen, mut sum) = (l.u(0), importances[0], importances[0]);
        for next in &importances[1..self.count] {
            let beyond = sum.le(target);
            light += beyond.to_integers();
            chosen = beyond.select(*next, chosen);
            sum += *next;
        }
        (light, chosen.share_of(total))
    }

    /// Probability (mass function) with which [`Self::sample_light`] selects `light` at a point of a class of receivers.
    #[inline(always)]
    pub fn light_pmf<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, from: &LightSampleContext<L>, light: U<L>) -> F<L> {
        match &self.linked {
            None => self.pmf_among_all(l, light_cache, 0, from, light),
            Some(linked) => self.pmf_linked(l, linked, light_cache, from, light),
        }
    }

    /// [`Self::sample_all`]'s probability of a light.
    #[inline(always)]
    pub(super) fn pmf_among_all<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        class: u32,
        from: &LightSampleContext<L>,
        light: U<L>,
    ) -> F<L> {
        match &self.sampler {
            LightSampler::Tree(tree) => self.pmf_in_tree(l, (tree, light_cache), class, from, light),
            LightSampler::Exhaustive if self.count <= 1 => l.f(1.0),
            LightSampler::Exhaustive => self.importance_of(l, from, light).share_of(self.total_importance(l, from.position, from.normal)),
        }
    }

    /// [`Self::sample_tree`]'s probability of a light.
    #[inline(always)]
    pub(super) fn pmf_in_tree<L: Lanes>(
        &self,
        l: L,
        (tree, light_cache): (&LightTree, Option<&LightCache>),
        class: u32,
        from: &LightSampleContext<L>,
        light: U<L>,
    ) -> F<L> {
        match light_cache {
            Some(light_cache) => light_cache.probability(l, tree, &self.rows, class, from, light),
            None => tree.probability(l, &self.rows, Point::of(from), light),
        }
    }

    /// The importance of a light of each lane.
    #[inline(always)]
    pub(super) fn importance_of<L: Lanes>(&self, l: L, from: &LightSampleContext<L>, light: U<L>) -> F<L> {
        LightBounds::gather(&Reader::new(l, &self.rows, light)).importance(l, from.position, from.normal)
    }
}
