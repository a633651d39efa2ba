//! Guides of denoisers: albedo and normal of the first surface that is not specular, seen in mirrors and through smooth glass.
//!
//! With them goes the light on specular paths. Camera rays of their own find both (`schedule/guides.rs`), more than samples where these are
//! few. They follow all specular ways and end where light would have to be sampled. So they cost little and have hardly any noise.
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

/// Adds albedo and normal of the first surfaces that are not specular, times the throughput of the specular path to them.
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

/// Keeps the light that arrives on specular paths apart, and returns the lanes whose light counts under the path filter.
#[inline(always)]
pub(crate) fn see<L: Lanes>(transport: &Transport, flags: U<L>, slot: U<L>, value: Rgb<L>, arrives: M<L>, ws: &mut Workspace) -> M<L> {
    if !transport.passes.guides {
        return arrives;
    }
    let sharp = arrives & is_specular_path(flags, slot);
    // Light on the specular paths of samples is noisy, that of trees of rays is not.
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
