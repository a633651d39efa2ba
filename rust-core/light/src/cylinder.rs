//! Lateral surfaces of cylinders: around, the side that faces the point, in proportion to the cosine; along, equal angles as seen from the point
//! (Kulla and Fajardo, Importance Sampling Techniques for Path Tracing in Participating Media, EGSR 2012, section 4.1).

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use gonio_simd::{F, Lanes, Vec3};

/// Cylinders, circular or elliptic, straight or sheared.
pub(crate) struct Cylinder;

/// A line of the surface along the axis, as seen from a point.
struct Line<L: Lanes> {
    /// From the point to the line's middle.
    middle: Vec3<L>,
    /// Unit direction of the axis.
    along: Vec3<L>,
    /// Surface normal, as long as the surface is wide per radian.
    normal: Vec3<L>,
    half: F<L>,
    /// Place of the line's point nearest to the given one, and its distance.
    foot: F<L>,
    distance: F<L>,
    /// Angle under which the line is seen.
    angle: F<L>,
}

impl<L: Lanes> Line<L> {
    #[inline(always)]
    fn new(light: &Reader<'_, L>, p: Vec3<L>, cosine: F<L>, sine: F<L>) -> Self {
        let [x, y, z] = light.frame();
        let half = light.value(field::HALF);
        let along = x * half.recip();
        let middle = light.vector(field::ORIGIN) - p + y * cosine + z * sine;
        let normal = (z * cosine - y * sine).cross(along);
        let outward = half.lanes().f(1.0).copysign(normal.dot(y * cosine + z * sine));
        let normal = normal * outward;
        let foot = -middle.dot(along);
        let distance = (middle + along * foot).length().max(f32::MIN_POSITIVE);
        let angle = (half * distance * 2.0).atan2(distance * distance + (foot - half) * (foot + half));
        Self { middle, along, normal, half, foot, distance, angle }
    }
    /// Density of the direction to the line's point at `t`, per solid angle and per density around.
    #[inline(always)]
    fn density(&self, t: F<L>) -> F<L> {
        let v = self.along.mul_add(t, self.middle);
        let squared = v.length_squared();
        let off = t - self.foot;
        let along = self.distance / (self.angle * (self.distance * self.distance + off * off));
        along * squared * squared.sqrt() / -self.normal.dot(v)
    }
}

/// Sine of half the visible angle around, and the direction to the point across the axis; NaN from where only the inside is seen.
#[inline(always)]
fn visible<L: Lanes>(light: &Reader<'_, L>, p: Vec3<L>) -> (F<L>, F<L>, F<L>) {
    let local = light.in_frame(p - light.vector(field::ORIGIN));
    let squared = local.y * local.y + local.z * local.z;
    let inverse = squared.inverse_root();
    ((1.0 - squared.recip()).sqrt(), local.y * inverse, local.z * inverse)
}

impl Emitter for Cylinder {
    #[inline(always)]
    fn sample<L: Lanes>(l: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let (limit, toward_y, toward_z) = visible(light, p);
        let sine = limit * (u[0] * 2.0 - 1.0);
        let cosine = (1.0 - sine * sine).safe_sqrt();
        let line = Line::new(light, p, toward_y * cosine - toward_z * sine, toward_z * cosine + toward_y * sine);
        let first = (-line.half - line.foot).atan2(line.distance);
        let (sin_angle, cos_angle) = line.angle.mul_add(u[1], first).sin_cos();
        let t = (line.foot + line.distance * sin_angle / cos_angle.max(f32::MIN_POSITIVE)).clamp(-line.half, line.half);
        let aim = Aim::towards(line.along.mul_add(t, line.middle));
        Aim { pdf: line.density(t) * cosine / (limit * 2.0), uv: [l.f(0.0); 2], ..aim }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, _: Vec3<L>, hit: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let (limit, toward_y, toward_z) = visible(light, from);
        let local = light.in_frame(hit - light.vector(field::ORIGIN));
        let inverse = (local.y * local.y + local.z * local.z).inverse_root();
        let (y, z) = (local.y * inverse, local.z * inverse);
        let cosine = y * toward_y + z * toward_z;
        let line = Line::new(light, from, y, z);
        (line.density(local.x * line.half) * cosine / (limit * 2.0), [l.f(0.0); 2])
    }
}
