//! Shadow catchers. A path whose camera ray meets one splits: one half goes through the scene as it is, the other through a scene of catchers
//! alone. The film compares what both bring. Both use the same random numbers, so that they differ by what the objects do and by little else.
//!
//! From there on slots tell the halves apart: slots of pixels come first, then measured points, then either half.

use crate::accumulate::add::{add, add_rgb};
use crate::accumulate::tile_sums::TileSums;
use crate::kernels;
use crate::state::chunk::ChunkContext;
use crate::state::path_core::PathCore;
use crate::state::paths::Paths;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::vertex::Vertex;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::{flag, ray_mask};
use gonio_accel::{Hits, NONE};
use gonio_camera::sampler::{BATCH, pixel};
use gonio_light::EscapedRay;
use gonio_simd::{Lanes, M, One, U};

/// First slot of the halves that see all of the scene.
const WITH_OBJECTS: u32 = 2 * BATCH as u32;
/// First slot of the halves that see catchers alone.
const CATCHERS_ONLY: u32 = 3 * BATCH as u32;

/// Splits the paths whose camera rays met a catcher. What dims the way to it belongs to the objects: the half among catchers alone comes to it as
/// it left the camera, and is in what fills all of space alone.
pub(crate) fn fork(tables: &Tables, transport: &Transport, paths: &mut Paths, hits: &mut Hits) {
    let geometry = &tables.geometry;
    if geometry.set_catcher.is_empty() {
        return;
    }
    let world = PathCore::of_world(One, tables, One.u(0), One.u(0)).media;
    for path in 0..paths.count {
        let instance = hits.instance[path];
        if instance == NONE || paths.flags(path) & flag::CAMERA == 0 {
            continue;
        }
        if geometry.set_catcher[geometry.instances[instance as usize].set as usize] != 0 {
            let twin = paths.count;
            paths.copy(path, twin);
            hits.repeat(path);
            *paths.slot_mut(path) += WITH_OBJECTS;
            *paths.slot_mut(twin) += CATCHERS_ONLY;
            paths.media.store(world, twin);
            paths.carried.set([transport.squared_index; 3], twin);
            paths.count += 1;
        }
    }
}

/// Makes one of the halves that went straight through a catcher which is not there.
pub(crate) fn join(tables: &Tables, paths: &mut Paths) {
    if tables.geometry.set_catcher.is_empty() {
        return;
    }
    let mut kept = 0;
    for path in 0..paths.count {
        let halved = paths.flags(path) & flag::CAMERA != 0 && paths.slot(path) >= WITH_OBJECTS;
        if halved && paths.slot(path) >= CATCHERS_ONLY {
            continue;
        }
        paths.copy(path, kept);
        if halved {
            *paths.slot_mut(kept) -= WITH_OBJECTS;
        }
        kept += 1;
    }
    paths.count = kept;
}

/// Lets rays of paths among catchers alone see those alone.
pub(crate) fn set_masks(tables: &Tables, paths: &mut Paths) {
    if !tables.geometry.set_catcher.is_empty() {
        for path in 0..paths.count {
            if paths.slot(path) >= CATCHERS_ONLY {
                paths.rays.mask[path] = ray_mask::CATCHER_SCATTERED;
            }
        }
    }
}

/// The same for shadow rays.
pub(crate) fn set_shadow_masks(tables: &Tables, shadows: &mut ShadowRays) {
    if !tables.geometry.set_catcher.is_empty() {
        let mask = |slot: u32| if slot >= CATCHERS_ONLY { ray_mask::CATCHER_SHADOW } else { ray_mask::SHADOW };
        shadows.rays.mask.iter_mut().zip(&shadows.slot[..shadows.count]).for_each(|(place, slot)| *place = mask(*slot));
    }
}

/// Whether paths may sample a light: among catchers alone, lights on objects are absent.
#[inline(always)]
pub(crate) fn may_sample<L: Lanes>(l: L, tables: &Tables, slot: U<L>, light: U<L>) -> M<L> {
    if tables.object_lights.is_empty() {
        return l.m(true);
    }
    slot.lt(CATCHERS_ONLY) | l.gather_integers(&tables.object_lights, light).eq(0)
}

/// Whether halves among catchers alone arrive at the catcher that split them.
#[inline(always)]
pub(crate) fn arrives_alone<L: Lanes>(flags: U<L>, slot: U<L>) -> M<L> {
    (flags & flag::CAMERA).ne(0) & !slot.lt(CATCHERS_ONLY)
}

/// Keeps what is behind catchers that the camera sees: the environment alone, as if no object were there. From here on the halves are no
/// camera paths any more.
#[inline(always)]
pub(crate) fn add_behind<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &mut Vertex<L>, present: M<L>, sums: &mut TileSums) {
    let ChunkContext { l, tables, transport, .. } = *chunk;
    let halved = (point.core.flags & flag::CAMERA).ne(0) & !point.core.slot.lt(WITH_OBJECTS);
    let caught = present & arrives_alone(point.core.flags, point.core.slot);
    point.core.flags = halved.select(point.core.flags & !flag::CAMERA, point.core.flags);
    if !caught.any() {
        return;
    }
    let pixel = pixel(point.core.slot);
    if transport.environment_covers {
        add(&mut sums.alpha, pixel, point.share, caught);
    }
    let direction = -point.wo;
    let from = chunk.paths.previous(l, point.path);
    let Some((coverage, behind)) = &mut sums.catchers.sums else { return };
    if !transport.environment_covers {
        add(coverage, pixel, point.share, caught);
    }
    if transport.shows_environment {
        let ray = EscapedRay { direction, pdf: point.pdf, first: caught, delta: caught, kind: l.u(0) };
        let radiance = kernels::eval_escaped(l, tables, None, &from, &ray, None, chunk.sample.wavelengths(l, point.core.slot));
        let value = transport.limits.clamped(radiance * point.core.throughput, point.bounces);
        add_rgb(behind, pixel, chunk.sample.to_film(point.core.slot, value), caught & value.is_lit());
    }
}

/// Of hits that the camera sees, those that passes show: halves among catchers alone are there for comparison only.
#[inline(always)]
pub(crate) fn shown<L: Lanes>(slot: U<L>) -> M<L> {
    slot.lt(CATCHERS_ONLY)
}

/// Of hits that the camera sees, those that cover what is behind them.
#[inline(always)]
pub(crate) fn covers<L: Lanes>(slot: U<L>) -> M<L> {
    slot.lt(WITH_OBJECTS)
}
