//! Disks that turn their face to the point: directions uniform in the cone under which the disk is seen.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use gonio_simd::{F, Frame, Lanes, Vec3};

/// Disks that face whatever looks at them.
pub(crate) struct FacingDisk;

/// The edge belongs to the disk for all its rounding.
const SLACK: f32 = 1.0 + 1e-5;

/// The disk as seen from a point.
struct Seen<L: Lanes> {
    /// To the centre.
    centre: Vec3<L>,
    /// Its distance, and one over that.
    distance: F<L>,
    inverse: F<L>,
    radius: F<L>,
    /// The squared radius over 1 − cos of the cone's half angle.
    spread: F<L>,
    pdf: F<L>,
}

impl<L: Lanes> Seen<L> {
    #[inline(always)]
    fn new(light: &Reader<'_, L>, from: Vec3<L>) -> Self {
        let centre = light.vector(field::ORIGIN) - from;
        let radius = light.value(field::HALF);
        let squared = centre.length_squared();
        let inverse = squared.inverse_root();
        let distance = squared * inverse;
        let slant = (squared + radius * radius).sqrt();
        let spread = slant * (slant + distance);
        Self { centre, distance, inverse, radius, spread, pdf: spread * light.value(field::HALF + 1) }
    }
}

impl Emitter for FacingDisk {
    #[inline(always)]
    fn sample<L: Lanes>(l: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let seen = Seen::new(light, p);
        // 1 − cos itself is drawn, which keeps its digits where the cone is thin.
        let fall = seen.radius * seen.radius * u[0] / seen.spread;
        let sine = (fall * (2.0 - fall)).safe_sqrt();
        let cosine = 1.0 - fall;
        let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
        let ahead = seen.centre * seen.inverse;
        let wi = Frame::from_normal(ahead).to_world(Vec3::new(sine * cosine_turn, sine * sine_turn, cosine));
        Aim { wi, distance: seen.distance / cosine, pdf: seen.pdf, uv: [l.f(0.0); 2] }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, _: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let seen = Seen::new(light, from);
        let ahead = seen.centre * seen.inverse;
        let cosine = ahead.dot(wi);
        // The part across keeps its digits where the disk looks small.
        let across = (wi - ahead * cosine).length() * seen.distance;
        let met = across.le(seen.radius * cosine * SLACK);
        (seen.pdf.keep_if(met), [l.f(0.0); 2])
    }
}

/// Points so near that no ray could meet the disk's bounding sphere from outside: they find it by sampling alone.
#[inline(always)]
pub(crate) fn encloses<L: Lanes>(light: &Reader<'_, L>, p: Vec3<L>) -> gonio_simd::M<L> {
    let radius = light.value(field::HALF);
    (light.vector(field::ORIGIN) - p).length_squared().le(radius * radius)
}
