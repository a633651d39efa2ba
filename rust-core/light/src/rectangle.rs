//! Rectangles and parallelograms, sampled by solid angle (Ureña, Fajardo and King, An Area-Preserving Parametrization for Spherical Rectangles,
//! Computer Graphics Forum 32(4), 2013) in a frame where they are rectangles.
//!
//! The paper's angles lie near π where the rectangle looks small; here they are measured from π, so nothing cancels.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use super::solid_angle::{BY_AREA_BELOW, SolidAngle};
use gonio_simd::{F, Lanes, M, Vec3};

/// The rectangle as seen from a point: at height `h > 0` over the plane, the part that the beam's spread can reach it from spanning `x` and `y` around it.
#[derive(Clone, Copy)]
struct Seen<L: Lanes> {
    x: [F<L>; 2],
    y: [F<L>; 2],
    /// The middle of the whole.
    centre: [F<L>; 2],
    h: F<L>,
    /// How far from the foot of the perpendicular the beam still reaches the point.
    reach: F<L>,
    solid_angle: F<L>,
}

impl<L: Lanes> Seen<L> {
    #[inline(always)]
    fn new(light: &Reader<'_, L>, from: Vec3<L>) -> Self {
        let local = light.in_frame(from - light.vector(field::ORIGIN));
        let (half_x, half_y) = (light.value(field::HALF), light.value(field::HALF + 1));
        // Both sides of a two-sided light look alike.
        let h = local.z.abs();
        let reach = h * light.value(field::REACH);
        let centre = [-local.x, -local.y];
        let (x, y) = (within_reach(centre[0], half_x, reach), within_reach(centre[1], half_y, reach));
        let volume = h * ((x[1] - x[0]) * (y[1] - y[0]));
        let [a, b] = [Vec3::new(x[0], y[0], -h), Vec3::new(x[1], y[0], -h)];
        let [c, d] = [Vec3::new(x[1], y[1], -h), Vec3::new(x[0], y[1], -h)];
        let [ia, ib] = [a.length_squared().inverse_root(), b.length_squared().inverse_root()];
        let [ic, id] = [c.length_squared().inverse_root(), d.length_squared().inverse_root()];
        let (first, second) = (SolidAngle::new(volume, [a, b, c], [ia, ib, ic]), SolidAngle::new(volume, [a, c, d], [ia, ic, id]));
        Self { x, y, centre, h, reach, solid_angle: first.value + second.value }
    }
    #[inline(always)]
    fn by_area(&self) -> M<L> {
        self.solid_angle.lt(BY_AREA_BELOW)
    }
    /// Density per solid angle of the frame towards a point at `(x, y)` as seen from the point.
    #[inline(always)]
    fn density(&self, x: F<L>, y: F<L>) -> F<L> {
        let squared = x * x + y * y + self.h * self.h;
        let area = (self.x[1] - self.x[0]) * (self.y[1] - self.y[0]);
        let by_area = squared * squared.sqrt() / (area * self.h);
        self.by_area().select(by_area, self.solid_angle.recip())
    }
    /// Paper's section 4, with δ the paper's angle less π.
    #[inline(always)]
    fn by_solid_angle(&self, u: [F<L>; 2]) -> [F<L>; 2] {
        let ([x0, x1], [y0, y1], h) = (self.x, self.y, self.h);
        let square = h * h;
        let delta = u[0] * self.solid_angle + (slant([x0, y1], h) - slant([x0, y0], h));
        let (sin_half, cos_half) = (delta * 0.5).sin_cos();
        let sine = sin_half * cos_half * 2.0;
        let (r0, r1) = ((square + y0 * y0).sqrt(), (square + y1 * y1).sqrt());
        let b0 = -(y0 / r0);
        // y1 / r1 − y0 / r0, without cancellation where the rectangle lies to one side.
        let difference = square * (y1 * y1 - y0 * y0) / (r0 * r1 * (y1 * r0 + y0 * r1));
        let difference = (y0 * y1).gt(0.0).select(difference, y1 / r1 + b0);
        let along = difference - b0 * (sin_half * sin_half * 2.0);
        let across = (along * along - square / (r0 * r0) * (sine * sine)).max(f32::MIN_POSITIVE).sqrt();
        let x = (sine.copysign(sine * along) * h / across).clamp(x0, x1);
        let d = (x * x + square).sqrt();
        let (h0, h1) = (y0 / (d * d + y0 * y0).sqrt(), y1 / (d * d + y1 * y1).sqrt());
        let hv = h0.lerp(h1, u[1]);
        let y = hv * d / (1.0 - hv * hv).max(f32::MIN_POSITIVE).sqrt();
        [x, y.clamp(y0, y1)]
    }
    #[inline(always)]
    fn aim(&self, light: &Reader<'_, L>, below: M<L>, x: F<L>, y: F<L>) -> Aim<L> {
        let local = Vec3::new(x, y, below.select(self.h, -self.h));
        let (half_x, half_y) = (light.value(field::HALF), light.value(field::HALF + 1));
        let aim = Aim::towards(local.transform(light.frame()));
        // The image's first pixel is at (+x, +y): upright for what is lit.
        let s = (self.centre[0] + half_x - x) / (half_x * 2.0);
        let t = (self.centre[1] + half_y - y) / (half_y * 2.0);
        Aim { pdf: self.density(x, y) * light.solid_angle_ratio(aim.wi), uv: [s, t], ..aim }
    }
}

/// Rectangles and parallelograms.
pub(crate) struct Rectangle;

impl Emitter for Rectangle {
    #[inline(always)]
    fn sample<L: Lanes>(_: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let below = light.vector(field::NORMAL).dot(p - light.vector(field::ORIGIN)).lt(0.0);
        let seen = Seen::new(light, p);
        let [x, y] = seen.by_solid_angle(u);
        let by_area = seen.by_area();
        let x = by_area.select(seen.x[0].lerp(seen.x[1], u[0]), x);
        let y = by_area.select(seen.y[0].lerp(seen.y[1], u[1]), y);
        seen.aim(light, below, x, y)
    }
    #[inline(always)]
    fn density<L: Lanes>(_: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, hit: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let seen = Seen::new(light, from);
        let local = light.in_frame(hit - light.vector(field::ORIGIN));
        let (half_x, half_y) = (light.value(field::HALF), light.value(field::HALF + 1));
        let (x, y) = (local.x + seen.centre[0], local.y + seen.centre[1]);
        let uv = [(half_x - local.x) / (half_x * 2.0), (half_y - local.y) / (half_y * 2.0)];
        let reached = x.abs().le(seen.reach) & y.abs().le(seen.reach);
        ((seen.density(x, y) * light.solid_angle_ratio(wi)).keep_if(reached), uv)
    }
}

/// The part of a side that the light's spread reaches.
#[inline(always)]
fn within_reach<L: Lanes>(centre: F<L>, half: F<L>, reach: F<L>) -> [F<L>; 2] {
    let low = (centre - half).max(-reach);
    [low, (centre + half).min(reach).max(low)]
}

/// The angle whose sine is xy / √((x² + h²)(y² + h²)).
#[inline(always)]
fn slant<L: Lanes>([x, y]: [F<L>; 2], h: F<L>) -> F<L> {
    (x * y).atan2(h * (x * x + y * y + h * h).sqrt())
}
