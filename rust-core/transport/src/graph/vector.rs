//! Operations that mix components: on vectors and on colours.

use super::VectorOperation;
use gonio_simd::{F, Lanes, Rgb, Vec3};

/// The first three components.
#[inline(always)]
pub(super) fn vector_of<L: Lanes>([x, y, z, _]: [F<L>; 4]) -> Vec3<L> {
    Vec3::new(x, y, z)
}

/// A vector with zero as its fourth component.
#[inline(always)]
pub(super) fn from_vector<L: Lanes>(l: L, v: Vec3<L>) -> [F<L>; 4] {
    [v.x, v.y, v.z, l.f(0.0)]
}

/// Runs an operation.
#[inline(always)]
pub(super) fn vector<L: Lanes>(l: L, operation: VectorOperation, a: [F<L>; 4], b: [F<L>; 4]) -> [F<L>; 4] {
    match operation {
        VectorOperation::Luminance => [Rgb::new(a[0], a[1], a[2]).luminance(); 4],
        VectorOperation::Dot => [vector_of(a).dot(vector_of(b)); 4],
        VectorOperation::Cross => from_vector(l, vector_of(a).cross(vector_of(b))),
        VectorOperation::Normalize => from_vector(l, normalize(l, vector_of(a))),
        VectorOperation::RgbToHsv => rgb_to_hsv(l, a),
        VectorOperation::HsvToRgb => hsv_to_rgb(l, a),
    }
}

/// The unit vector; zero for zero and for what is not finite.
#[inline(always)]
pub(super) fn normalize<L: Lanes>(l: L, v: Vec3<L>) -> Vec3<L> {
    let most = v.max_abs();
    // Squares of small and large components leave the range of floats; those of components over the largest do not.
    let usable = most.gt(f32::MIN_POSITIVE * 4.0) & most.lt(f32::MAX * 0.25);
    let scaled = v * usable.select(most, l.f(1.0)).recip();
    let zero = Vec3::splat(l, [0.0; 3]);
    usable.select(scaled, zero).normalize_or(zero)
}

/// Hue in turns, saturation and value (Smith, Color Gamut Transform Pairs, 1978); the fourth component stays.
#[inline(always)]
fn rgb_to_hsv<L: Lanes>(l: L, [r, g, b, alpha]: [F<L>; 4]) -> [F<L>; 4] {
    let (zero, one) = (l.f(0.0), l.f(1.0));
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let spread = most - least;
    let safe = spread.eq(0.0).select(one, spread);
    let green_or_blue = g.eq(most).select((b - r) / safe + 2.0, (r - g) / safe + 4.0);
    let hue = r.eq(most).select((g - b) / safe, green_or_blue) * (1.0 / 6.0);
    let hue = spread.eq(0.0).select(zero, hue - hue.floor());
    let saturation = most.eq(0.0).select(zero, spread / most.eq(0.0).select(one, most));
    [hue, saturation, most, alpha]
}

/// The inverse of [`rgb_to_hsv`].
#[inline(always)]
fn hsv_to_rgb<L: Lanes>(l: L, [hue, saturation, value, alpha]: [F<L>; 4]) -> [F<L>; 4] {
    let mut out = [l.f(0.0), l.f(0.0), l.f(0.0), alpha];
    for (component, offset) in [0.0, 2.0 / 3.0, 1.0 / 3.0].into_iter().enumerate() {
        let turned = hue + offset;
        let pure = (((turned - turned.floor()) * 6.0 - 3.0).abs() - 1.0).saturate();
        out[component] = (pure - 1.0).mul_add(saturation, 1.0) * value;
    }
    out
}
