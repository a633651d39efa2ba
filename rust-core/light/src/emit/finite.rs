//! Rays of lights that have a place: a direction as the light sends it and a place that shows to it, or a place and a direction into the cone
//! around a target seen from there. The density is that of both together.

use super::EmissionSampler;
use super::aim::{self, AIMED};
use super::place::{Ways, any_round_place, opposite, round_area, round_normal, shown_round_place};
use super::row::{Model, Own, at};
use crate::row::{Reader, field};
use crate::table::LightTable;
use gonio_simd::{F, Lanes, M, Vec3};
use std::f32::consts::PI;

/// Where a ray starts.
#[derive(Clone, Copy)]
pub(super) struct Start<L: Lanes> {
    pub(super) origin: Vec3<L>,
    pub(super) normal: Vec3<L>,
    pub(super) direction: Vec3<L>,
    /// Cosine at the emitter over the density of place and direction; what is not above zero and finite is no ray.
    pub(super) weight: F<L>,
    /// Place in the texture.
    pub(super) uv: [F<L>; 2],
    /// From where on the ray carries light.
    pub(super) clear: F<L>,
}

/// A place that rays start from, as the two ways to draw it know it.
pub(super) struct Placed<L: Lanes> {
    pub(super) origin: Vec3<L>,
    pub(super) normal: Vec3<L>,
    pub(super) cosine: F<L>,
    /// Density of the place where the direction comes first.
    pub(super) by_direction: F<L>,
    /// Density of place and direction where the place comes first.
    pub(super) by_aim: F<L>,
}

impl EmissionSampler {
    #[inline(always)]
    pub(super) fn start_finite<L: Lanes>(
        &self,
        l: L,
        table: &LightTable,
        light: &Reader<'_, L>,
        own: &Own<'_, L>,
        u_place: [F<L>; 2],
        u_direction: [F<L>; 2],
    ) -> Start<L> {
        let zero = l.f(0.0);
        let (aimed, left) = self.targets.split(l, u_direction[0]);
        let u_direction = [left, u_direction[1]];
        let (sent, pdf) = self.sent_direction(l, own, u_direction);
        let ways = Ways::new(light);
        let origin = light.vector(field::ORIGIN);
        let mut direction = sent;
        let mut start = Placed { origin, normal: Vec3::splat(l, [0.0; 3]), cosine: l.f(1.0), by_direction: l.f(1.0), by_aim: zero };
        let mut uv = [zero; 2];
        // Points.
        if !self.targets.is_empty() && !(ways.flat | ways.round | ways.facing).all() {
            direction = aimed.select(self.targets.direction(l, origin, u_direction), direction);
            start.by_aim = self.targets.density(l, origin, direction);
        }
        if ways.flat.any() {
            let place = self.flat_place(l, table, light, own, u_place);
            let on = place.local.transform(light.frame()) + origin;
            if aimed.any() {
                direction = (aimed & ways.flat).select(self.targets.direction(l, on, u_direction), direction);
            }
            let by_aim = if self.targets.is_empty() { zero } else { place.pdf * self.targets.density(l, on, direction) };
            let cosine = light.vector(field::NORMAL).dot(direction);
            let behind = cosine.lt(0.0) & light.flag(crate::row::flag::TWO_SIDED);
            let normal = light.vector(field::NORMAL) * l.f(1.0).copysign(behind.select(l.f(-1.0), l.f(1.0)));
            let cosine = behind.select(-cosine, cosine);
            start = start.where_is(ways.flat, Placed { origin: on, normal, cosine, by_direction: place.pdf, by_aim });
            uv = [place.uv[0].keep_if(ways.flat), place.uv[1].keep_if(ways.flat)];
        }
        if ways.round.any() {
            let (placed, towards) = self.round(l, light, [ways.round, ways.sphere], aimed, sent, [u_place, u_direction]);
            start = start.where_is(ways.round, placed);
            direction = ways.round.select(towards, direction);
        }
        let mut clear = zero;
        if ways.facing.any() {
            let (placed, towards, from) = self.facing(l, light, own, [ways.facing, aimed], sent, [u_place, u_direction]);
            start = start.where_is(ways.facing, placed);
            direction = ways.facing.select(towards, direction);
            clear = from.keep_if(ways.facing);
        }
        let mut density = pdf * start.by_direction;
        if !self.targets.is_empty() {
            density = (self.sent_density(l, own, direction) * start.by_direction).lerp(start.by_aim, AIMED);
        }
        Start { origin: start.origin, normal: start.normal, direction, weight: start.cosine / density, uv, clear }
    }

