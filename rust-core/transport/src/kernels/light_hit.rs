//! Lights that rays have met.

use crate::tables::Tables;
use gonio_light::{EscapedRay, LightCache, LightSampleContext};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3, Wavelengths};

/// A point on a light that a ray hit, and the previous vertex, from which MIS asks for the pdf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightHit<L: Lanes> {
    pub(crate) light: U<L>,
    pub(crate) from: LightSampleContext<L>,
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
    wavelengths: Wavelengths<'_, L>,
) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || {
            let (sent, pdf) = tables.lights.eval_hit(l, light_cache, &hit.from, hit.light, [hit.direction, hit.point], mask);
            (tables.lights.light(wavelengths, hit.light.keep_if(mask), sent), pdf)
        },
    )
}

/// [`gonio_light::LightTable::eval_escaped`].
#[inline(never)]
pub(crate) fn eval_escaped<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    from: &LightSampleContext<L>,
    ray: &EscapedRay<L>,
    only: Option<u32>,
    wavelengths: Wavelengths<'_, L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.eval_escaped(l, light_cache, from, ray, only, wavelengths),
    )
}
