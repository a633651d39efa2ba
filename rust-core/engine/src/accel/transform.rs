//! Affine maps: 3 x 4 matrices, rows first, the last column the translation.

use super::node::{Bounds, ROUNDING_PAD};

/// `point -> rows * [point, 1]`.
pub(super) type Affine = [[f32; 4]; 3];

/// The inverse of a map, or `None` when it is singular or not finite.
pub(super) fn inverse(m: &[[f64; 4]; 3]) -> Option<[[f64; 4]; 3]> {
    let cofactor = |row: usize, column: usize| {
        let (r1, r2) = ((row + 1) % 3, (row + 2) % 3);
        let (c1, c2) = ((column + 1) % 3, (column + 2) % 3);
        m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
    };
    let determinant: f64 = (0..3).map(|column| m[0][column] * cofactor(0, column)).sum();
    if determinant == 0.0 || !determinant.is_finite() {
        return None;
    }
    let mut inverse = [[0.0; 4]; 3];
    for (row, out) in inverse.iter_mut().enumerate() {
        for (column, x) in out[..3].iter_mut().enumerate() {
            *x = cofactor(column, row) / determinant;
        }
        out[3] = -(0..3).map(|k| out[k] * m[k][3]).sum::<f64>();
    }
    inverse.iter().flatten().all(|x| x.is_finite()).then_some(inverse)
}

/// A box around the image of a box, widened by the rounding error bound.
pub(super) fn transformed_bounds(m: &[[f64; 4]; 3], bounds: &Bounds) -> Bounds {
    if bounds.is_empty() {
        return Bounds::EMPTY;
    }
    let mut image = Bounds::EMPTY;
    for (axis, row) in m.iter().enumerate() {
        let (mut low, mut high, mut terms) = (row[3], row[3], row[3].abs());
        for (k, scale) in row[..3].iter().enumerate() {
            let (a, b) = (scale * f64::from(bounds.min[k]), scale * f64::from(bounds.max[k]));
            low += a.min(b);
            high += a.max(b);
            terms += a.abs().max(b.abs());
        }
        // The map to object space is rounded to f32, so the surface moves by some units in the last place of the terms summed up here.
        let pad = f64::from(ROUNDING_PAD) * terms;
        image.min[axis] = (low - pad) as f32;
        image.max[axis] = (high + pad) as f32;
    }
    image.padded()
}

/// `rows * [point, 1]`, in the operations the packets use as well.
#[inline(always)]
pub(super) fn transform_point(m: &Affine, p: [f32; 3]) -> [f32; 3] {
    let mut out = [0.0; 3];
    for (x, row) in out.iter_mut().zip(m) {
        *x = (row[0] * p[0] + row[1] * p[1]) + (row[2] * p[2] + row[3]);
    }
    out
}

/// `rows * [direction, 0]`.
#[inline(always)]
pub(super) fn transform_direction(m: &Affine, d: [f32; 3]) -> [f32; 3] {
    let mut out = [0.0; 3];
    for (x, row) in out.iter_mut().zip(m) {
        *x = (row[0] * d[0] + row[1] * d[1]) + row[2] * d[2];
    }
    out
}
