//! The first stage: a camera ray for every pixel of a tile.

use super::{
    runs::Runs,
    state::{PathLanes, Paths, flag},
};
use crate::{
    camera::CameraTable,
    film::FilterTable,
    sampler::{Sampler, dimension},
};
use gonio_simd::{F, Lanes, Rgb, U, Vec3};

/// The rectangle of pixels that one batch covers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileArea {
    /// First column and row in the image.
    pub(crate) min: [u32; 2],
    /// Behind the last column and row, at most [`super::TILE`] further.
    pub(crate) max: [u32; 2],
}

/// Starts a path through every pixel of a tile that a batch holds; four by four pixels follow one another, so that sixteen rays make a packet.
#[inline(always)]
pub(crate) fn generate<L: Lanes>(
    l: L,
    camera: &CameraTable,
    filter: &FilterTable,
    sampler: &Sampler,
    area: TileArea,
    runs: &Runs,
    paths: &mut Paths,
) {
    paths.count = 0;
    for [slot, code, sample] in runs.registers(L::COUNT) {
        let pixel = l.iota() + code;
        let (x, y) = (morton_even(pixel), morton_even(pixel >> 1));
        let inside = (x + area.min[0]).lt(area.max[0]) & (y + area.min[1]).lt(area.max[1]);
        if !inside.any() {
            continue;
        }
        let index = sampler.index(pixel, l.u(sample));
        let [u, v] = sampler.pair(l, index, dimension::PIXEL);
        let lens = if camera.lens_radius > 0.0 { sampler.pair(l, index, dimension::LENS) } else { [l.f(0.5); 2] };
        let raster = [
            (x + area.min[0]).to_float() + 0.5 + filter_offset(l, filter, u),
            (y + area.min[1]).to_float() + 0.5 + filter_offset(l, filter, v),
        ];
        let ray = camera.ray(l, raster, lens);
        let state = PathLanes {
            origin: ray.origin,
            direction: ray.direction,
            t_min: ray.t_min,
            t_max: ray.t_max,
            vertex: ray.origin,
            normal: ray.direction,
            throughput: Rgb::grey(l.f(1.0)),
            pdf: l.f(1.0),
            width: ray.width,
            spread: ray.spread,
            slot: l.iota() + slot,
            flags: l.u(flag::CAMERA | flag::DELTA),
            counts: l.u(0),
            medium: Rgb::zero(l),
        };
        paths.append(&state, inside & ray.mapped);
    }
    paths.set_masks();
}

/// Where in the pixel a sample lies: the filter's tabulated inverse.
#[inline(always)]
fn filter_offset<L: Lanes>(l: L, filter: &FilterTable, u: F<L>) -> F<L> {
    let knots = (filter.inverse.len() - 1) as f32;
    let place = u * knots;
    let floor = place.floor();
    let [low, high] = l.gather_pairs(&filter.inverse, floor.to_i32());
    low.lerp(high, place - floor)
}

/// The even bits of a Morton number, packed: its column.
#[inline(always)]
pub(super) fn morton_even<L: Lanes>(code: U<L>) -> U<L> {
    let x = code & 0x5555_5555;
    let x = (x | (x >> 1)) & 0x3333_3333;
    let x = (x | (x >> 2)) & 0x0f0f_0f0f;
    (x | (x >> 4)) & 0x00ff_00ff
}

/// The Morton number of a tile's pixel.
#[inline]
pub(crate) fn tile_code([x, y]: [usize; 2]) -> usize {
    let spread = |mut x: usize| {
        x = (x | (x << 4)) & 0x0f0f;
        x = (x | (x << 2)) & 0x3333;
        (x | (x << 1)) & 0x5555
    };
    spread(x) | spread(y) << 1
}

/// A direction of the cosine distribution about +z (Malley's method).
#[inline(always)]
pub(super) fn cosine_hemisphere<L: Lanes>(u: [F<L>; 2]) -> Vec3<L> {
    let [x, y] = crate::camera::concentric_disk(u);
    let z = (x.lanes().f(1.0) - x * x - y * y).safe_sqrt();
    Vec3::new(x, y, z)
}
