//! Light selection of receivers that see only some of the lights, class by class.

use super::context::LightSampleContext;
use super::light_bounds::LightBounds;
use super::links::{ClassSampler, LinkedLights, SEVERAL};
use super::row::ROW;
use super::table::{LightTable, MOST_EXHAUSTIVE};
use super::tree::LightCache;
use gonio_simd::{F, Lanes, U};

impl LightTable {
    /// Selects for each point among the lights that its class sees, class by class: a function of its own, so that scenes without links have no
    /// part of it.
    #[inline(never)]
    pub(super) fn sample_linked<L: Lanes>(
        &self,
        l: L,
        linked: &LinkedLights,
        light_cache: Option<&LightCache>,
        from: &LightSampleContext<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        l.vectorize(
            #[inline(always)]
            || {
                // Whoever has one light selects it.
                let receiver = from.receiver;
                let only = l.gather_integers(&linked.only, receiver);
                let mut left = only.eq(SEVERAL);
                let (mut light, mut probability) = (only.keep_if(!left), l.f(1.0).keep_if(!left));
                while left.any() {
                    let class = receiver.to_array()[left.bits().trailing_zeros() as usize];
                    let same = left & receiver.eq(class);
                    let (own, share) = self.sample_class(l, linked, light_cache, class, from, u);
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
    fn sample_class<L: Lanes>(
        &self,
        l: L,
        linked: &LinkedLights,
        light_cache: Option<&LightCache>,
        class: u32,
        from: &LightSampleContext<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        match linked.classes.get(class as usize) {
            None => (l.u(0), l.f(0.0)),
            Some(ClassSampler::Few(lights)) => self.sample_few(l, lights, from, u),
            Some(ClassSampler::Tree(tree)) => self.sample_tree(l, (tree, light_cache), class, from, u),
            Some(ClassSampler::All) => {
                let (light, probability) = self.sample_all(l, light_cache, class, from, u);
                (light, probability.keep_if(linked.links.sees(l, l.u(class), light)))
            }
        }
    }

    /// Selects one of a list of at most [`MOST_EXHAUSTIVE`] lights by the importances of them all.
    #[inline(always)]
    fn sample_few<L: Lanes>(&self, l: L, lights: &[u32], from: &LightSampleContext<L>, u: F<L>) -> (U<L>, F<L>) {
        let (p, n) = (from.position, from.normal);
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

    /// [`Self::sample_linked`]'s probability of a light.
    #[inline(never)]
    pub(super) fn pmf_linked<L: Lanes>(
        &self,
        l: L,
        linked: &LinkedLights,
        light_cache: Option<&LightCache>,
        from: &LightSampleContext<L>,
        light: U<L>,
    ) -> F<L> {
        l.vectorize(
            #[inline(always)]
            || {
                let receiver = from.receiver;
                let only = l.gather_integers(&linked.only, receiver);
                let mut left = only.eq(SEVERAL);
                let mut probability = l.f(1.0).keep_if(only.eq(light).and_not(left));
                while left.any() {
                    let class = receiver.to_array()[left.bits().trailing_zeros() as usize];
                    let same = left & receiver.eq(class);
                    let share = match linked.classes.get(class as usize) {
                        None => l.f(0.0),
                        Some(ClassSampler::Few(lights)) => self.pmf_among_few(l, lights, from, light),
                        Some(ClassSampler::Tree(tree)) => self.pmf_in_tree(l, (tree, light_cache), class, from, light),
                        Some(ClassSampler::All) => self.pmf_among_all(l, light_cache, class, from, light),
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
    fn pmf_among_few<L: Lanes>(&self, l: L, lights: &[u32], from: &LightSampleContext<L>, light: U<L>) -> F<L> {
        let mut total = l.f(0.0);
        for light in lights {
            total += LightBounds::splat(l, &self.rows[*light as usize * ROW..][..ROW]).importance(l, from.position, from.normal);
        }
        self.importance_of(l, from, light).share_of(total)
    }
}
