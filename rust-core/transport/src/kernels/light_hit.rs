//! Lights that rays have met.

use crate::state::paths::PreviousLanes;
use crate::tables::Tables;
use gonio_light::LightCache;
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// A point on a light that a ray hit, and the previous vertex, from which MIS asks for the pdf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightHit<L: Lanes> {
    pub(crate) light: U<L>,
    pub(crate) from: PreviousLanes<L>,
    pub(crate) direction: Vec3<L>,
    pub(crate) point: Vec3<L>,
}

/// [`gonio_light::LightTable::eval_hit`].
#[inline(never)]
pub(crate) fn eval_light<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    hit: &LightHit<L>,
    mask: M<L>,
) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || {
            let PreviousLanes { position, normal, receiver } = hit.from;
            tables.lights.eval_hit(l, light_cache, receiver, hit.light, position, normal, hit.direction, hit.point, mask)
        },
    )
}

/// [`gonio_light::LightTable::eval_escaped`].
#[inline(never)]
#[expect(clippy::too_many_arguments, reason = "a ray and how it came to be")]
pub(crate) fn eval_escaped<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    from: PreviousLanes<L>,
    direction: Vec3<L>,
    pdf: F<L>,
    first_and_delta: [M<L>; 2],
    only: Option<u32>,
    kind: U<L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || {
            let PreviousLanes { position, normal, receiver } = from;
            let [first, delta] = first_and_delta;
            tables.lights.eval_escaped(l, light_cache, receiver, position, normal, direction, pdf, first, delta, only, kind)
        },
    )
}
