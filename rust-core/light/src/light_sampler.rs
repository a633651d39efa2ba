//! Light selection (the light sampler): one light by its importance at each point, all of them weighed where lights are few, by a light tree where
//! they are many. The learned light cache, where there is one, comes before the tree.

use super::light_bounds::LightBounds;
use super::row::{ROW, Reader};
use super::table::{LightSampler, LightTable, MOST_EXHAUSTIVE};
use super::tree::{Arrival, LightCache};
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
        matches!(self.sampler, LightSampler::Tree(_))
    }

    /// What light that arrived somewhere tells about which lights do; none where all are weighed anyway.
    pub fn learn(&self, arrivals: &[Arrival]) -> Option<LightCache> {
        match &self.sampler {
            LightSampler::Tree(tree) => LightCache::learn(tree, arrivals),
            LightSampler::Exhaustive => None,
        }
    }

    /// Selects a light for each point and gives its probability: 0 where no light can arrive.
    #[inline(always)]
    pub fn sample_light<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, p: &Vec3<L>, n: &Vec3<L>, u: F<L>) -> (U<L>, F<L>) {
        match (&self.sampler, light_cache) {
            // One light wants no registers of the point.
            (LightSampler::Exhaustive, _) if self.count <= 1 => (l.u(0), l.f(1.0)),
            // Most scenes have few; room for 64 would be cleared each time.
            (LightSampler::Exhaustive, _) if self.count <= FEW => self.sample_exhaustive::<L, FEW>(l, *p, *n, u),
            (LightSampler::Exhaustive, _) => self.sample_exhaustive::<L, MOST_EXHAUSTIVE>(l, *p, *n, u),
            (LightSampler::Tree(tree), Some(light_cache)) => light_cache.sample_light(l, tree, &self.rows, *p, *n, u),
            (LightSampler::Tree(tree), None) => tree.sample_light(l, &self.rows, *p, *n, u),
        }
    }

    /// Selects one of at most `MOST` lights by the importances of them all.
    #[inline(always)]
    fn sample_exhaustive<L: Lanes, const MOST: usize>(&self, l: L, p: Vec3<L>, n: Vec3<L>, u: F<L>) -> (U<L>, F<L>) {
        let mut importances = [l.f(0.0); MOST];
        let mut total = l.f(0.0);
        for (row, importance) in self.rows.chunks_exact(ROW).zip(&mut importances) {
            *importance = LightBounds::splat(l, row).importance(l, p, n);
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

    /// Probability (mass function) with which [`Self::sample_light`] selects `light` at a point.
    #[inline(always)]
    pub fn light_pmf<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, p: Vec3<L>, n: Vec3<L>, light: U<L>) -> F<L> {
        match (&self.sampler, light_cache) {
            (LightSampler::Tree(tree), Some(light_cache)) => light_cache.probability(l, tree, &self.rows, p, n, light),
            (LightSampler::Tree(tree), None) => tree.probability(l, &self.rows, p, n, light),
            (LightSampler::Exhaustive, _) if self.count <= 1 => l.f(1.0),
            (LightSampler::Exhaustive, _) => {
                let total = self.total_importance(l, p, n);
                let chosen = LightBounds::gather(&Reader::new(l, &self.rows, light)).importance(l, p, n);
                chosen.share_of(total)
            }
        }
    }
}
