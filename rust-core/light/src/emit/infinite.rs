//! Rays of infinite lights: a direction as the light alone sends it, and a place on a disk across it, around the scene or around a target.

use super::EmissionSampler;
use super::aim::AIMED;
use super::finite::Start;
use crate::light_kind::LightKind;
use crate::row::{Reader, field};
use crate::table::LightTable;
use crate::{distant, dome};
use gonio_simd::{F, Frame, Lanes, U, Vec3};
use std::f32::consts::PI;

/// Rays start this many scene radii before the scene's centre.
const OUTSIDE: f32 = 1.001;

impl EmissionSampler {
    #[inline(always)]
    pub(super) fn start_infinite<L: Lanes>(
        &self,
        l: L,
        table: &LightTable,
        light: &Reader<'_, L>,
        index: U<L>,
        u_place: [F<L>; 2],
        u_direction: [F<L>; 2],
    ) -> Start<L> {
        let (towards, pdf, uv) = self.sky(l, table, light, index, u_direction);
        let direction = -towards;
        let (aimed, left) = self.targets.split(l, u_place[0]);
        let (scene, around) = (Vec3::splat(l, self.scene.0), l.f(self.scene.1));
        let (mut centre, mut radius, mut left) = (scene, around, left);
        if aimed.any() {
            let (target, reach, rest) = self.targets.choose(l, left);
            centre = aimed.select(target, centre);
            radius = aimed.select(reach, radius);
            left = aimed.select(rest, left);
        }
        let off = left.sqrt() * radius;
        let (sine_turn, cosine_turn) = u_place[1].sin_cos_turns();
        let frame = Frame::from_normal(direction);
        let place = frame.x.mul_add(off * cosine_turn, frame.y.mul_add(off * sine_turn, centre));
        let from_centre = place - scene;
        let along = from_centre.dot(direction);
        let across = from_centre - direction * along;
        let mut per_area = l.f(1.0) / (around * around * PI);
        if !self.targets.is_empty() {
            // A target may reach beyond the scene's sphere.
            let within = across.length_squared().le(around * around * 1.0001);
            per_area = per_area.keep_if(within).lerp(self.targets.disk_density(l, place, direction), AIMED);
        }
        let origin = scene + across - direction * (around * OUTSIDE);
        let nowhere = Vec3::splat(l, [0.0; 3]);
        Start { origin, normal: nowhere, direction, weight: (pdf * per_area).recip(), uv, clear: l.f(0.0) }
    }

    /// A direction towards an infinite light, its density and its place in the image.
    #[inline(always)]
    fn sky<L: Lanes>(&self, l: L, table: &LightTable, light: &Reader<'_, L>, index: U<L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>, [F<L>; 2]) {
        let zero = l.f(0.0);
        let (mut towards, mut pdf) = dome::sample_constant(l, Vec3::splat(l, [0.0; 3]), u);
        let mut uv = [zero; 2];
        if table.has(LightKind::Distant) {
            let of_kind = light.is_kind(LightKind::Distant);
            let (wi, density) = distant::sample(l, light, u);
            towards = of_kind.select(wi, towards);
            pdf = of_kind.select(density, pdf);
        }
        for (number, distribution) in &self.domes {
            let chosen = index.eq(*number);
            if chosen.any() {
                let (local, density, place) = distribution.sample(l, u);
                let [x, y, z] = [light.vector(field::FRAME), light.vector(field::FRAME + 3), light.vector(field::FRAME + 6)];
                towards = chosen.select(local.transform([x, y, z]), towards);
                pdf = chosen.select(density, pdf);
                uv = [chosen.select(place[0], uv[0]), chosen.select(place[1], uv[1])];
            }
        }
        (towards, pdf, uv)
    }
}
