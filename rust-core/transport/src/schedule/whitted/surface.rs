//! Whitted shading: every point takes all fixed light samples, and sends rays on all specular ways.

use crate::accumulate::deposit::Deposits;
use crate::kernels;
use crate::stage::light::measure::{self, MeasureContext};
use crate::stage::light::nee::queue_shadow_ray;
use crate::stage::shade::integrator::Integrator;
use crate::stage::shade::portal::pass_on;
use crate::stage::shade::shading::{add_seen, guide_and_measure};
use crate::stage::shade::straight::straight_on;
use crate::state::chunk::ChunkContext;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::queue::Queues;
use crate::state::queue::branches::Branches;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::vertex::Vertex;
use crate::tables::expressions::scattering;
use crate::tables::material::{SurfaceMaterial, threshold};
use crate::tables::transport::PathFilter;
use crate::words::{counts, event, flag};
use gonio_bsdf::{Lobes, Way};
use gonio_light::{FixedLightSample, SampleWeight};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// Rays with less throughput than this end: half an 8-bit step of white at most.
const LEAST_THROUGHPUT: f32 = 1.0 / 512.0;
/// Below this throughput Russian roulette decides, where rays guide denoisers.
const ROULETTE_BELOW: f32 = 1.0 / 16.0;

/// A ray that leaves a point.
struct Branch<L: Lanes> {
    way: Way,
    wi: Vec3<L>,
    throughput: Spectrum<L>,
    /// Share of a camera ray's sample that it stands for, while the camera sees what it meets.
    share: F<L>,
}

/// These light samples at every point, and all specular ways on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WhittedIntegrator<'a> {
    pub(crate) samples: &'a [FixedLightSample],
}

impl Integrator for WhittedIntegrator<'_> {
    const WALKS: bool = false;

    fn shadow_rays_per_hit(&self) -> usize {
        self.samples.len().max(1)
    }

    #[inline(always)]
    fn shade<L: Lanes>(
        &self,
        chunk: &ChunkContext<'_, L>,
        material: &SurfaceMaterial,
        point: &mut Vertex<L>,
        lobes: &Lobes<'_, L>,
        at: usize,
        queues: &mut Queues,
        deposits: &mut Deposits,
    ) {
        let ChunkContext { l, transport, .. } = *chunk;
        let branches = &mut queues.branches;
        let mut straight = Branch { way: Way::Straight, wi: -point.wo, throughput: Spectrum::zero(l), share: l.f(0.0) };
        let mut present = point.alive;
        if material.surface.lobes.has_gaps() {
            present &= part_from_open(material, point, lobes, &mut straight);
        }
        let present = add_seen(chunk, material, point, lobes, (present, false), at, deposits);
        if let Some(portal) = lobes.portal() {
            pass_on(chunk, point, portal, point.share, present, &mut branches.ways[Way::Straight as usize]);
            return;
        }
        let [non_specular, lit] = guide_and_measure(chunk, point, lobes, present, &mut queues.measure, deposits);
        if (non_specular & lit).any() {
            light_by_fixed_samples(chunk, point, lobes, self.samples, lit & non_specular, &mut queues.shadows, deposits);
        }
        let present = if transport.path_filter == PathFilter::SpecularOnly { present & point.all_delta } else { present };
        for (way, ray) in Way::ALL.into_iter().zip(&kernels::specular_rays(l, lobes, point.local_wo)) {
            let throughput = (point.core.throughput * ray.weight).keep_if(present);
            if way == Way::Straight {
                straight.throughput += throughput;
                // A pane has been seen itself.
                straight.share += if material.surface.lobes.straight { point.share.keep_if(present) } else { l.f(0.0) };
            } else {
                let going_on = point.bounces.lt(transport.limits.max_bounces) & transport.limits.allow(point.core.counts, point.bounces);
                let wi = point.at.frame.to_world(ray.wi).normalize();
                branch(chunk, point, &Branch { way, wi, throughput, share: l.f(0.0) }, going_on, branches);
            }
        }
        branch(chunk, point, &straight, chunk.allows_straight(point.core.counts), branches);
    }

    #[inline(always)]
    fn measure<L: Lanes>(&self, chunk: &MeasureContext<'_, L>, shadows: &mut ShadowRays, _: &mut Paths, deposits: &mut Deposits) {
        measure::light_by_fixed_samples(chunk, self.samples, shadows, deposits);
    }
}

/// Splits throughput and share by opacity between the surface and the ray straight on; returns where there is a surface.
#[inline(always)]
fn part_from_open<L: Lanes>(material: &SurfaceMaterial, point: &mut Vertex<L>, lobes: &Lobes<'_, L>, open: &mut Branch<L>) -> M<L> {
    let opacity = threshold(lobes.opacity(), material.opacity_threshold).saturate();
    open.throughput = (point.core.throughput * (1.0 - opacity)).keep_if(point.alive);
    open.share = point.share * (1.0 - opacity);
    point.core.throughput = point.core.throughput * opacity;
    point.share *= opacity;
    opacity.gt(0.0)
}

