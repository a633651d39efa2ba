//! Ray generation: a camera ray with its ray cone, the start of a path, for every slot of a batch.

use crate::geometry::NONE;
use crate::state::passed::PassedLanes;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::rays::RayLanes;
use gonio_camera::Placement;
use gonio_camera::sampler::Runs;
use gonio_camera::sampler::morton_even;
use gonio_camera::sampler::{Sampler, dimension};
use gonio_camera::{CameraRay, CameraTable};
use gonio_simd::{Lanes, PADDING, WavelengthColumn, Wavelengths};

/// The rectangle of pixels that one batch covers.
#[derive(Clone, Copy, Debug)]
pub struct TileArea {
    /// First column and row in the image.
    pub min: [u32; 2],
    /// Behind the last column and row, at most [`gonio_camera::sampler::TILE`] further.
    pub max: [u32; 2],
}

/// Starts a path through every pixel of a tile that a batch holds; four by four pixels follow one another, so that sixteen rays make a packet.
///
/// `times` are those of the slots, empty where nothing moves.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a view's camera, the batch and where its paths go")]
pub fn generate<L: Lanes>(
    l: L,
    camera: &CameraTable,
    placement: &Placement,
    sampler: &Sampler,
    area: TileArea,
    runs: &Runs,
    times: &[f32],
    wavelengths: WavelengthColumn<'_>,
    paths: &mut Paths,
) {
    paths.clear();
    for [slot, first_pixel, sample] in runs.registers(L::COUNT) {
        let pixel = l.iota() + first_pixel;
        let (x, y) = (morton_even(pixel), morton_even(pixel >> 1));
        let inside = (x + area.min[0]).lt(area.max[0]) & (y + area.min[1]).lt(area.max[1]);
        if !inside.any() {
            continue;
        }
        let index = sampler.index(pixel, l.u(sample));
        let lens = if camera.lens_radius > 0.0 { sampler.pair(l, index, dimension::LENS) } else { [l.f(0.5); 2] };
        let [u, v] = match placement {
            Placement::Filter(filter) => {
                let u = sampler.pair(l, index, dimension::PIXEL);
                [filter.offset(l, u[0]), filter.offset(l, u[1])]
            }
            Placement::Grid(side) => {
                let step = |i: u32| l.f((i as f32 + 0.5) / *side as f32 - 0.5);
                [step(sample % side), step(sample / side)]
            }
        };
        let raster = [(x + area.min[0]).to_float() + 0.5 + u, (y + area.min[1]).to_float() + 0.5 + v];
        let ray = if times.is_empty() { camera.ray(l, raster, lens) } else { camera.ray_at(l, raster, lens, l.load(times, slot as usize)) };
        let core = PathCore::of_camera(l, wavelengths.load(l, slot as usize), l.iota() + slot, &camera.surroundings);
        paths.append(&started(&ray, core), inside & ray.mapped);
    }
    paths.set_masks();
}

/// Starts a path through the middle of the lens from each of some places of the raster; their slots are given.
#[inline(always)]
pub(crate) fn generate_at<L: Lanes>(l: L, camera: &CameraTable, places: [&[f32]; 2], slots: &[u32], paths: &mut Paths) {
    paths.clear();
    let (mut x, mut y, mut slot) = ([0.0; PADDING], [0.0; PADDING], [0; PADDING]);
    for first in (0..slots.len()).step_by(L::COUNT) {
        let end = (first + L::COUNT).min(slots.len());
        x[..end - first].copy_from_slice(&places[0][first..end]);
        y[..end - first].copy_from_slice(&places[1][first..end]);
        slot[..end - first].copy_from_slice(&slots[first..end]);
        let ray = camera.ray(l, [l.load(&x, 0), l.load(&y, 0)], [l.f(0.5); 2]);
        let core = PathCore::of_camera(l, Wavelengths::rgb(l), l.load_integers(&slot, 0), &camera.surroundings);
        paths.append(&started(&ray, core), l.first(end - first) & ray.mapped);
    }
    paths.set_masks();
}

/// The path of a camera ray. Of fog about the camera, too, what is nearer than its near limit is not seen.
#[inline(always)]
fn started<L: Lanes>(ray: &CameraRay<L>, core: PathCore<L>) -> PathLanes<L> {
    let core = PathCore { width: ray.width, spread: ray.spread, ..core };
    let l = ray.t_min.lanes();
    let near = || PassedLanes { t: ray.t_min, instance: l.u(NONE), primitive: l.u(NONE), barycentric: [l.f(0.0); 2] };
    let passed = core.media.is_filled().any().then(near);
    PathLanes::start(RayLanes { origin: ray.origin, direction: ray.direction, t_min: ray.t_min, t_max: ray.t_max }, core)
        .having_passed(passed)
}
