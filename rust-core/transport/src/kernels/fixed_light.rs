//! Lights by fixed samples.

use crate::tables::Tables;
use gonio_light::{FixedLightSample, LightSample, LightSampleContext};
use gonio_simd::Lanes;

/// [`gonio_light::LightTable::sample_fixed`].
#[inline(never)]
pub(crate) fn sample_fixed<L: Lanes>(l: L, tables: &Tables, fixed: &FixedLightSample, from: &LightSampleContext<L>) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_fixed(l, fixed, from),
    )
}