/// Takes every fixed sample at each point.
#[inline(always)]
fn light_by_fixed_samples<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    samples: &[FixedLightSample],
    lit: M<L>,
    shadows: &mut ShadowRays,
    deposits: &mut Deposits,
) {
    let ChunkContext { l, tables, .. } = *chunk;
    let (mut reached, mut before) = (lit, None);
    for fixed in samples {
        if !fixed.follows(before) {
            reached = lit & tables.lights.reaches(l, fixed, &point.at.light_context());
        }
        before = Some(fixed);
        if reached.any() {
            let sample = kernels::sample_fixed(l, tables, fixed, &point.at.light_context());
            queue_shadow_ray(chunk, point, lobes, (&sample, SampleWeight::Fixed(fixed.share)), reached, shadows, deposits);
        }
    }
}

/// Appends the rays of a way that are worth following.
#[inline(always)]
fn branch<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, ray: &Branch<L>, goes: M<L>, branches: &mut Branches) {
    let Branch { way, wi, throughput, share } = *ray;
    let (throughput, worth) = worth(chunk, point, way, throughput);
    // A direction on the other side of the triangle than of the shading normal would leak light.
    let across = point.at.geometric.dot(wi).lt(0.0);
    let consistent = match way {
        Way::Mirrored | Way::Coat => !across,
        // As in `stage/shade/scatter.rs`.
        Way::Refracted => chunk.l.m(true),
        Way::Straight => across,
    };
    let alive = goes & consistent & worth;
    if !alive.any() {
        return;
    }
    let counted = match way {
        Way::Mirrored | Way::Coat => counts::GLOSSY,
        Way::Refracted => counts::TRANSMISSION,
        Way::Straight => chunk.straight,
    };
    let (ray, width, passed) = if way == Way::Straight {
        let on = straight_on(chunk, point);
        (on.ray, on.width, Some(on.passed))
    } else {
        (point.at.spawn_ray(wi), point.core.width, None)
    };
    let straight = chunk.l.m(way == Way::Straight);
    let media = point.media_towards(across, straight);
    let core = PathCore { throughput, width, flags: flags(chunk, point, way), counts: point.core.counts + counted, media, ..point.core };
    let path = match way {
        // What it finds is still seen from the vertex before.
        Way::Straight => PathLanes::start(ray, core).leaving(chunk.paths.previous(chunk.l, point.path), share),
        _ => point.go_on(ray, share, core),
    };
    branches.ways[way as usize].append(&path.having_passed(passed), alive);
}

/// Which rays are followed, and with which throughput. For guides of denoisers Russian roulette decides: a lamp on a faint specular path may
/// be bright. Other trees drop faint rays.
#[inline(always)]
fn worth<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, way: Way, throughput: Spectrum<L>) -> (Spectrum<L>, M<L>) {
    let ChunkContext { l, transport, sample: context, .. } = *chunk;
    let brightest = throughput.max_component();
    let usable = brightest.gt(0.0) & brightest.is_finite();
    if transport.path_filter != PathFilter::SpecularOnly {
        return (throughput, usable & brightest.ge(LEAST_THROUGHPUT));
    }
    let dimension = context.dimension(way as u32);
    let [chance, _] = context.sampler.pair(l, context.index(l, point.core.slot), dimension);
    let survival = (brightest * ROULETTE_BELOW.recip()).min(1.0);
    (throughput * survival.max(f32::MIN_POSITIVE).recip(), usable & chance.lt(survival))
}

/// The path flags of a ray that went this way.
#[inline(always)]
fn flags<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, way: Way) -> U<L> {
    let ChunkContext { l, transport, .. } = *chunk;
    let all_delta = if transport.path_filter == PathFilter::SpecularOnly { l.m(true) } else { point.all_delta };
    let non_specular = all_delta.select(l.u(0), l.u(flag::NON_SPECULAR_SEEN));
    let kind = match way {
        Way::Mirrored | Way::Coat => event::GLOSSY,
        Way::Refracted => event::TRANSMISSION,
        Way::Straight => return point.core.flags | non_specular,
    };
    let before = (point.core.flags & flag::NON_SPECULAR_SEEN) | non_specular;
    let state = match &transport.passes.expressions {
        Some(expressions) => {
            let through = if way == Way::Refracted { scattering::THROUGH } else { 0 };
            expressions.step(point.core.flags, l.u(scattering::SHARP + through))
        }
        None => l.u(0),
    };
    before | state | flag::DELTA | flag::scattered(point.core.flags, l.u(kind))
}
