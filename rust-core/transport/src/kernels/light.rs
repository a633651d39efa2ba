//! Lights chosen and sampled at random.

use crate::tables::Tables;
use gonio_light::{LightCache, LightSample, LightSampleContext};
use gonio_simd::{F, Lanes};

/// [`gonio_light::LightTable::sample_li`].
#[inline(never)]
pub fn sample_li<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    from: &LightSampleContext<L>,
    u: &[F<L>; 3],
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_li(l, light_cache, from, u[0], &[u[1], u[2]]),
    )
}
