//! Places on finite emitters that rays start from.

use super::EmissionSampler;
use super::row::{Own, at};
use crate::light_kind::LightKind;
use crate::row::{Reader, field, flag};
use crate::table::LightTable;
use gonio_simd::{F, Frame, Lanes, M, Vec3};
use std::f32::consts::PI;

/// Which of the ways to draw a place each lane's light takes.
pub(super) struct Ways<L: Lanes> {
    /// Rectangles, disks and triangles.
    pub(super) flat: M<L>,
    /// Spheres and cylinders.
    pub(super) round: M<L>,
    pub(super) sphere: M<L>,
    pub(super) facing: M<L>,
}

impl<L: Lanes> Ways<L> {
    #[inline(always)]
    pub(super) fn new(light: &Reader<'_, L>) -> Self {
        let sphere = light.is_kind(LightKind::Sphere);
        Self {
            flat: light.flag(flag::FLAT),
            round: sphere | light.is_kind(LightKind::Cylinder),
            sphere,
            facing: light.is_kind(LightKind::FacingDisk),
        }
    }
}

/// A place on a flat light: in its frame, in its texture, and the density per area.
#[derive(Clone, Copy)]
pub(super) struct FlatPlace<L: Lanes> {
    pub(super) local: Vec3<L>,
    pub(super) uv: [F<L>; 2],
    pub(super) pdf: F<L>,
}

impl EmissionSampler {
    /// A place on a flat light, by area or by its texture.
    #[inline(always)]
    pub(super) fn flat_place<L: Lanes>(
        &self,
        l: L,
        table: &LightTable,
        light: &Reader<'_, L>,
        own: &Own<'_, L>,
        u: [F<L>; 2],
    ) -> FlatPlace<L> {
        let zero = l.f(0.0);
        let (mut uv, mut relative) = (u, l.f(1.0));
        let mut left = own.integer(at::PLACES).ne(0);
        if !self.places.is_empty() && left.any() {
            let number = own.integer(at::PLACES);
            // Each distribution that some lane has, for all lanes that have it.
            while left.any() {
                let one = number.to_array()[left.bits().trailing_zeros() as usize];
                let same = left & number.eq(one);
                if let Some(places) = self.places.get(one as usize - 1) {
                    let (place, pdf) = places.sample(l, u);
                    uv = [same.select(place[0], uv[0]), same.select(place[1], uv[1])];
                    relative = same.select(pdf, relative);
                }
                left = left.and_not(same);
            }
        }
        // The image's first pixel is at (+x, +y).
        let (half_x, half_y) = (light.value(field::HALF), light.value(field::HALF + 1));
        let mut local = Vec3::new((1.0 - uv[0] * 2.0) * half_x, (1.0 - uv[1] * 2.0) * half_y, zero);
        if table.has(LightKind::Disk) {
            let disk = light.is_kind(LightKind::Disk);
            let (sine, cosine) = u[1].sin_cos_turns();
            let radius = u[0].sqrt();
            local = disk.select(Vec3::new(radius * cosine, radius * sine, zero), local);
        }
        if table.has(LightKind::Triangle) {
            let triangle = light.is_kind(LightKind::Triangle);
            // Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
            let upper = u[0].lt(u[1]);
            let (small, large) = (u[0].min(u[1]) * 0.5, u[0].max(u[1]));
            let corner = Vec3::new(upper.select(small, large - small), upper.select(large - small, small), zero);
            local = triangle.select(corner, local);
        }
        FlatPlace { local, uv, pdf: relative / own.value(at::AREA) }
    }
}

/// A place on a sphere or cylinder, even over its parameters: on the unit sphere, or along and around the unit cylinder.
#[inline(always)]
pub(super) fn any_round_place<L: Lanes>(sphere: M<L>, u: [F<L>; 2]) -> Vec3<L> {
    let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
    let height = 1.0 - u[0] * 2.0;
    let ring = sphere.select((1.0 - height * height).safe_sqrt(), u[0].lanes().f(1.0));
    Vec3::new(height, ring * cosine_turn, ring * sine_turn)
}

/// A place on the side of a sphere or cylinder that shows to `direction` (in its frame, of any length), even over what is seen of it.
#[inline(always)]
pub(super) fn shown_round_place<L: Lanes>(l: L, sphere: M<L>, direction: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
    let zero = l.f(0.0);
    let ahead = direction.normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
    let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
    let radius = u[0].sqrt();
    let on_sphere = Frame::from_normal(ahead).to_world(Vec3::new(radius * cosine_turn, radius * sine_turn, (1.0 - u[0]).safe_sqrt()));
    let across = Vec3::new(zero, direction.y, direction.z).normalize_or(Vec3::splat(l, [0.0, 1.0, 0.0]));
    let sine = u[0] * 2.0 - 1.0;
    let cosine = (1.0 - sine * sine).safe_sqrt();
    let on_cylinder = Vec3::new(u[1] * 2.0 - 1.0, across.y * cosine - across.z * sine, across.z * cosine + across.y * sine);
    sphere.select(on_sphere, on_cylinder)
}

/// Normal at a place of a sphere or cylinder, as long as its parameters' density per area is small.
#[inline(always)]
pub(super) fn round_normal<L: Lanes>(light: &Reader<'_, L>, sphere: M<L>, place: Vec3<L>) -> Vec3<L> {
    let (x, y, z) = (light.vector(field::INVERSE), light.vector(field::INVERSE + 3), light.vector(field::INVERSE + 6));
    x.mul_add(place.x.keep_if(sphere), y.mul_add(place.y, z * place.z))
}

/// Projected area of a sphere or cylinder towards a direction in its frame.
#[inline(always)]
pub(super) fn round_area<L: Lanes>(light: &Reader<'_, L>, sphere: M<L>, direction: Vec3<L>) -> F<L> {
    let across = direction.y * direction.y + direction.z * direction.z;
    let ball = (direction.x * direction.x + across).sqrt() * PI;
    sphere.select(ball, across.sqrt() * 4.0) / light.value(field::DENSITY)
}

/// The opposite place.
#[inline(always)]
pub(super) fn opposite<L: Lanes>(sphere: M<L>, place: Vec3<L>) -> Vec3<L> {
    Vec3::new(sphere.select(-place.x, place.x), -place.y, -place.z)
}
