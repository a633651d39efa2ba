//! BSDFs: sampled, evaluated, and by flux.

use gonio_bsdf::{BsdfSample, LightHits, Lobes, ParameterValues, SpecularRay, Surface, Way};
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// [`Surface::transmittance`].
#[inline(never)]
pub(crate) fn transmittance<L: Lanes>(
    l: L,
    surface: &Surface,
    values: &ParameterValues<'_>,
    at: usize,
    wo: Vec3<L>,
    entering: M<L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.transmittance(l, values, at, wo, entering),
    )
}

/// [`Surface::emitted`].
#[inline(never)]
pub(crate) fn emitted<L: Lanes>(
    l: L,
    surface: &Surface,
    values: &ParameterValues<'_>,
    at: usize,
    wo: Vec3<L>,
    entering: M<L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.emitted(l, values, at, wo, entering),
    )
}

/// [`Lobes::eval_diffuse`].
#[inline(never)]
pub(crate) fn eval_diffuse<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.eval_diffuse(l, wo, wi),
    )
}

/// [`Lobes::eval`] without the density.
#[inline(never)]
pub(crate) fn eval<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.eval(l, wo, wi).0,
    )
}

/// [`Lobes::sample`].
#[inline(never)]
pub fn sample<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, u: [F<L>; 3]) -> BsdfSample<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.sample(l, wo, u),
    )
}

/// [`Lobes::sample_or_follow`].
#[inline(never)]
pub(crate) fn sample_or_follow<L: Lanes>(
    l: L,
    lobes: &Lobes<'_, L>,
    wo: Vec3<L>,
    u: [F<L>; 3],
    wi: Vec3<L>,
    follows: M<L>,
) -> BsdfSample<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.sample_or_follow(l, wo, u, wi, follows),
    )
}

/// [`Surface::flux`].
#[inline(never)]
pub(crate) fn flux<'s, L: Lanes>(
    l: L,
    surface: &'s Surface,
    light: &LightHits<'s, L>,
    lobes: &Lobes<'s, L>,
    to: Vec3<L>,
    room: &mut Lobes<'s, L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.flux(l, light, lobes, to, room),
    )
}

/// [`Surface::flux_diffuse`].
#[inline(never)]
pub(crate) fn flux_diffuse<L: Lanes>(l: L, light: &LightHits<'_, L>, room: &Lobes<'_, L>, to: Vec3<L>) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || Surface::flux_diffuse(l, light, room, to),
    )
}

/// [`Surface::flux_factor`].
#[inline(never)]
pub(crate) fn flux_factor<'s, L: Lanes>(
    l: L,
    surface: &'s Surface,
    light: &LightHits<'s, L>,
    lobes: &Lobes<'s, L>,
    sample: &BsdfSample<L>,
    room: &mut Lobes<'s, L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.flux_factor(l, light, lobes, sample, room),
    )
}

/// [`Lobes::specular_rays`].
#[inline(never)]
pub(crate) fn specular_rays<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>) -> [SpecularRay<L>; Way::ALL.len()] {
    l.vectorize(
        #[inline(always)]
        || lobes.specular_rays(l, wo),
    )
}
