//! Which part of a range a number lies in, quickly: as many rays ask as are traced.

/// Even pieces of the range, each with the borders in it.
const PIECES: usize = 512;

/// A range cut at borders.
#[derive(Clone, Debug)]
pub(super) struct Division {
    /// Ascending.
    borders: Vec<f64>,
    /// Borders before each piece, and before the end.
    before: Vec<u32>,
    start: f64,
    pieces_per_unit: f64,
}

impl Division {
    /// Borders in ascending order, and the range that numbers come from.
    pub(super) fn new(borders: Vec<f64>, [start, end]: [f64; 2]) -> Self {
        let mut division = Self { borders, before: Vec::new(), start, pieces_per_unit: PIECES as f64 / (end - start) };
        // By the very arithmetic that looks them up.
        let pieces: Vec<usize> = division.borders.iter().map(|border| division.piece(*border)).collect();
        division.before = (0..=PIECES).map(|piece| pieces.partition_point(|at| *at < piece) as u32).collect();
        division
    }

    /// How many borders are not above a number.
    #[inline]
    pub(super) fn find(&self, number: f64) -> usize {
        let piece = self.piece(number);
        let [first, last] = [self.before[piece] as usize, self.before[piece + 1] as usize];
        let above = self.borders[first..last].iter().take_while(|border| **border <= number);
        first + if last - first > MANY { self.borders[first..last].partition_point(|border| *border <= number) } else { above.count() }
    }

    #[inline]
    fn piece(&self, number: f64) -> usize {
        (((number - self.start) * self.pieces_per_unit) as usize).min(PIECES - 1)
    }
}

/// More borders than this in a piece are not looked through one by one.
const MANY: usize = 4;

/// A number from 0 to 4 that grows with the angle of a direction as an angle does, without its arc tangent; 0 for no direction.
#[inline]
pub(super) fn diamond_angle(x: f64, y: f64) -> f64 {
    let all = x.abs() + y.abs();
    if all == 0.0 {
        return 0.0;
    }
    let share = y / all;
    match (x >= 0.0, y >= 0.0) {
        (true, true) => share,
        (false, _) => 2.0 - share,
        (true, false) => 4.0 + share,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_as_by_a_search() {
        for borders in [vec![-1.0, -0.999_999, -0.99, 0.0, 0.2, 1.0], (0..3000).map(|i| -(f64::from(i) * 0.001).cos()).collect()] {
            let division = Division::new(borders.clone(), [-1.0, 1.0]);
            for number in (0..=2000).map(|i| f64::from(i) * 0.001 - 1.0).chain(borders.iter().copied()) {
                assert_eq!(division.find(number), borders.partition_point(|border| *border <= number), "{number}");
            }
        }
    }

    #[test]
    fn diamond_angles_grow_with_angles() {
        let angles: Vec<f64> = (0..3600).map(|i| (f64::from(i) * 0.1).to_radians()).map(|a| diamond_angle(a.cos(), a.sin())).collect();
        assert!(angles.windows(2).all(|pair| pair[0] < pair[1]) && angles[0] == 0.0 && angles[3599] < 4.0);
        assert_eq!(diamond_angle(0.0, 0.0), 0.0);
    }
}
