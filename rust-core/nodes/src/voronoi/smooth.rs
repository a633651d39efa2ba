//! The nearest point with a smooth minimum.

use super::cells::Cells;
use super::octaves::{Octave, by_part};
use super::{Metric, Part, Shape, VoronoiTexture, metric};
use gonio_simd::{F, Lanes};

impl VoronoiTexture {
    /// The smooth minimum over the 5^D cells around; it depends on their order. `smoothness` is not zero.
    #[inline(always)]
    pub(super) fn smooth<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: &Shape<L>) -> Octave<L> {
        let cells = Cells::<L, D, 5>::around(l, self.hash, at, shape.randomness);
        let gaps = Gaps::new(l, self.metric, &cells, shape);
        let metric = metric::of_dimensions(self.metric, D);
        let width = shape.smoothness;
        let half_slope = 0.5 / width;
        let damping = 1.0 / width.mul_add(3.0, 1.0);
        let (mut distance, mut color, mut vector) = (l.f(0.0), [l.f(0.0); 3], [l.f(0.0); D]);
        for number in 0..Cells::<L, D, 5>::COUNT {
            // Points too far to have a share are told by their cells alone.
            if number > 0 && !gaps.at(number).lt(distance + width).any() {
                continue;
            }
            let (to_point, of_point) = cells.vector_and_color(l, number);
            let length = metric::length(metric, metric::measure(metric, to_point, shape.exponent), shape.exponent);
            let mut share = l.f(1.0);
            if number > 0 {
                let t = (distance - length).mul_add(half_slope, 0.5).saturate();
                share = t * t * t.mul_add(-2.0, 3.0);
            }
            if !share.gt(0.0).any() {
                continue;
            }
            let correction = width * share * (1.0 - share);
            distance = distance.lerp(length, share) - correction;
            let correction = correction * damping;
            match self.part {
                Part::ColorDistance => {
                    for channel in 0..3 {
                        color[channel] = color[channel].lerp(of_point[channel], share) - correction;
                    }
                }
                Part::Position => {
                    for axis in 0..D {
                        vector[axis] = vector[axis].lerp(to_point[axis], share) - correction;
                    }
                }
            }
        }
        by_part(l, self.part, distance, color, cells.place(vector))
    }
}

/// How far along each axis the cells lie away: no metric makes less of a vector than its largest component.
#[derive(Clone, Copy, Debug)]
struct Gaps<L: Lanes, const D: usize>([[F<L>; 5]; D]);

impl<L: Lanes, const D: usize> Gaps<L, D> {
    #[inline(always)]
    fn new(l: L, metric: Metric, cells: &Cells<L, D, 5>, shape: &Shape<L>) -> Self {
        // Save for negative exponents, which make less of it than of the smallest.
        let none = l.m(metric == Metric::Minkowski) & !shape.exponent.gt(0.0);
        let mut gaps = [[l.f(0.0); 5]; D];
        for (axis, gaps) in gaps.iter_mut().enumerate() {
            for (digit, gap) in gaps.iter_mut().enumerate() {
                let low = cells.low(axis, digit);
                *gap = none.select(l.f(0.0), low.max(-(low + shape.randomness)));
            }
        }
        Self(gaps)
    }
    #[inline(always)]
    fn at(&self, number: usize) -> F<L> {
        let digits = Cells::<L, D, 5>::digits(number);
        let mut gap = self.0[0][digits[0]];
        for (gaps, &digit) in self.0[1..].iter().zip(&digits[1..]) {
            gap = gap.max(gaps[digit]);
        }
        gap
    }
}
