//! Where surfaces part within a pixel of the rasterised map.

use super::{
    raster::{Front, Grid},
    triangles::Triangles,
    view::TileView,
    visibility::{LEAST_COSINE, MOST_DEPTH},
};
use crate::{accel::NONE, camera::sampler::TILE};
use gonio_simd::{F, Lanes, M, U, Vec3};

/// Most places of a pixel's grid, padded.
const MOST_PLACES: usize = 48;
/// Room before the places, for the one before the first.
const BEFORE: usize = gonio_simd::PADDING;

/// What a pixel's places show, in columns; before the first place stands itself.
struct Shown {
    triangle: [u32; BEFORE + MOST_PLACES],
    instance: [u32; BEFORE + MOST_PLACES],
    normal: [[f32; BEFORE + MOST_PLACES]; 3],
    position: [[f32; BEFORE + MOST_PLACES]; 3],
    distance: [f32; BEFORE + MOST_PLACES],
}

/// The same in a register.
#[derive(Clone, Copy)]
struct Surface<L: Lanes> {
    triangle: U<L>,
    instance: U<L>,
    normal: Vec3<L>,
    position: Vec3<L>,
    distance: F<L>,
}

/// Whether a pixel shows surfaces which part: each place is held against the first and against the one before.
#[inline(always)]
pub(super) fn parts<L: Lanes>(l: L, view: &TileView, grid: &Grid, triangles: &Triangles, front: &Front, pixel: [usize; 2]) -> bool {
    let first = (pixel[1] * TILE + pixel[0]) * grid.count();
    let numbers = &front.triangle[first..first + grid.count()];
    let (mut several, mut nothing) = (l.m(false), l.m(false));
    for at in (0..numbers.len()).step_by(L::COUNT) {
        let number = l.load_integers(numbers, at);
        several |= number.ne(numbers[0]);
        nothing |= number.eq(NONE);
    }
    if !several.any() || nothing.any() {
        // Something against nothing.
        return several.any();
    }
    let mut shown = Shown {
        triangle: [0; BEFORE + MOST_PLACES],
        instance: [0; BEFORE + MOST_PLACES],
        normal: [[0.0; BEFORE + MOST_PLACES]; 3],
        position: [[0.0; BEFORE + MOST_PLACES]; 3],
        distance: [0.0; BEFORE + MOST_PLACES],
    };
    for at in (0..numbers.len()).step_by(L::COUNT) {
        look_up(l, view, grid, triangles, front, pixel, at, &mut shown);
    }
    repeat_first(&mut shown);
    let start = broadcast(l, &shown);
    for at in (0..numbers.len()).step_by(L::COUNT) {
        let [here, before] = [load(l, &shown, BEFORE + at), load(l, &shown, BEFORE + at - 1)];
        if (part_from(&start, &here) | part_from(&before, &here)).any() {
            return true;
        }
    }
    false
}

/// Finds what a register of places shows.
#[expect(clippy::too_many_arguments, reason = "a map, and a place in it")]
#[inline(always)]
fn look_up<L: Lanes>(
    l: L,
    view: &TileView,
    grid: &Grid,
    triangles: &Triangles,
    front: &Front,
    pixel: [usize; 2],
    at: usize,
    shown: &mut Shown,
) {
    let place = (pixel[1] * TILE + pixel[0]) * grid.count() + at;
    let number = l.load_integers(&front.triangle, place);
    let depth = l.load(&front.nearness, place).recip();
    let x = (l.load(&grid.places[0], at) + pixel[0] as f32).mul_add(view.pixel[0], view.corner[0]);
    let y = (l.load(&grid.places[1], at) + pixel[1] as f32).mul_add(view.pixel[1], view.corner[1]);
    let to = BEFORE + at;
    number.store(&mut shown.triangle, to);
    l.gather_integers(&triangles.instance, number).store(&mut shown.instance, to);
    for (column, values) in shown.normal.iter_mut().zip(&triangles.normal) {
        l.gather(values, number).store(column, to);
    }
    let [px, py, pz] = &mut shown.position;
    Vec3::new(x * depth, y * depth, depth).store([px, py, pz], to);
    (depth * x.mul_add(x, y.mul_add(y, 1.0)).sqrt()).store(&mut shown.distance, to);
}

fn repeat_first(shown: &mut Shown) {
    for column in [&mut shown.triangle, &mut shown.instance] {
        column[BEFORE - 1] = column[BEFORE];
    }
    for column in shown.normal.iter_mut().chain(&mut shown.position).chain([&mut shown.distance]) {
        column[BEFORE - 1] = column[BEFORE];
    }
}

#[inline(always)]
fn load<L: Lanes>(l: L, shown: &Shown, at: usize) -> Surface<L> {
    let ([nx, ny, nz], [px, py, pz]) = (&shown.normal, &shown.position);
    Surface {
        triangle: l.load_integers(&shown.triangle, at),
        instance: l.load_integers(&shown.instance, at),
        normal: Vec3::load(l, [nx, ny, nz], at),
        position: Vec3::load(l, [px, py, pz], at),
        distance: l.load(&shown.distance, at),
    }
}

/// The first place in every lane.
#[inline(always)]
fn broadcast<L: Lanes>(l: L, shown: &Shown) -> Surface<L> {
    let ([nx, ny, nz], [px, py, pz]) = (&shown.normal, &shown.position);
    Surface {
        triangle: l.u(shown.triangle[BEFORE]),
        instance: l.u(shown.instance[BEFORE]),
        normal: Vec3::splat(l, [nx[BEFORE], ny[BEFORE], nz[BEFORE]]),
        position: Vec3::splat(l, [px[BEFORE], py[BEFORE], pz[BEFORE]]),
        distance: l.f(shown.distance[BEFORE]),
    }
}

/// As `VisibilityMap` has it for hits of rays.
#[inline(always)]
fn part_from<L: Lanes>(one: &Surface<L>, other: &Surface<L>) -> M<L> {
    let turned = one.normal.dot(other.normal).lt(LEAST_COSINE);
    let least = one.distance.min(other.distance) * MOST_DEPTH;
    let behind = (one.distance - other.distance).abs().gt(least);
    let off_plane = one.normal.dot(other.position - one.position).abs().gt(least);
    let apart = one.instance.ne(other.instance);
    one.triangle.ne(other.triangle) & (turned | (apart & behind) | off_plane.and_not(apart))
}
