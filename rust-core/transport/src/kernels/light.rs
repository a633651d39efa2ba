//! Lights chosen and sampled at random.

use crate::tables::Tables;
use gonio_light::{LightCache, LightSample};
use gonio_simd::{F, Lanes, U, Vec3};

/// [`gonio_light::LightTable::sample_li`].
#[inline(never)]
pub fn sample_li<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    receiver: U<L>,
    p: &Vec3<L>,
    n: &Vec3<L>,
    u: &[F<L>; 3],
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_li(l, light_cache, receiver, p, n, u[0], &[u[1], u[2]]),
    )
}
