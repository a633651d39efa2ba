//! Tables of measured data on grids of any spacing: an explicit list of knots for each axis, found by a vector search, linear between them.
//!
//! The search never gathers on short axes: comparing with every knot and counting is faster (the paper's branch-free search, one step further),
//! and with sixteen lanes halving, the knots in registers.

mod axis;
mod colours;
mod distribution;

pub use axis::{Axis, Place};
pub use colours::Colours;
pub use distribution::Distribution2D;

use gonio_simd::{F, Lanes, U};

/// One value for each combination of knots of `N` axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<const N: usize> {
    axes: [Axis; N],
    /// Values between neighbouring knots of each axis; 0 on axes of one knot.
    strides: [u32; N],
    /// The last axis varies fastest; one value more, so that pairs can be read.
    values: Vec<f32>,
}

impl<const N: usize> Table<N> {
    /// Values at all knots, the last axis fastest. `None` unless there is one for each combination, and fewer than 2³¹.
    pub fn new(axes: [Axis; N], mut values: Vec<f32>) -> Option<Self> {
        let mut strides = [0; N];
        let mut count = 1_usize;
        for (axis, stride) in axes.iter().zip(&mut strides).rev() {
            *stride = if axis.len() > 1 { u32::try_from(count).ok()? } else { 0 };
            count = count.checked_mul(axis.len())?;
        }
        if count != values.len() || i32::try_from(count + 1).is_err() {
            return None;
        }
        values.push(0.0);
        Some(Self { axes, strides, values })
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis; N] {
        &self.axes
    }

    /// The value at a place, multilinear between knots and constant beyond the ends of an axis.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, l: L, place: [F<L>; N]) -> F<L> {
        let mut places = [Place { index: l.u(0), fraction: l.f(0.0) }; N];
        let mut first = l.u(0);
        for axis in 0..N {
            places[axis] = self.axes[axis].locate(l, place[axis]);
            first += places[axis].index * self.strides[axis];
        }
        let mut sum = l.f(0.0);
        for corner in 0..1_u32 << (N - 1) {
            let (mut at, mut weight) = (first, l.f(1.0));
            for (axis, Place { fraction, .. }) in places[..N - 1].iter().enumerate() {
                let upper = corner >> axis & 1;
                at += upper * self.strides[axis];
                weight *= if upper == 1 { *fraction } else { 1.0 - *fraction };
            }
            sum = self.along_last(l, at, places[N - 1].fraction).mul_add(weight, sum);
        }
        sum
    }

    /// Between two neighbours on the last axis, which one load brings.
    #[inline(always)]
    fn along_last<L: Lanes>(&self, l: L, at: U<L>, fraction: F<L>) -> F<L> {
        let [low, high] = l.gather_pairs(&self.values, at);
        if self.strides[N - 1] == 0 { low } else { low.lerp(high, fraction) }
    }
}

#[cfg(test)]
mod tests;