    /// A place on a sphere or a cylinder, and the direction from there.
    #[inline(always)]
    fn round<L: Lanes>(
        &self,
        l: L,
        light: &Reader<'_, L>,
        [round, sphere]: [M<L>; 2],
        aimed: M<L>,
        sent: Vec3<L>,
        [u_place, u_direction]: [[F<L>; 2]; 2],
    ) -> (Placed<L>, Vec3<L>) {
        let (origin, frame, zero) = (light.vector(field::ORIGIN), light.frame(), l.f(0.0));
        let aimed = aimed & round;
        let mut direction = sent;
        let mut place = shown_round_place(l, sphere, light.in_frame(sent), u_place);
        if aimed.any() {
            let (centre, radius, left) = self.targets.choose(l, u_direction[0]);
            let holds = aim::holds(centre - origin, radius);
            // A place on the half that faces the target.
            let any = any_round_place(sphere, u_place);
            let away = round_normal(light, sphere, any).dot(centre - origin).lt(0.0).and_not(holds);
            let any = away.select(opposite(sphere, any), any);
            let towards = aim::direction_to(l, centre - (any.transform(frame) + origin), radius, [left, u_direction[1]]);
            // From within, any place: what shows its back turns into what lies opposite.
            let behind = holds & round_normal(light, sphere, any).dot(towards).lt(0.0);
            place = aimed.select(behind.select(opposite(sphere, any), any), place);
            direction = aimed.select(towards, direction);
        }
        let on = place.transform(frame) + origin;
        let stretched = round_normal(light, sphere, place);
        let size = stretched.length();
        let normal = stretched * size.recip();
        let cosine = normal.dot(direction);
        let by_direction = cosine.max(0.0) / round_area(light, sphere, light.in_frame(direction));
        let mut by_aim = zero;
        if !self.targets.is_empty() {
            let other = opposite(sphere, place).transform(frame) + origin;
            let density = self.targets.round_density(l, origin, [on, other], stretched, direction);
            by_aim = density * light.value(field::DENSITY) / (size * (4.0 * PI));
        }
        (Placed { origin: on, normal, cosine, by_direction, by_aim }, direction)
    }

    /// A direction as the light alone sends it, and its density.
    #[inline(always)]
    fn sent_direction<L: Lanes>(&self, l: L, own: &Own<'_, L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>) {
        let model = own.integer(at::MODEL);
        let both = model.eq(Model::BothSides as u32);
        let second = both & u[0].ge(0.5);
        let left = both.select(u[0] * 2.0 - l.f(1.0).keep_if(second), u[0]);
        let even = model.eq(Model::Even as u32);
        let height = even.select(1.0 - left * 2.0, (1.0 - left).safe_sqrt());
        let sine = even.select((1.0 - height * height).safe_sqrt(), left.sqrt());
        let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
        let mut local = Vec3::new(sine * cosine_turn, sine * sine_turn, second.select(-height, height));
        let by_cosine = height * both.select(l.f(0.5 / PI), l.f(1.0 / PI));
        let mut pdf = even.select(l.f(0.25 / PI), by_cosine);
        let tabulated = model.eq(Model::Table as u32);
        if !self.beams.is_empty() && tabulated.any() {
            let (direction, density) = self.beams.sample(l, own, u);
            local = tabulated.select(direction, local);
            pdf = tabulated.select(density, pdf);
        }
        (local.transform(own.frame()), pdf)
    }

    /// Density of [`Self::sent_direction`].
    #[inline(always)]
    fn sent_density<L: Lanes>(&self, l: L, own: &Own<'_, L>, direction: Vec3<L>) -> F<L> {
        let [x, y, pole] = own.frame();
        let model = own.integer(at::MODEL);
        let local = Vec3::new(x.dot(direction), y.dot(direction), pole.dot(direction));
        let both = model.eq(Model::BothSides as u32);
        let by_cosine = both.select(local.z.abs() * 0.5, local.z.max(0.0)) * (1.0 / PI);
        let mut pdf = model.eq(Model::Even as u32).select(l.f(0.25 / PI), by_cosine);
        let tabulated = model.eq(Model::Table as u32);
        if !self.beams.is_empty() && tabulated.any() {
            pdf = tabulated.select(self.beams.density(l, own, local), pdf);
        }
        pdf
    }
}

impl<L: Lanes> Placed<L> {
    #[inline(always)]
    fn where_is(self, mask: M<L>, other: Self) -> Self {
        Self {
            origin: mask.select(other.origin, self.origin),
            normal: mask.select(other.normal, self.normal),
            cosine: mask.select(other.cosine, self.cosine),
            by_direction: mask.select(other.by_direction, self.by_direction),
            by_aim: mask.select(other.by_aim, self.by_aim),
        }
    }
}
