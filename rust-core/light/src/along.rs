//! Lights for the ways of rays through media: one is selected for a whole way, with the part of it that the light can reach.
//!
//! A light's importance is about what it brings to all of the way: its illuminance integrated in closed form. Estevez and Kulla, Importance Sampling of
//! Many Lights with Adaptive Tree Splitting (2018), section 5.3.

use super::light_bounds::LightBounds;
use super::row::Reader;
use super::table::{LightSampler, LightTable};
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
            LightSampler::Exhaustive => self.sample_exhaustive(l, *way, u),
            LightSampler::Tree(tree) => tree.sample_light(l, &self.rows, *way, u),
        };
        let bounds = LightBounds::gather(&Reader::new(l, &self.rows, light.0));
        let (centre, reached) = bounds.reached(l, way);
        LightAlong { light, centre, reached }
    }
}
