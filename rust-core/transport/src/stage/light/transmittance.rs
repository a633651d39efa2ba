//! Absorbing volumes: what fills closed meshes takes from light that goes through, straight light included (Beer and Lambert).
//!
//! Volumes that overlap add up. Paths carry the absorption of what they are in; shadow rays sum up optical depth by the surfaces they pass.

use crate::state::paths::Paths;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::state::vertex::Vertex;
use crate::tables::Tables;
use gonio_accel::TransparentHit;
use gonio_bsdf::parameter::spectrum;
use gonio_simd::{Column, F, Lanes, M, Rgb, Spectrum, U, Vec3};

/// Lights further away than this are infinitely far.
const FAR: f32 = 1e20;
/// What sums leave of media that a ray has left, as a part of them and a metre.
const RESIDUE: f32 = 1e-5;

/// Absorption behind a surface: that of the medium before it, more or less by what fills the mesh and by what the surface itself encloses.
#[inline(always)]
pub(crate) fn medium_behind<L: Lanes>(medium: Spectrum<L>, inside: Spectrum<L>, interior: Option<[f32; 3]>, entering: M<L>) -> Spectrum<L> {
    let own = match interior {
        Some(interior) => inside + absorption(medium.lanes(), interior),
        None => inside,
    };
    entering.select(medium + own, (medium - own - medium * RESIDUE).max(0.0))
}

/// Absorption in every lane.
#[inline(always)]
pub(crate) fn absorption<L: Lanes>(l: L, interior: [f32; 3]) -> Spectrum<L> {
    spectrum(Rgb::new(l.f(interior[0]), l.f(interior[1]), l.f(interior[2])))
}

/// What is left of light that paths have met at a distance, lights and the environment, by what they are in.
#[inline(always)]
pub(crate) fn transmittance<L: Lanes>(l: L, paths: &Paths, path: U<L>, distance: F<L>) -> Spectrum<L> {
    (paths.medium.gather(l, path) * -distance.min(FAR)).exp()
}

/// What a ray starts in that leaves a point in a direction.
#[inline(always)]
pub(crate) fn medium_towards<L: Lanes>(tables: &Tables, point: &Vertex<L>, direction: Vec3<L>) -> Option<Spectrum<L>> {
    let l = point.bounces.lanes();
    if tables.any_absorbing {
        Some(point.media_towards(point.at.geometric.dot(direction).lt(0.0), l.m(false), tables.any_volume))
    } else {
        None
    }
}

/// Begins the sums of all queued shadow rays with what they start in.
#[inline(always)]
pub(crate) fn begin_depths<L: Lanes>(l: L, shadows: &ShadowRays, trace: &mut ShadowTrace) {
    for at in (0..shadows.count).step_by(L::COUNT) {
        trace.depth.store(Spectrum::zero(l), at);
        trace.around.store(shadows.medium.load(l, at), at);
    }
}

/// Adds hits on the surface of what fills a mesh to the sums; `sides` are 1 where rays enter it, else -1.
#[inline(always)]
pub(crate) fn add_depths<L: Lanes>(l: L, interior: [f32; 3], hits: &[TransparentHit], sides: &Column, trace: &mut ShadowTrace) {
    trace.interior.store(absorption(l, interior), 0);
    for (hit, side) in hits.iter().zip(&sides[..]) {
        trace.depth.add(hit.ray as usize, &trace.interior, 0, -side * hit.t);
        trace.around.add(hit.ray as usize, &trace.interior, 0, *side);
    }
}

/// Dims what shadow rays carry by their optical depth.
#[inline(always)]
pub(crate) fn attenuate<L: Lanes>(l: L, shadows: &mut ShadowRays, trace: &ShadowTrace) {
    for at in (0..shadows.count).step_by(L::COUNT) {
        let end = l.load(&shadows.rays.t_max, at);
        let around = trace.around.load(l, at);
        // Rounding must not darken what comes from infinitely far away.
        let around = end.lt(FAR).select(around, around - Spectrum::constant(l.f(RESIDUE)));
        let depth = trace.depth.load(l, at) + around.max(0.0) * end.min(FAR);
        let dimmed = shadows.contribution.load(l, at) * (depth.max(0.0) * l.f(-1.0)).exp();
        shadows.contribution.store(dimmed, at);
    }
}
