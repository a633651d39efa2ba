//! Portals: paths go on from another place in another direction, and count as if they had gone straight through (Cycles' Ray Portal).
//!
//! No light can be sampled through a portal, so what a path finds behind it has its whole weight. Shadow rays end at portals.

use crate::state::chunk::ChunkContext;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::rays::RayLanes;
use crate::state::vertex::Vertex;
use crate::words::{counts, flag};
use gonio_bsdf::Portal;
use gonio_light::LightSampleContext;
use gonio_simd::{F, Lanes, M, Vec3};

/// The square of the distance in metres below which a place is that of the hit itself.
const SAME_PLACE: f32 = 1e-9;

/// Sends the paths of `goes` on; `share` is what they keep as pdf, of camera rays the share of the sample.
#[inline(always)]
pub(crate) fn pass_on<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    point: &Vertex<L>,
    portal: &Portal<L>,
    share: F<L>,
    goes: M<L>,
    next: &mut Paths,
) {
    let throughput = point.core.throughput * portal.colour;
    let open =
        goes & chunk.transport.limits.allow_straight(point.core.counts) & throughput.is_lit() & throughput.max_component().is_finite();
    if !open.any() {
        return;
    }
    let ray = ray(chunk, point, portal);
    let receiver = chunk.paths.previous(chunk.l, point.path).receiver;
    // Light paths find no way back through it.
    let flags = (point.core.flags & !flag::LEFT_TO_LIGHT_PATHS) | (flag::DELTA | flag::ROUGH);
    let core = PathCore { throughput, flags, counts: point.core.counts + counts::STRAIGHT, ..point.core };
    let from = LightSampleContext { position: ray.origin, normal: ray.direction, receiver };
    next.append(&PathLanes::start(ray, core).leaving(from, share), open);
}

/// The ray that leaves the portal; from the hit itself it starts off the surface.
#[inline(always)]
fn ray<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, portal: &Portal<L>) -> RayLanes<L> {
    let l = chunk.l;
    let direction = portal.direction.normalize_or(-point.wo);
    let mut ray = point.at.spawn_ray(direction);
    let position = portal.position - Vec3::splat(l, chunk.columns.surface.origin);
    let moved = (position - point.at.position).length_squared().gt(SAME_PLACE);
    ray.origin = moved.select(position, ray.origin);
    ray
}
