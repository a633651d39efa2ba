//! Directions of the guiding field (path guiding): at vertices whose lobes reflect diffusely a part of the paths follow it.
//!
//! Both ways of sampling have one density, that of their mixture, for paths and for the MIS weights of light samples (one-sample balance
//! heuristic). Where the field must not send paths, only the BSDF's part of the density counts, so that nothing is lost.

use crate::kernels;
use crate::stage::shade::scatter::sampled;
use crate::state::chunk::ChunkContext;
use crate::state::vertex::Vertex;
use crate::tables::guiding::{Guided, GuidingField};
use gonio_bsdf::{BsdfSample, Lobes};
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};
use std::f32::consts::FRAC_1_PI;

/// What paths carry as it were without guiding, over what they carry: roulette goes by that.
#[inline(always)]
pub(crate) fn unguided<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>) -> F<L> {
    if chunk.transport.guiding.is_some() { chunk.paths.unguided(chunk.l, point.path) } else { point.core.unguided }
}

/// Looks up what the guiding field knows at chosen vertices: the more of the light diffuse lobes scatter, the more it is followed.
#[inline(always)]
pub(crate) fn look_up<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &mut Vertex<L>, lobes: &Lobes<'_, L>, chosen: M<L>) {
    let Some(field) = &chunk.transport.guiding else { return };
    if lobes.has_fibre() {
        return;
    }
    let mut guided = field.at(chunk.l, point.at.position, point.at.frame.z, chosen);
    guided.share *= lobes.diffuse_share(chunk.l);
    if guided.share.gt(0.0).any() {
        point.guided = Some(guided);
    }
}

/// Samples the BSDF, and the guiding field where it is followed; what that takes of the throughput is noted, for roulette.
#[inline(always)]
pub(crate) fn sampled_by_all<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &mut Vertex<L>,
    lobes: &Lobes<'_, L>,
    u: [F<L>; 3],
) -> (BsdfSample<L>, Spectrum<L>) {
    let (Some(field), Some(guided)) = (&chunk.transport.guiding, point.guided) else { return sampled(chunk, point, lobes, u) };
    let (sample, ratio) = sampled_by_guiding(chunk, point, lobes, (field, &guided), u);
    point.core.unguided *= ratio;
    let factor = sample.value * sample.pdf.recip();
    (sample, factor)
}

/// Samples the guiding field and the BSDF, each by its share; gives the density over that of the BSDF alone too.
#[inline(always)]
fn sampled_by_guiding<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    (field, guided): (&GuidingField, &Guided<L>),
    u: [F<L>; 3],
) -> (BsdfSample<L>, F<L>) {
    let l = chunk.l;
    let follows = u[0].lt(guided.share);
    let rest = l.f(1.0) - guided.share;
    let u_lobe = ((u[0] - guided.share) / rest).clamp(0.0, 0.999_999_94);
    let wi = point.at.frame.to_local(field.sample(l, guided, [u[1], u[2]]));
    let mut sample = kernels::sample_or_follow(l, lobes, point.local_wo, [u_lobe, u[1], u[2]], wi, follows);
    let direction = point.at.frame.to_world(sample.wi);
    let lost = follows.and_not(may_send(point, [direction, sample.wi]));
    sample.value = sample.value.keep_if(!lost);
    // Of which kind the scattering is: as often diffuse as where the lobes have chosen that direction.
    let diffuse = lobes.diffuse_share(l) * sample.wi.z * FRAC_1_PI;
    sample.diffuse |= follows & (u[0] * sample.pdf).lt(guided.share * diffuse);
    let alone = sample.delta | sample.entered;
    let density = density(chunk, point, (field, guided), [direction, sample.wi]);
    let pdf = alone.select(sample.pdf * rest, sample.pdf.mul_add(rest, density));
    let ratio = pdf / sample.pdf.max(f32::MIN_POSITIVE);
    sample.pdf = pdf;
    (sample, ratio)
}

/// Where paths go on that follow the field: above the triangle and above the shading normal's plane. `ways` are in world space and in the frame.
#[inline(always)]
fn may_send<L: Lanes>(point: &Vertex<L>, [direction, wi]: [Vec3<L>; 2]) -> M<L> {
    wi.z.gt(0.0) & point.at.geometric.dot(direction).gt(0.0)
}

#[inline(always)]
fn density<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    (field, guided): (&GuidingField, &Guided<L>),
    ways: [Vec3<L>; 2],
) -> F<L> {
    (field.pdf(chunk.l, guided, ways[0]) * guided.share).keep_if(may_send(point, ways))
}

/// The density of a direction with what the guiding field adds to that of the BSDF. `ways` are the direction in world space and in the frame.
#[inline(always)]
pub(crate) fn with_guiding<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, ways: [Vec3<L>; 2], pdf: F<L>) -> F<L> {
    match (&chunk.transport.guiding, &point.guided) {
        (Some(field), Some(guided)) => {
            let rest = chunk.l.f(1.0) - guided.share;
            pdf.mul_add(rest, density(chunk, point, (field, guided), ways))
        }
        _ => pdf,
    }
}
