//! The nearest point with a smooth minimum.

use super::cells::Cells;
use super::octaves::{Octave, by_part};
use super::{Part, Shape, VoronoiTexture, metric};
use gonio_simd::{F, Lanes};

impl VoronoiTexture {
    /// The smooth minimum over the 5^D cells around; it depends on their order. `smoothness` is not zero.
    #[inline(always)]
    pub(super) fn smooth<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: &Shape<L>) -> Octave<L> {
        let cells = Cells::<L, D, 5>::around(l, self.hash, at, shape.randomness);
        let metric = metric::of_dimensions(self.metric, D);
        let width = shape.smoothness;
        let half_slope = 0.5 / width;
        let damping = 1.0 / width.mul_add(3.0, 1.0);
        let (mut distance, mut color, mut vector) = (l.f(0.0), [l.f(0.0); 3], [l.f(0.0); D]);
        for number in 0..Cells::<L, D, 5>::COUNT {
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
