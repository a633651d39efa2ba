//! Lights for the ways of rays through media: one is selected for a whole way, with the part of it that the light can reach.
//!
//! A light's importance is about what it brings to all of the way: its illuminance integrated in closed form. Estevez and Kulla, Importance Sampling of
//! Many Lights with Adaptive Tree Splitting (2018), section 5.3.

use super::light_bounds::LightBounds;
use super::row::{ROW, Reader};
use super::table::{LightSampler, LightTable, MOST_EXHAUSTIVE};
use super::way::LightWay;
use gonio_simd::{F, Lanes, U, Vec3};

/// A light that was selected for a way.
#[derive(Clone, Copy, Debug)]
pub struct LightAlong<L: Lanes> {
    /// Its number, and the probability with which it was selected.
    pub light: (U<L>, F<L>),
    /// The middle of what it is, far away for lights at infinity.
    pub centre: Vec3<L>,
    /// Metres along the way between which light may arrive; the second is the smaller where none does.
    pub reached: [F<L>; 2],
}

impl LightTable {
    /// Selects a light for each way, whatever receivers see.
    #[inline(always)]
    pub fn sample_along<L: Lanes>(&self, l: L, way: &LightWay<L>, u: F<L>) -> LightAlong<L> {
        let light = match &self.sampler {
            LightSampler::Exhaustive => self.exhaustive_along(l, way, u),
            LightSampler::Tree(tree) => tree.sample_along(l, &self.rows, way, u),
        };
        let bounds = LightBounds::gather(&Reader::new(l, &self.rows, light.0));
        let (centre, reached) = bounds.reached(l, way);
        LightAlong { light, centre, reached }
    }

    #[inline(always)]
    fn exhaustive_along<L: Lanes>(&self, l: L, way: &LightWay<L>, u: F<L>) -> (U<L>, F<L>) {
        let mut importances = [l.f(0.0); MOST_EXHAUSTIVE];
        let mut total = l.f(0.0);
        for (row, importance) in self.rows.chunks_exact(ROW).zip(&mut importances) {
            *importance = LightBounds::splat(l, row).importance_along(l, way);
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
}
