//! Guides of denoisers: albedo and normal of the first surface that is not specular, seen in mirrors and through smooth glass.
//!
//! With them goes the light on specular paths. Camera rays of their own find both (`schedule/guides.rs`), more than samples where these are
//! few. They follow all specular ways and end where light would have to be sampled. So they cost little and have hardly any noise.
//!
//! Open Image Denoise, documentation of the RT filter: "Albedos" and "Normals" of perfect specular surfaces.

use crate::accumulate::add::add_rgb;
use crate::accumulate::tile_sums::TileSums;
use crate::state::chunk::ChunkContext;
use crate::state::vertex::Vertex;
use crate::tables::transport::PathFilter;
use crate::words::flag;
use gonio_bsdf::Lobes;
use gonio_camera::sampler::BATCH;
use gonio_simd::{Lanes, M, U};

/// Adds albedo and normal of the first surfaces that are not specular, times the throughput of the specular path to them.
#[inline(always)]
pub(crate) fn add_guides<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    lobes: &Lobes<'_, L>,
    present: M<L>,
    sums: &mut TileSums,
) {
    let transport = chunk.transport;
    if !transport.passes.guides || transport.path_filter == PathFilter::ExceptSpecular {
        return;
    }
    let seen = present.and_not(point.all_delta) & is_specular_path(point.core.flags, point.core.slot);
    if !seen.any() {
        return;
    }
    // Guides know nothing of what the camera stands in.
    let throughput = point.core.throughput * (1.0 / transport.squared_index);
    let [albedo, normal] = &mut sums.guides;
    add_rgb(albedo, point.core.slot, chunk.sample.to_film(point.core.slot, lobes.albedo() * throughput), seen);
    add_rgb(normal, point.core.slot, (point.at.frame.z * throughput.max_component()).into(), seen);
}

/// Whether a pixel's path has met nothing yet but mirrors and smooth glass.
#[inline(always)]
pub(crate) fn is_specular_path<L: Lanes>(flags: U<L>, slot: U<L>) -> M<L> {
    (flags & flag::NON_SPECULAR_SEEN).eq(0) & slot.lt(BATCH as u32)
}
