//! Lights by fixed samples.

use crate::tables::Tables;
use gonio_light::{FixedLightSample, LightSample};
use gonio_simd::{Lanes, U, Vec3};

/// [`gonio_light::LightTable::sample_fixed`].
#[inline(never)]
pub(crate) fn sample_fixed<L: Lanes>(
    l: L,
    tables: &Tables,
    fixed: &FixedLightSample,
    receiver: U<L>,
    p: &Vec3<L>,
    n: &Vec3<L>,
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_fixed(l, fixed, receiver, p, n),
    )
}
