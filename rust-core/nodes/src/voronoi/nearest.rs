//! The nearest and the second nearest point.

use super::cells::Cells;
use super::octaves::{Octave, by_part};
use super::{Feature, Shape, VoronoiTexture, metric};
use gonio_simd::{F, Lanes};

impl VoronoiTexture {
    /// The nearest point, or the second nearest, among the 3^D cells around.
    #[inline(always)]
    pub(super) fn nearest<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: &Shape<L>) -> Octave<L> {
        let cells = Cells::<L, D, 3>::around(l, self.hash, at, shape.randomness);
        let metric = metric::of_dimensions(self.metric, D);
        let second = self.feature == Feature::F2;
        let (mut least, mut code) = (l.f(f32::MAX), l.u(Cells::<L, D, 3>::code(Cells::<L, D, 3>::COUNT / 2)));
        let (mut next, mut next_code) = (least, code);
        for number in 0..Cells::<L, D, 3>::COUNT {
            let measure = metric::measure(metric, cells.vector(l, number), shape.exponent);
            let own = l.u(Cells::<L, D, 3>::code(number));
            let closer = measure.lt(least);
            if second {
                let between = measure.lt(next);
                next_code = closer.select(code, between.select(own, next_code));
                next = closer.select(least, between.select(measure, next));
            }
            code = closer.select(own, code);
            least = closer.select(measure, least);
        }
        let (measure, code) = if second { (next, next_code) } else { (least, code) };
        let point = cells.chosen(l, code);
        by_part(l, self.part, metric::length(metric, measure, shape.exponent), point.color, point.place)
    }
}
