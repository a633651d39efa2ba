//! Affine maps.

use super::prepared::Padded;
use crate::tree::node::{Bounds, ROUNDING_PAD};
use fearless_simd::{f32x4, prelude::*};

/// `point -> x * column 0 + y * column 1 + z * column 2 + column 3`: the columns one behind the other, and a number that means nothing, so that
/// each column can be read as four.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Affine([f32; 13]);

impl Affine {
    /// The map of these rows, unless a number of it is too large.
    pub(crate) fn new(rows: &[[f64; 4]; 3]) -> Option<Self> {
        let mut numbers = [0.0; 13];
        for (axis, row) in rows.iter().enumerate() {
            for (column, x) in row.iter().enumerate() {
                numbers[3 * column + axis] = *x as f32;
            }
        }
        numbers.iter().all(|x| x.is_finite()).then_some(Affine(numbers))
    }

    /// The map of these columns, a zero behind each, unless a number of it is too large.
    #[inline(always)]
    pub(crate) fn of_columns(columns: &[[f64; 4]; 4]) -> Option<Self> {
        let mut numbers = [0.0; 13];
        for (number, column) in columns.iter().enumerate() {
            // The zero is written over by the next column.
            for k in 0..4 {
                numbers[3 * number + k] = column[k] as f32;
            }
        }
        numbers.iter().all(|x| x.is_finite()).then_some(Affine(numbers))
    }

    #[inline(always)]
    fn column(&self, column: usize) -> Padded {
        let first = 3 * column;
        [self.0[first], self.0[first + 1], self.0[first + 2], self.0[first + 3]]
    }

    /// The factors of x, y, z and one in a component of the image.
    #[inline(always)]
    pub(crate) fn row(&self, axis: usize) -> [f32; 4] {
        [self.0[axis], self.0[3 + axis], self.0[6 + axis], self.0[9 + axis]]
    }

    /// The image of a point, in the operations the packets use as well.
    #[inline(always)]
    pub(crate) fn point(&self, p: Padded) -> Padded {
        let [x, y, z, moved] = [self.column(0), self.column(1), self.column(2), self.column(3)];
        let mut out = [0.0; 4];
        for k in 0..4 {
            out[k] = (x[k] * p[0] + y[k] * p[1]) + (z[k] * p[2] + moved[k]);
        }
        out
    }

    /// The images of a point and a direction, all components at once and to the same bits.
    #[inline(always)]
    pub(crate) fn images<S: Simd>(&self, simd: S, point: &Padded, direction: &Padded) -> [f32x4<S>; 2] {
        let (x, y) = (f32x4::from_slice(simd, &self.0[..4]), f32x4::from_slice(simd, &self.0[3..7]));
        let (z, moved) = (f32x4::from_slice(simd, &self.0[6..10]), self.translation(simd));
        [(x * point[0] + y * point[1]) + (z * point[2] + moved), (x * direction[0] + y * direction[1]) + z * direction[2]]
    }

    /// The image of the origin.
    #[inline(always)]
    pub(crate) fn translation<S: Simd>(&self, simd: S) -> f32x4<S> {
        f32x4::from_slice(simd, &self.0[9..13])
    }

    /// Whether directions are their own images.
    pub(crate) fn keeps_directions(&self) -> bool {
        self.0[..9] == [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    }

    /// The image of a direction.
    #[inline(always)]
    pub(crate) fn direction(&self, d: Padded) -> Padded {
        let [x, y, z] = [self.column(0), self.column(1), self.column(2)];
        let mut out = [0.0; 4];
        for k in 0..4 {
            out[k] = (x[k] * d[0] + y[k] * d[1]) + z[k] * d[2];
        }
        out
    }
}

/// The inverse of a map given by rows, the last column the translation, or `None` when it is singular or not finite.
pub(crate) fn inverse(m: &[[f64; 4]; 3]) -> Option<[[f64; 4]; 3]> {
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

/// The image of a point, rounded once.
pub(crate) fn image_of(m: &[[f64; 4]; 3], point: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = point.map(f64::from);
    m.map(|row| (row[0] * x + row[1] * y + row[2] * z + row[3]) as f32)
}

/// A box around the image of a box, widened by the rounding error bound.
pub(crate) fn transformed_bounds(m: &[[f64; 4]; 3], bounds: &Bounds) -> Bounds {
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
