//! What tells denoisers noise from detail: albedo and normal of the first surface that is not a mirror or smooth glass, seen in mirrors and through
//! glass.
//!
//! Open Image Denoise, documentation of the RT filter: "Albedos" and "Normals" of perfect specular surfaces.

use super::{
    scatter::add_rgb,
    shade::{Point, Stage},
    state::{BATCH, Workspace, flag},
};
use crate::bsdf::Lobes;
use gonio_simd::{Lanes, M};

/// Adds what the paths of a pixel meet first that scatters more than sharply; colours of what is on the way count.
#[inline(always)]
pub(super) fn record<L: Lanes>(stage: &Stage<'_, L>, point: &Point<L>, lobes: &Lobes<'_, L>, present: M<L>, ws: &mut Workspace) {
    if !stage.transport.passes.guides {
        return;
    }
    let first = (point.flags & flag::MEASURED).eq(0) & point.slot.lt(BATCH as u32);
    let seen = present.and_not(point.only_delta) & first;
    if !seen.any() {
        return;
    }
    let [albedo, normal] = &mut ws.first_hit.guides;
    add_rgb(albedo, point.slot, lobes.albedo() * point.throughput, seen);
    add_rgb(normal, point.slot, (point.frame.z * point.throughput.max_component()).into(), seen);
}
