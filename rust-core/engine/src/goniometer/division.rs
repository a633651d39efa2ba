//! Which part of a range numbers lie in, on lanes and quickly: as many rays ask as are traced.

use gonio_simd::{F, Lanes, One, U};

/// Even pieces of the range for each border, each with the borders in it, and their least and greatest number in all.
const PIECES_PER_BORDER: usize = 8;
const PIECES: [usize; 2] = [512, 1 << 16];

/// A range cut at borders.
#[derive(Clone, Debug)]
pub(super) struct Division {
    /// Ascending.
    borders: Vec<f32>,
    /// Borders before each piece, and before the end.
    before: Vec<u32>,
    start: f32,
    pieces_per_unit: f32,
}

impl Division {
    /// Borders in ascending order, one or more, and the range that numbers come from.
    pub(super) fn new(borders: Vec<f32>, [start, end]: [f32; 2]) -> Self {
        let pieces = (PIECES_PER_BORDER * borders.len()).clamp(PIECES[0], PIECES[1]);
        let mut division = Self { borders, before: vec![0; pieces + 1], start, pieces_per_unit: pieces as f32 / (end - start) };
        // By the very arithmetic that looks them up.
        let at: Vec<u32> = division.borders.iter().map(|border| division.piece(One.f(*border)).to_array()[0]).collect();
        division.before = (0..=pieces as u32).map(|piece| at.partition_point(|at| *at < piece) as u32).collect();
        division
    }

    /// How many borders are not above numbers.
    #[inline(always)]
    pub(super) fn find<L: Lanes>(&self, number: F<L>) -> U<L> {
        let l = number.lanes();
        let piece = self.piece(number);
        let (mut found, end) = (l.gather_integers(&self.before, piece), l.gather_integers(&self.before, piece + 1));
        let mut left = found.lt(end);
        while left.any() {
            left &= l.gather(&self.borders, found).le(number);
            found = found.count_if(left);
            left &= found.lt(end);
        }
        found
    }

    #[inline(always)]
    fn piece<L: Lanes>(&self, number: F<L>) -> U<L> {
        let last = (self.before.len() - 2) as f32;
        ((number - self.start) * self.pieces_per_unit).max(0.0).min(last).to_i32()
    }
}

/// Numbers from 0 to 4 that grow with the angle of a direction as an angle does, without its arc tangent; 0 for no direction.
#[inline(always)]
pub(super) fn diamond_angle<L: Lanes>(x: F<L>, y: F<L>) -> F<L> {
    let all = x.abs() + y.abs();
    let share = (y / all).keep_if(all.gt(0.0));
    let turned = x.lt(0.0).select(2.0 - share, share);
    (y.lt(0.0).and_not(x.lt(0.0))).select(share + 4.0, turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_as_by_a_search() {
        for borders in [vec![-1.0, -0.999_999, -0.99, 0.0, 0.2, 1.0], (0..3000).map(|i| -(i as f32 * 0.001).cos()).collect()] {
            let division = Division::new(borders.clone(), [-1.0, 1.0]);
            for number in (0..=2000).map(|i| i as f32 * 0.001 - 1.0).chain(borders.iter().copied()) {
                let found = division.find(One.f(number)).to_array()[0];
                assert_eq!(found as usize, borders.partition_point(|border| *border <= number), "{number}");
            }
        }
    }

    #[test]
    fn diamond_angles_grow_with_angles() {
        let diamond = |x: f32, y: f32| diamond_angle(One.f(x), One.f(y)).to_array()[0];
        let angles: Vec<f32> = (0..3600).map(|i| (i as f32 * 0.1).to_radians()).map(|a| diamond(a.cos(), a.sin())).collect();
        assert!(angles.windows(2).all(|pair| pair[0] < pair[1]) && angles[0] == 0.0 && angles[3599] < 4.0);
        assert_eq!(diamond(0.0, 0.0), 0.0);
    }
}
