//! Lights chosen and sampled at random.

use crate::tables::Tables;
use gonio_light::{LightAlong, LightCache, LightSample, LightSampleContext, LightWay};
use gonio_simd::{F, Lanes, U};

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

/// [`gonio_light::LightTable::sample_along`].
#[inline(never)]
pub(crate) fn sample_along<L: Lanes>(l: L, tables: &Tables, way: &LightWay<L>, u: F<L>) -> LightAlong<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_along(l, way, u),
    )
}

/// [`gonio_light::LightTable::sample_li_of`].
#[inline(never)]
pub(crate) fn sample_li_of<L: Lanes>(
    l: L,
    tables: &Tables,
    chosen: (U<L>, F<L>),
    from: &LightSampleContext<L>,
    u: &[F<L>; 2],
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_li_of(l, chosen, from, u),
    )
}

/// [`gonio_light::LightTable::light_pmf`].
#[inline(never)]
pub(crate) fn light_pmf<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    from: &LightSampleContext<L>,
    light: U<L>,
) -> F<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.light_pmf(l, light_cache, from, light),
    )
}
