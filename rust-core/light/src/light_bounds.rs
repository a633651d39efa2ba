//! What the light sampler knows of one light, and its importance at a point: about the illuminance that it brings there.
//!
//! pbrt calls it `LightBounds` as well (Physically Based Rendering, 4th edition, section 12.6.3).

use super::light_kind::LightKind;
use super::row::{Reader, field, flag};
use gonio_simd::{F, Lanes, M, U, Vec3};

/// A light is never thought weaker than this share by the receiver's orientation, because surfaces may let light through.
const RECEIVER_FLOOR: f32 = 0.05;
/// The same for the emitter's obliqueness, because the far end of a light may face the point more squarely.
pub(super) const EMITTER_FLOOR: f32 = 0.1;

/// What a light's importance is computed from, one light in all lanes or a light in each.
pub(super) struct LightBounds<L: Lanes> {
    centre: Vec3<L>,
    radius: F<L>,
    strength: F<L>,
    axis: Vec3<L>,
    normal: Vec3<L>,
    cone_cosine: F<L>,
    sine: F<L>,
    /// Cosine of the half angle of a flat light's spread, and what the spread gains on the normal: 1 without one.
    spread_cosine: F<L>,
    gain: F<L>,
    flags: U<L>,
}

impl<L: Lanes> LightBounds<L> {
    #[inline(always)]
    pub(super) fn gather(light: &Reader<'_, L>) -> Self {
        Self {
            centre: light.vector(field::BOUND_CENTRE),
            radius: light.value(field::BOUND_RADIUS),
            strength: light.value(field::STRENGTH),
            axis: light.vector(field::AXIS),
            normal: light.vector(field::NORMAL),
            cone_cosine: light.value(field::CONE_COSINE),
            sine: light.value(field::SINE),
            spread_cosine: light.value(field::SPREAD_COSINE),
            gain: light.value(field::SPREAD_TANGENT) * light.value(field::SPREAD_GAIN),
            flags: light.integer(field::FLAGS),
        }
    }
    #[inline(always)]
    pub(super) fn splat(l: L, row: &[f32]) -> Self {
        let vector = |at: usize| Vec3::new(l.f(row[at]), l.f(row[at + 1]), l.f(row[at + 2]));
        Self {
            centre: vector(field::BOUND_CENTRE),
            radius: l.f(row[field::BOUND_RADIUS]),
            strength: l.f(row[field::STRENGTH]),
            axis: vector(field::AXIS),
            normal: vector(field::NORMAL),
            cone_cosine: l.f(row[field::CONE_COSINE]),
            sine: l.f(row[field::SINE]),
            spread_cosine: l.f(row[field::SPREAD_COSINE]),
            gain: l.f(row[field::SPREAD_TANGENT] * row[field::SPREAD_GAIN]),
            flags: l.u(row[field::FLAGS].to_bits()),
        }
    }
    #[inline(always)]
    fn is(&self, bit: u32) -> M<L> {
        (self.flags & bit).ne(0)
    }
    /// Importance: about the illuminance at `p` on a surface of normal `n` (zero: no surface), zero only where none of the light can arrive.
    #[inline(always)]
    pub(super) fn importance(&self, l: L, p: Vec3<L>, n: Vec3<L>) -> F<L> {
        let far = self.is(flag::INFINITE);
        // A distant light's lowest point stands higher by the sine of its half angle; domes are on every side.
        let dome = (self.flags & flag::KIND).eq(LightKind::Dome as u32);
        let from_far = lifted(l, n, dome.select(l.f(1.0), self.sine - self.axis.dot(n)));

        let towards = self.centre - p;
        let squared = towards.length_squared().max(f32::MIN_POSITIVE);
        let nearness = squared.inverse_root();
        // The cosine of an angle less another one is at most the cosine of the one plus the sine of the other.
        let sine = (self.radius * nearness).min(1.0);
        let inside = squared.le(self.radius * self.radius);
        let receiver = inside.select(l.f(1.0), (n.dot(towards) * nearness + sine).min(1.0));
        let height = -self.normal.dot(towards);
        let height = self.is(flag::TWO_SIDED).select(height.abs(), height);
        let cosine = height * nearness;
        let emitter = inside.select(l.f(1.0), cosine.max(EMITTER_FLOOR));
        let emitter = self.is(flag::FLAT).select(emitter.keep_if(height.gt(0.0)), l.f(1.0));
        let in_beam = inside | self.gain.le(1.0) | (cosine + sine).ge(self.spread_cosine);
        let in_cone = inside | (sine - self.axis.dot(towards) * nearness).ge(self.cone_cosine);
        // However the beam is gathered, no more arrives than from an endless plane of the light's radiance.
        let widening = squared.max(self.gain * self.radius * self.radius).max(f32::MIN_POSITIVE);
        let from_near = (lifted(l, n, receiver) * emitter * self.gain / widening).keep_if(in_cone & in_beam);
        (self.strength * far.select(from_far, from_near)).min(1e30)
    }
}

/// A cosine at the receiver of normal `n` as far as it is trusted, 1 where there is no surface.
#[inline(always)]
pub(super) fn lifted<L: Lanes>(l: L, n: Vec3<L>, cosine: F<L>) -> F<L> {
    n.length_squared().lt(0.5).select(l.f(1.0), cosine.clamp(RECEIVER_FLOOR, 1.0))
}
