//! Light selection (the light sampler): one light by its importance at each point, all of them weighed where lights are few, by a light tree where
//! they are many. The learned light cache, where there is one, comes before the tree. Receivers that do not see all lights select among their own.

use super::light_bounds::LightBounds;
use super::links::{ClassSampler, LinkedLights, SEVERAL};
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
    pub fn sample_light<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        receiver: U<L>,
        p: &Vec3<L>,
        n: &Vec3<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        match &self.linked {
            None => self.sample_all(l, light_cache, 0, p, n, u),
            Some(linked) => self.sample_linked(l, linked, light_cache, receiver, p, n, u),
        }
    }

    /// Selects one of all lights; the class tells which cells of the cache are meant.
    #[inline(always)]
    fn sample_all<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, class: u32, p: &Vec3<L>, n: &Vec3<L>, u: F<L>) -> (U<L>, F<L>) {
        match (&self.sampler, light_cache) {
            // One light wants no registers of the point.
            (LightSampler::Exhaustive, _) if self.count <= 1 => (l.u(0), l.f(1.0)),
            // Most scenes have few; room for 64 would be cleared each time.
            (LightSampler::Exhaustive, _) if self.count <= FEW => self.sample_exhaustive::<L, FEW>(l, *p, *n, u),
            (LightSampler::Exhaustive, _) => self.sample_exhaustive::<L, MOST_EXHAUSTIVE>(l, *p, *n, u),
            (LightSampler::Tree(tree), Some(light_cache)) => light_cache.sample_light(l, tree, &self.rows, class, *p, *n, u),
            (LightSampler::Tree(tree), None) => tree.sample_light(l, &self.rows, *p, *n, u),
        }
    }

    /// Selects for each point among the lights that its class sees, class by class: a function of its own, so that scenes without links have no
    /// part of it.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "links, and a point of a class")]
    fn sample_linked<L: Lanes>(
        &self,
        l: L,
        linked: &LinkedLights,
        light_cache: Option<&LightCache>,
        receiver: U<L>,
        p: &Vec3<L>,
        n: &Vec3<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        l.vectorize(
            #[inline(always)]
            || {
                // Whoever has one light selects it.
                let only = l.gather_integers(&linked.only, receiver);
                let mut left = only.eq(SEVERAL);
                let (mut light, mut probability) = (only.keep_if(!left), l.f(1.0).keep_if(!left));
                while left.any() {
                    let class = receiver.to_array()[left.bits().trailing_zeros() as usize];
                    let same = left & receiver.eq(class);
                    let (own, share) = self.sample_class(l, linked, light_cache, class, p, n, u);
                    light = same.select(own, light);
                    probability = same.select(share, probability);
                    left = left.and_not(same);
                }
                (light, probability)
            },
        )
    }

    /// Selects among the lights of one class.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "links, and a point of a class")]
    fn sample_class<L: Lanes>(
        &self,
        l: L,
        linked: &LinkedLights,
        light_cache: Option<&LightCache>,
        class: u32,
        p: &Vec3<L>,
        n: &Vec3<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        match (linked.classes.get(class as usize), light_cache) {
            (None, _) => (l.u(0), l.f(0.0)),
            (Some(ClassSampler::Few(lights)), _) => self.sample_few(l, lights, *p, *n, u),
            (Some(ClassSampler::Tree(tree)), Some(light_cache)) => light_cache.sample_light(l, tree, &self.rows, class, *p, *n, u),
            (Some(ClassSampler::Tree(tree)), None) => tree.sample_light(l, &self.rows, *p, *n, u),
            (Some(ClassSampler::All), _) => {
                let (light, probability) = self.sample_all(l, light_cache, class, p, n, u);
                (light, probability.keep_if(linked.links.sees(l, l.u(class), light)))
            }
        }
    }

    /// Selects one of a list of at most [`MOST_EXHAUSTIVE`] lights by the importances of them all.
    #[inline(always)]
    fn sample_few<L: Lanes>(&self, l: L, lights: &[u32], p: Vec3<L>, n: Vec3<L>, u: F<L>) -> (U<L>, F<L>) {
        let mut importances = [l.f(0.0); MOST_EXHAUSTIVE];
        let mut total = l.f(0.0);
        for (light, importance) in lights.iter().zip(&mut importances) {
            *importance = LightBounds::splat(l, &self.rows[*light as usize * ROW..][..ROW]).importance(l, p, n);
            total += *importance;
        }
        let target = u * total;
        let (mut chosen, mut own, mut sum) = (l.u(0), l.f(0.0), l.f(0.0));
        for (light, importance) in lights.iter().zip(&importances) {
            let reached = sum.le(target) & importance.gt(0.0);
            chosen = reached.select(l.u(*light), chosen);
            own = reached.select(*importance, own);
            sum += *importance;
        }
        (chosen, own.share_of(total))
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

    /// Probability (mass function) with which [`Self::sample_light`] selects `light` at a point of a class of receivers.
    #[inline(always)]
    pub fn light_pmf<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, receiver: U<L>, p: Vec3<L>, n: Vec3<L>, light: U<L>) -> F<L> {
        match &self.linked {
            None => self.pmf_among_all(l, light_cache, 0, p, n, light),
            Some(linked) => self.pmf_linked(l, linked, light_cache, receiver, &p, &n, light),
        }
    }

    /// The same for those who see only some lights, class by class.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "links, and a point of a class")]
    fn pmf_linked<L: Lanes>(
        &self,
        l: L,
        linked: &LinkedLights,
        light_cache: Option<&LightCache>,
        receiver: U<L>,
        p: &Vec3<L>,
        n: &Vec3<L>,
        light: U<L>,
    ) -> F<L> {
        l.vectorize(
            #[inline(always)]
            || {
                let only = l.gather_integers(&linked.only, receiver);
                let mut left = only.eq(SEVERAL);
                let mut probability = l.f(1.0).keep_if(only.eq(light).and_not(left));
                while left.any() {
                    let class = receiver.to_array()[left.bits().trailing_zeros() as usize];
                    let same = left & receiver.eq(class);
                    let share = match (linked.classes.get(class as usize), light_cache) {
                        (None, _) => l.f(0.0),
                        (Some(ClassSampler::Few(lights)), _) => self.pmf_among_few(l, lights, *p, *n, light),
                        (Some(ClassSampler::Tree(tree)), Some(cache)) => cache.probability(l, tree, &self.rows, class, *p, *n, light),
                        (Some(ClassSampler::Tree(tree)), None) => tree.probability(l, &self.rows, *p, *n, light),
                        (Some(ClassSampler::All), _) => self.pmf_among_all(l, light_cache, class, *p, *n, light),
                    };
                    probability = same.select(share, probability);
                    left = left.and_not(same);
                }
                probability.keep_if(linked.links.sees(l, receiver, light))
            },
        )
    }

    /// [`Self::sample_few`]'s probability of a light of the list.
    #[inline(always)]
    fn pmf_among_few<L: Lanes>(&self, l: L, lights: &[u32], p: Vec3<L>, n: Vec3<L>, light: U<L>) -> F<L> {
        let mut total = l.f(0.0);
        for light in lights {
            total += LightBounds::splat(l, &self.rows[*light as usize * ROW..][..ROW]).importance(l, p, n);
        }
        LightBounds::gather(&Reader::new(l, &self.rows, light)).importance(l, p, n).share_of(total)
    }

    /// [`Self::sample_all`]'s probability of a light.
    #[inline(always)]
    fn pmf_among_all<L: Lanes>(&self, l: L, light_cache: Option<&LightCache>, class: u32, p: Vec3<L>, n: Vec3<L>, light: U<L>) -> F<L> {
        match (&self.sampler, light_cache) {
            (LightSampler::Tree(tree), Some(light_cache)) => light_cache.probability(l, tree, &self.rows, class, p, n, light),
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
