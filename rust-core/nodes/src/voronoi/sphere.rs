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
        let mut cells = Cells::<L, D, 3>::around(l, self.hash, at, shape.randomness);
        let mut least = l.f(0.0);
        // First around the place, then around the point found, without the point itself.
        for pass in 0..2 {
            let mut code = l.u(0);
            least = l.f(f32::MAX);
            for number in (0..count).filter(|&number| pass == 0 || number != count / 2) {
                let length = squared(cells.vector(l, number));
                let closer = length.lt(least);
                code = closer.select(l.u(Cells::<L, D, 3>::code(number)), code);
                least = closer.select(length, least);
            }
            if pass == 0 {
                let closest = cells.chosen(l, code);
                cells = Cells::within(l, self.hash, closest.cell, closest.within, shape.randomness);
            }
        }
        [zero, zero, zero, least.sqrt() * 0.5]
    }
}
