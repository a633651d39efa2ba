//! Disks that turn their face to the point: directions uniform in the cone under which the disk is seen.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use gonio_simd::{F, Frame, Lanes, Vec3};
use std::f32::consts::TAU;

/// Disks that face whatever looks at them.
pub(crate) struct FacingDisk;

/// The edge belongs to the disk for all its rounding.
const SLACK: f32 = 1.0 + 1e-5;

/// The disk as seen from a point.
struct Seen<L: Lanes> {
    /// Unit direction to the centre, and its distance.
    ahead: Vec3<L>,
    distance: F<L>,
    radius: F<L>,
    /// 1 − cos of the cone's half angle.
    fall: F<L>,
}

impl<L: Lanes> Seen<L> {
    #[inline(always)]
    fn new(light: &Reader<'_, L>, from: Vec3<L>) -> Self {
        let centre = light.vector(field::ORIGIN) - from;
        let radius = light.value(field::HALF);
        let squared = centre.length_squared();
        let distance = squared.sqrt();
        let slant = (squared + radius * radius).sqrt();
        Self { ahead: centre * distance.recip(), distance, radius, fall: radius * radius / (slant * (slant + distance)) }
    }
    #[inline(always)]
    fn pdf(&self) -> F<L> {
        (self.fall * TAU).recip()
    }
}

impl Emitter for FacingDisk {
    #[inline(always)]
    fn sample<L: Lanes>(l: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let seen = Seen::new(light, p);
        let fall = seen.fall * u[0];
        let sine = (fall * (2.0 - fall)).safe_sqrt();
        let cosine = 1.0 - fall;
        let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
        let wi = Frame::from_normal(seen.ahead).to_world(Vec3::new(sine * cosine_turn, sine * sine_turn, cosine));
        Aim { wi, distance: seen.distance / cosine, pdf: seen.pdf(), uv: [l.f(0.0); 2] }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, _: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let seen = Seen::new(light, from);
        let cosine = seen.ahead.dot(wi);
        // The part across keeps its digits where the disk looks small.
        let across = (wi - seen.ahead * cosine).length() * seen.distance;
        let met = across.le(seen.radius * cosine * SLACK);
        (seen.pdf().keep_if(met), [l.f(0.0); 2])
    }
}

/// Points so near that no ray could meet the disk's bounding sphere from outside: they find it by sampling alone.
#[inline(always)]
pub(crate) fn encloses<L: Lanes>(light: &Reader<'_, L>, p: Vec3<L>) -> gonio_simd::M<L> {
    let radius = light.value(field::HALF);
    (light.vector(field::ORIGIN) - p).length_squared().le(radius * radius)
}
