//! What narrows a light's beam: focus and cone (UsdLux ShapingAPI), the spot's cone, and the spread of flat lights.

use super::row::{Reader, field, flag};
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// Factor on the emission towards unit `direction`; 1 for lights without shaping.
#[inline(always)]
pub(crate) fn shaping<L: Lanes>(l: L, light: &Reader<'_, L>, direction: Vec3<L>, active: M<L>) -> Rgb<L> {
    let one = Rgb::grey(l.f(1.0));
    let shaped = active & light.flag(flag::SHAPED);
    if !shaped.any() {
        return one;
    }
    let cosine = light.vector(field::AXIS).dot(direction).clamp(-1.0, 1.0);
    let narrowed = cone(l, light, cosine) * spot(l, light, direction) * spread(l, light, direction);
    let factor = focus(l, light, cosine) * narrowed;
    shaped.select(factor, one)
}

/// The tint where |cos θ|^focus is 0, white where it is 1.
#[inline(always)]
fn focus<L: Lanes>(l: L, light: &Reader<'_, L>, cosine: F<L>) -> Rgb<L> {
    let exponent = light.value(field::FOCUS);
    let focused = exponent.gt(0.0);
    let white = Rgb::grey(l.f(1.0));
    if !focused.any() {
        return white;
    }
    let base = cosine.abs();
    // 0 to a positive power is 0 whatever the logarithm of 0 is.
    let power = base.max(f32::MIN_POSITIVE).pow(exponent).keep_if(base.gt(0.0));
    let tint = light.colour(field::TINT);
    focused.select(tint.lerp(white, power), white)
}

/// 1 inside, 0 outside, smoothstep between.
#[inline(always)]
fn cone<L: Lanes>(l: L, light: &Reader<'_, L>, cosine: F<L>) -> F<L> {
    let cutoff = light.value(field::CUTOFF);
    let narrowed = cutoff.is_finite();
    if !narrowed.any() {
        return l.f(1.0);
    }
    let angle = cosine.acos();
    let start = light.value(field::SMOOTH_START);
    let t = ((angle - start) / (cutoff - start).max(f32::MIN_POSITIVE)).saturate();
    let falloff = 1.0 - t * t * (3.0 - t * 2.0);
    let inside = angle.le(start).select(l.f(1.0), falloff).keep_if(angle.le(cutoff));
    narrowed.select(inside, l.f(1.0))
}

/// The spot's cone, in directions whose x and y are shortened by its stretch.
#[inline(always)]
fn spot<L: Lanes>(l: L, light: &Reader<'_, L>, direction: Vec3<L>) -> F<L> {
    let is_spot = light.flag(flag::SPOT);
    if !is_spot.any() {
        return l.f(1.0);
    }
    let along = light.vector(field::AXIS).dot(direction);
    let (x, y) = (light.vector(field::SPOT_X).dot(direction), light.vector(field::SPOT_Y).dot(direction));
    let squared = (x * x + y * y + along * along).max(f32::MIN_POSITIVE);
    let t = ((along / squared.sqrt() - light.value(field::SPOT_COSINE)) * light.value(field::SPOT_STEEPNESS)).saturate();
    is_spot.select(t * t * (3.0 - t * 2.0), l.f(1.0))
}

/// The share of a flat light's radiance that slats before it let through, times what keeps its flux.
#[inline(always)]
fn spread<L: Lanes>(l: L, light: &Reader<'_, L>, direction: Vec3<L>) -> F<L> {
    let is_spread = light.flag(flag::SPREAD);
    if !is_spread.any() {
        return l.f(1.0);
    }
    let normal = light.vector(field::NORMAL);
    let cosine = normal.dot(direction);
    // The part across the normal keeps its digits where the beam is thin.
    let across = (direction - normal * cosine).length();
    let tangent = across / cosine.abs().max(f32::MIN_POSITIVE);
    let factor = (light.value(field::SPREAD_TANGENT) - tangent).max(0.0) * light.value(field::SPREAD_GAIN);
    is_spread.select(factor, l.f(1.0))
}
