//! Rays of disks that turn their face to whatever looks at them.
//!
//! A point at distance d from the centre sees a disk of radius r about it, turned to the point: rays that come under an angle to the centre whose
//! tangent is at most r / d. A ray that passes the centre at distance b is one of these from b² / √(r² − b²) on behind its nearest place. So the
//! disk sends every direction alike, even over a disk across it, and each ray is dark until there.

use super::EmissionSampler;
use super::aim::{density_to, direction_to, holds};
use super::finite::Placed;
use super::row::{Own, at};
use crate::row::{Reader, field};
use gonio_simd::{F, Frame, Lanes, M, Vec3};

/// The edge belongs to the disk for all its rounding.
const RIM: f32 = 1.0001;

impl EmissionSampler {
    /// The nearest place to the centre of a ray, the ray's direction, and from where on it carries light.
    #[inline(always)]
    pub(super) fn facing<L: Lanes>(
        &self,
        l: L,
        light: &Reader<'_, L>,
        own: &Own<'_, L>,
        [facing, aimed]: [M<L>; 2],
        sent: Vec3<L>,
        [u_place, u_direction]: [[F<L>; 2]; 2],
    ) -> (Placed<L>, Vec3<L>, F<L>) {
        let (origin, radius) = (light.vector(field::ORIGIN), light.value(field::HALF));
        let aimed = aimed & facing;
        let (mut direction, mut off) = (sent, across(sent, radius, u_place));
        if aimed.any() {
            let (centre, reach, left) = self.targets.choose(l, u_direction[0]);
            let to = centre - origin;
            let inside = holds(to, reach);
            // Through a place of the disk that the target sees; from within the target as the light alone sends.
            let seen = across(to.normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0])), radius, u_place);
            let seen = inside.select(Vec3::splat(l, [0.0; 3]), seen);
            let towards = direction_to(l, to - seen, reach, [left, u_direction[1]]);
            let nearest = inside.select(across(towards, radius, u_place), seen - towards * seen.dot(towards));
            off = aimed.select(nearest, off);
            direction = aimed.select(towards, direction);
        }
        let share = own.value(at::AREA).recip();
        let by_aim = self.facing_density(l, origin, radius, off, direction) * share;
        let part = (off.length_squared() / (radius * radius)).min(1.0);
        let clear = radius * part / (1.0 - part).max(f32::EPSILON).sqrt();
        (Placed { origin: origin + off, normal: direction, cosine: l.f(1.0), by_direction: share, by_aim }, direction, clear)
    }

    /// Density of aiming a ray, over that of its place on the disk across it.
    #[inline(always)]
    fn facing_density<L: Lanes>(&self, l: L, origin: Vec3<L>, radius: F<L>, off: Vec3<L>, direction: Vec3<L>) -> F<L> {
        let mut sum = l.f(0.0);
        for (centre, reach) in &self.targets.spheres {
            let (to, reach) = (Vec3::splat(l, *centre) - origin, l.f(*reach));
            let inside = holds(to, reach);
            let ahead = to.normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
            // Where the ray crosses the disk that the target sees.
            let slope = ahead.dot(direction);
            let met = off - direction * (ahead.dot(off) / slope);
            let within = inside | met.length_squared().le(radius * radius * RIM);
            let from = inside.select(Vec3::splat(l, [0.0; 3]), met);
            let by_place = density_to(l, to - from, reach, direction) / inside.select(l.f(1.0), slope.abs());
            sum += by_place.keep_if(within & by_place.is_finite());
        }
        sum * (1.0 / self.targets.spheres.len().max(1) as f32)
    }
}

/// A place on the disk across a direction, relative to its centre.
#[inline(always)]
fn across<L: Lanes>(direction: Vec3<L>, radius: F<L>, u: [F<L>; 2]) -> Vec3<L> {
    let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
    let off = u[0].sqrt() * radius;
    let frame = Frame::from_normal(direction);
    frame.x * (off * cosine_turn) + frame.y * (off * sine_turn)
}
