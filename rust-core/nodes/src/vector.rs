//! Operations that mix components: on vectors and on colours.

use gonio_simd::{F, Lanes, Rgb, Vec3};

/// The luminance of a linear Rec.709 colour.
#[inline(always)]
pub(crate) fn luminance<L: Lanes>([r, g, b]: [F<L>; 3]) -> F<L> {
    Rgb::new(r, g, b).luminance()
}

/// Three rows of four applied to a point.
#[inline(always)]
pub(crate) fn matrix_transform<L: Lanes>([x, y, z]: [F<L>; 3], rows: &[[f32; 4]; 3]) -> [F<L>; 3] {
    let mut out = [x; 3];
    for (row, value) in rows.iter().zip(&mut out) {
        *value = x.mul_add(row[0], y.mul_add(row[1], z * row[2])) + row[3];
    }
    out
}

/// The unit vector; zero for zero and for what is not finite.
#[inline(always)]
pub fn normalize<L: Lanes>(l: L, v: Vec3<L>) -> Vec3<L> {
    let most = v.max_abs();
    // Squares of small and large components leave the range of floats; those of components over the largest do not.
    let usable = most.gt(f32::MIN_POSITIVE * 4.0) & most.lt(f32::MAX * 0.25);
    let scaled = v * usable.select(most, l.f(1.0)).recip();
    let zero = Vec3::splat(l, [0.0; 3]);
    usable.select(scaled, zero).normalize_or(zero)
}

/// Hue in turns, saturation and value (Smith, Color Gamut Transform Pairs, 1978).
#[inline(always)]
pub(crate) fn rgb_to_hsv<L: Lanes>(l: L, [r, g, b]: [F<L>; 3]) -> [F<L>; 3] {
    let (zero, one) = (l.f(0.0), l.f(1.0));
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let spread = most - least;
    let safe = spread.eq(0.0).select(one, spread);
    let green_or_blue = g.eq(most).select((b - r) / safe + 2.0, (r - g) / safe + 4.0);
    let hue = r.eq(most).select((g - b) / safe, green_or_blue) * (1.0 / 6.0);
    let hue = spread.eq(0.0).select(zero, hue - hue.floor());
    let saturation = most.eq(0.0).select(zero, spread / most.eq(0.0).select(one, most));
    [hue, saturation, most]
}

/// The inverse of [`rgb_to_hsv`].
#[inline(always)]
pub(crate) fn hsv_to_rgb<L: Lanes>(l: L, [hue, saturation, value]: [F<L>; 3]) -> [F<L>; 3] {
    let mut out = [l.f(0.0); 3];
    for (component, offset) in [0.0, 2.0 / 3.0, 1.0 / 3.0].into_iter().enumerate() {
        let turned = hue + offset;
        let pure = (((turned - turned.floor()) * 6.0 - 3.0).abs() - 1.0).saturate();
        out[component] = (pure - 1.0).mul_add(saturation, 1.0) * value;
    }
    out
}
