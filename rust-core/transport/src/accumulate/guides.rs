//! What tells denoisers noise from detail: albedo and normal of the first surface that is not a mirror or smooth glass, seen in mirrors
//! and through glass, and the light that the camera sees as sharply. Camera rays of their own find it, more than samples where these are
//! few: they end where light would have to be sampled, and are followed on all sharp ways, so that they cost little and agree.
//!
//! Open Image Denoise, documentation of the RT filter: "Albedos" and "Normals" of perfect specular surfaces.

use crate::accumulate::add::add_rgb;
use crate::state::flag;
use crate::state::vertex::{Stage, Vertex};
use crate::state::workspace::Workspace;
use crate::tables::transport::{PathFilter, Transport};
use gonio_bsdf::Lobes;
use gonio_camera::sampler::BATCH;
use gonio_simd::{Lanes, M, Rgb, U};

/// Adds what the paths of a pixel meet first that scatters more than sharply; colours of what is on the way count.
#[inline(always)]
pub(crate) fn record<L: Lanes>(stage: &Stage<'_, L>, point: &Vertex<L>, lobes: &Lobes<'_, L>, present: M<L>, ws: &mut Workspace) {
    if !stage.transport.passes.guides || stage.transport.path_filter == PathFilter::ExceptSpecular {
        return;
    }
    let seen = present.and_not(point.all_delta) & is_specular_path(point.flags, point.slot);
    if !seen.any() {
        return;
    }
    let [albedo, normal] = &mut ws.sums.guides;
    add_rgb(albedo, point.slot, lobes.albedo() * point.throughput, seen);
    add_rgb(normal, point.slot, (point.frame.z * point.throughput.max_component()).into(), seen);
}

/// Keeps what is seen sharply of the light that paths have met, and gives where it counts.
#[inline(always)]
pub(crate) fn see<L: Lanes>(transport: &Transport, flags: U<L>, slot: U<L>, value: Rgb<L>, arrives: M<L>, ws: &mut Workspace) -> M<L> {
    if !transport.passes.guides {
        return arrives;
    }
    let sharp = arrives & is_specular_path(flags, slot);
    // Of what samples find by themselves, trees of rays alone have no noise.
    if transport.fixed_samples.is_some() {
        add_rgb(&mut ws.sums.sharp, slot, value, sharp);
    }
    match transport.path_filter {
        PathFilter::All => arrives,
        PathFilter::SpecularOnly => sharp,
        PathFilter::ExceptSpecular => arrives.and_not(sharp),
    }
}

/// Whether a pixel's path has met nothing yet but mirrors and smooth glass.
#[inline(always)]
pub(crate) fn is_specular_path<L: Lanes>(flags: U<L>, slot: U<L>) -> M<L> {
    (flags & flag::NON_SPECULAR_SEEN).eq(0) & slot.lt(BATCH as u32)
}
