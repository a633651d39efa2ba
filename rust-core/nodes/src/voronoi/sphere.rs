//! Spheres around points that touch their nearest neighbours.

use super::cells::Cells;
use super::metric::squared;
use super::{Part, Shape, VoronoiTexture};
use gonio_simd::{F, Lanes};

impl VoronoiTexture {
    /// Half the distance from the nearest point to its own nearest one, as the distance.
    #[inline(always)]
    pub(super) fn sphere<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: Shape<L>) -> [F<L>; 4] {
        let zero = l.f(0.0);
        if self.part == Part::Position {
            return [zero; 4];
        }
        let count = Cells::<L, D, 3>::COUNT;
        let cells = Cells::<L, D, 3>::around(l, self.hash, at, shape.randomness);
        let (mut least, mut code) = (l.f(f32::MAX), l.u(0));
        for number in 0..count {
            let length = squared(cells.vector(l, number));
            let closer = length.lt(least);
            code = closer.select(l.u(Cells::<L, D, 3>::code(number)), code);
            least = closer.select(length, least);
        }
        let closest = cells.chosen(l, code);
        let cells = Cells::<L, D, 3>::within(l, self.hash, closest.cell, closest.within, shape.randomness);
        let mut least = l.f(f32::MAX);
        for number in 0..count {
            if number != count / 2 {
                let length = squared(cells.vector(l, number));
                least = length.lt(least).select(length, least);
            }
        }
        [zero, zero, zero, least.sqrt() * 0.5]
    }
}
