//! The distance to the nearest edge between cells.

use super::cells::Cells;
use super::metric::{dot, squared};
use super::{Shape, VoronoiTexture};
use gonio_simd::{F, Lanes};

/// Points nearer than the root of this to the nearest one are taken for it.
const SAME_POINT: f32 = 1e-4;

impl VoronoiTexture {
    /// The distance to the nearest edge of the cell that `at` lies in.
    #[inline(always)]
    pub(super) fn edge<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: &Shape<L>) -> F<L> {
        let cells = Cells::<L, D, 3>::around(l, self.hash, at, shape.randomness);
        match D {
            1 => edge_on_line(l, &cells),
            2 => edge_among::<L, D, 9>(l, &cells),
            3 => edge_among::<L, D, 27>(l, &cells),
            _ => edge_among::<L, D, 81>(l, &cells),
        }
    }
}

/// Among `N` points, all those of the cells.
#[inline(always)]
fn edge_among<L: Lanes, const D: usize, const N: usize>(l: L, cells: &Cells<L, D, 3>) -> F<L> {
    let mut vectors = [[l.f(0.0); D]; N];
    let (mut least, mut closest) = (l.f(f32::MAX), [l.f(0.0); D]);
    for (number, vector) in vectors.iter_mut().enumerate() {
        *vector = cells.vector(l, number);
        let length = squared(*vector);
        let closer = length.lt(least);
        least = closer.select(length, least);
        for axis in 0..D {
            closest[axis] = closer.select(vector[axis], closest[axis]);
        }
    }
    // Distances are kept as square and divisor, so that the loop divides nothing.
    let (mut square, mut divisor) = (l.f(f32::MAX), l.f(1.0));
    for vector in &vectors {
        let (mut across, mut middle) = (closest, closest);
        for axis in 0..D {
            across[axis] = vector[axis] - closest[axis];
            middle[axis] = (vector[axis] + closest[axis]) * 0.5;
        }
        let along = dot(middle, across);
        let (own_square, own_divisor) = (along.squared(), squared(across));
        let closer = own_divisor.gt(SAME_POINT) & (own_square * divisor).lt(square * own_divisor);
        square = closer.select(own_square, square);
        divisor = closer.select(own_divisor, divisor);
    }
    (square / divisor).sqrt()
}

/// On a line: the nearer of the middles between the cell's own point and its two neighbours'.
#[inline(always)]
fn edge_on_line<L: Lanes, const D: usize>(l: L, cells: &Cells<L, D, 3>) -> F<L> {
    let (left, own, right) = (cells.vector(l, 0)[0], cells.vector(l, 1)[0], cells.vector(l, 2)[0]);
    ((own + left) * 0.5).abs().min(((own + right) * 0.5).abs())
}
