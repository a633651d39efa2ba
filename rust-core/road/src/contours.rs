//! Lines of equal value over a rectangle.

/// Values at the crossings of equally spaced lines.
#[derive(Clone, Debug)]
pub(crate) struct Sampled {
    /// Where the columns are.
    pub(crate) xs: Vec<f64>,
    /// Where the rows are.
    pub(crate) ys: Vec<f64>,
    /// Values by row and column.
    pub(crate) values: Vec<Vec<f64>>,
}

/// A piece of a line: its ends.
pub(crate) type Piece = [[f64; 2]; 2];

/// How many levels are wanted, about.
const LEVELS: f64 = 7.0;

impl Sampled {
    /// Samples a function.
    pub(crate) fn new(xs: Vec<f64>, ys: Vec<f64>, value: impl Fn([f64; 2]) -> f64) -> Self {
        let values = ys.iter().map(|y| xs.iter().map(|x| value([*x, *y])).collect()).collect();
        Self { xs, ys, values }
    }

    /// Round levels between the least and the greatest value.
    pub(crate) fn levels(&self) -> Vec<f64> {
        let all = self.values.iter().flatten().copied();
        let (least, greatest) = (all.clone().fold(f64::INFINITY, f64::min), all.fold(0.0, f64::max));
        if !(greatest > least && greatest.is_finite()) {
            return Vec::new();
        }
        let wanted = (greatest - least) / LEVELS;
        let power = 10.0_f64.powf(wanted.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|digit| digit * power).find(|step| *step >= wanted).unwrap_or(wanted);
        let (first, last) = ((least / step).floor() as i64 + 1, (greatest / step).ceil() as i64);
        (first..last).map(|index| index as f64 * step).collect()
    }

    /// The pieces of the lines of one level: each cell is cut into the two triangles of its diagonal, within which values are linear.
    pub(crate) fn pieces(&self, level: f64) -> Vec<Piece> {
        let mut pieces = Vec::new();
        for row in 1..self.ys.len() {
            for column in 1..self.xs.len() {
                let corner = |c: usize, r: usize| ([self.xs[c], self.ys[r]], self.values[r][c] - level);
                let [a, b, c, d] = [corner(column - 1, row - 1), corner(column, row - 1), corner(column, row), corner(column - 1, row)];
                pieces.extend([[a, b, c], [a, c, d]].into_iter().filter_map(piece));
            }
        }
        pieces
    }
}

/// Where a level crosses a triangle, whose corners have their places and how far they lie above the level.
fn piece(corners: [([f64; 2], f64); 3]) -> Option<Piece> {
    let mut ends = Vec::with_capacity(2);
    for index in 0..3 {
        let ((p, above), (q, beyond)) = (corners[index], corners[(index + 1) % 3]);
        if (above >= 0.0) != (beyond >= 0.0) {
            let t = above / (above - beyond);
            ends.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
        }
    }
    <[[f64; 2]; 2]>::try_from(ends).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_has_straight_lines_at_round_levels() {
        let axis: Vec<f64> = (0..=10).map(f64::from).collect();
        let sampled = Sampled::new(axis.clone(), axis, |[x, _]| 2.0 * x + 1.0);
        assert_eq!(sampled.levels(), [5.0, 10.0, 15.0, 20.0]);
        let pieces = sampled.pieces(10.0);
        assert_eq!(pieces.len(), 20);
        assert!(pieces.iter().flatten().all(|[x, _]| (x - 4.5).abs() < 1e-12));
    }

    #[test]
    fn what_is_even_has_no_lines() {
        let sampled = Sampled::new(vec![0.0, 1.0], vec![0.0, 1.0], |_| 3.0);
        assert!(sampled.levels().is_empty());
    }
}
