//! Tables of colours, some cells of which may be unknown.

use super::{Axis, Place};
use gonio_simd::{F, Lanes, Rgb};

/// Weights of known cells that are less than that together are an angle's rounding, not a neighbourhood.
const LEAST_WEIGHT: f32 = 1e-6;

/// One colour for each combination of knots of `N` axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Colours<const N: usize> {
    axes: [Axis; N],
    /// Values between neighbouring knots of each axis; 0 on axes of one knot.
    strides: [u32; N],
    /// Red, green, blue and 1 for each cell, the last axis fastest; four zeros where nothing is known, and behind the last cell. One load brings
    /// a cell and the next.
    cells: Vec<f32>,
    has_gaps: bool,
}

impl<const N: usize> Colours<N> {
    /// The table of `colour` at each combination of knots, counted with the last axis fastest and without the repetitions of periodic axes;
    /// `None` stands for an unknown cell. `None` if there are 2³¹ values or more.
    pub fn new(axes: [Axis; N], colour: impl Fn(usize) -> Option<[f32; 3]>) -> Option<Self> {
        let mut strides = [0; N];
        let mut count = 1_usize;
        for (axis, stride) in axes.iter().zip(&mut strides).rev() {
            *stride = if axis.len() > 1 { u32::try_from(count.checked_mul(4)?).ok()? } else { 0 };
            count = count.checked_mul(axis.len())?;
        }
        i32::try_from(count.checked_add(1)?.checked_mul(4)?).ok()?;
        let mut cells = Vec::with_capacity(4 * count);
        let mut has_gaps = false;
        for cell in 0..count {
            let known = colour(without_repetitions(&axes, cell));
            has_gaps |= known.is_none();
            cells.extend(known.map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]));
        }
        cells.extend([0.0; 4]);
        Some(Self { axes, strides, cells, has_gaps })
    }

    /// Whether some cell is unknown.
    pub fn has_gaps(&self) -> bool {
        self.has_gaps
    }

    /// The colour at a place, multilinear between known cells, and how much of it is known: where that is 0, so is the colour.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, l: L, place: [F<L>; N]) -> (Rgb<L>, F<L>) {
        let mut places = [Place { index: l.u(0), fraction: l.f(0.0) }; N];
        let mut first = l.u(0);
        for axis in 0..N {
            places[axis] = self.axes[axis].locate(l, place[axis]);
            first += places[axis].index * self.strides[axis];
        }
        let (mut offsets, mut weights) = ([0; 8], [l.f(1.0); 8]);
        let corners = 1 << (N - 1);
        for corner in 0..corners {
            for (axis, Place { fraction, .. }) in places[..N - 1].iter().enumerate() {
                let upper = corner >> axis & 1;
                offsets[corner] += upper as u32 * self.strides[axis];
                weights[corner] *= if upper == 1 { *fraction } else { 1.0 - *fraction };
            }
        }
        let [r, g, b, one, r_next, g_next, b_next, one_next] = l.sum_octets(&self.cells, first, &offsets[..corners], &weights[..corners]);
        let along = places[N - 1].fraction;
        let sum = Rgb::new(r.lerp(r_next, along), g.lerp(g_next, along), b.lerp(b_next, along));
        if !self.has_gaps {
            return (sum, l.f(1.0));
        }
        let known = one.lerp(one_next, along);
        let enough = known.gt(LEAST_WEIGHT);
        ((sum * known.max(LEAST_WEIGHT).recip()).keep_if(enough), known.keep_if(enough))
    }
}

/// The number of a cell among those that are not repetitions.
fn without_repetitions(axes: &[Axis], mut cell: usize) -> usize {
    let (mut number, mut stride) = (0, 1);
    for axis in axes.iter().rev() {
        let own = axis.len() - usize::from(axis.repeats());
        number += cell % axis.len() % own * stride;
        cell /= axis.len();
        stride *= own;
    }
    number
}
