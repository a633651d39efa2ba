//! What the light sampler knows of one light, and its importance at a point: about the illuminance that it brings there.
//!
//! pbrt calls it `LightBounds` as well (Physically Based Rendering, 4th edition, section 12.6.3).

use super::light_kind::LightKind;
use super::row::{Reader, field, flag};
use super::way::LightWay;
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

    /// Importance for a whole way: about the illuminance integrated along it, zero only where none of the light can arrive.
    #[inline(always)]
    pub(super) fn importance_along(&self, l: L, way: &LightWay<L>) -> F<L> {
        let (_, [from, to]) = self.reached(l, way);
        let far = self.is(flag::INFINITE);
        let part = LightWay { origin: way.place(from), length: (to - from).max(0.0), ..*way };
        let near = self.gain * part.seen_from(self.centre, self.radius).nearness();
        (self.strength * far.select(part.length.min(way.open), near)).min(1e30).keep_if(to.gt(from))
    }

    /// The light's middle, and the metres of a way between which its light may arrive.
    #[inline(always)]
    pub(super) fn reached(&self, l: L, way: &LightWay<L>) -> (Vec3<L>, [F<L>; 2]) {
        let (mut from, mut to) = (l.f(0.0), way.length);
        let near = !self.is(flag::INFINITE);
        // Flat lights shine to one side.
        let flat = near & self.is(flag::FLAT) & !self.is(flag::TWO_SIDED);
        if flat.any() {
            let rise = self.normal.dot(way.direction);
            let height = self.normal.dot(way.origin - self.centre);
            let crossing = -height / rise.abs().max(1e-12).copysign(rise);
            from = (flat & rise.gt(0.0)).select(from.max(crossing), from);
            to = (flat & rise.lt(0.0)).select(to.min(crossing), to);
            to = (flat & rise.eq(0.0) & height.lt(0.0)).select(from, to);
        }
        // A cone about the axis; one with its apex behind holds what the light's extent adds.
        let coned = near & self.cone_cosine.gt(LEAST_CONE);
        if coned.any() {
            let cosine = self.cone_cosine.clamp(LEAST_CONE, 1.0) * (1.0 - 1e-5);
            let sine = (1.0 - cosine * cosine).safe_sqrt();
            let apex = self.centre - self.axis * ((self.radius + 1e-4) / sine.max(1e-4));
            let [first, last] = within_cone(way, apex, self.axis, cosine);
            from = coned.select(from.max(first), from);
            to = coned.select(to.min(last), to);
        }
        (near.select(self.centre, Vec3::splat(l, [1e20; 3])), [from, to])
    }
}

/// Cones are narrower than half of space from this cosine on.
const LEAST_CONE: f32 = 0.05;

/// Between which metres of a way it is within a cone; the second is the smaller where it is not.
#[inline(always)]
fn within_cone<L: Lanes>(way: &LightWay<L>, apex: Vec3<L>, axis: Vec3<L>, cosine: F<L>) -> [F<L>; 2] {
    let l = cosine.lanes();
    let to = way.origin - apex;
    let (along, begun, squared) = (axis.dot(way.direction), axis.dot(to), cosine * cosine);
    let a = along * along - squared;
    let b = along * begun - squared * to.dot(way.direction);
    let c = begun * begun - squared * to.length_squared();
    let discriminant = b * b - a * c;
    let root = discriminant.safe_sqrt();
    let safe = a.abs().max(1e-12).copysign(a);
    let [one, other] = [(-b - root) / safe, (-b + root) / safe];
    let (low, high) = (one.min(other), one.max(other));
    let (none, whole) = ([l.f(1.0), l.f(0.0)], [l.f(f32::MIN), l.f(f32::MAX)]);
    // Steeper than the cone, a way crosses it between the roots, in this half or in the other; else it stays in from a root on.
    let crosses = a.lt(0.0);
    let ahead = along.mul_add((low + high) * 0.5, begun).gt(0.0);
    let met = discriminant.gt(0.0);
    let inward = along.gt(0.0);
    let first = crosses.select((met & ahead).select(low, none[0]), inward.select(high, whole[0]));
    let last = crosses.select((met & ahead).select(high, none[1]), inward.select(whole[1], low));
    [first, last]
}

/// A cosine at the receiver of normal `n` as far as it is trusted, 1 where there is no surface.
#[inline(always)]
pub(super) fn lifted<L: Lanes>(l: L, n: Vec3<L>, cosine: F<L>) -> F<L> {
    n.length_squared().lt(0.5).select(l.f(1.0), cosine.clamp(RECEIVER_FLOOR, 1.0))
}
