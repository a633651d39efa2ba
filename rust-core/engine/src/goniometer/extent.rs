//! Where light leaves the luminaire: the box about all of it but a few strays, and whether it is round.

use super::frame::{Frame, dot};
use crate::{compile::Bounds, light_paths::Channels};
use std::f64::consts::FRAC_1_SQRT_2;

/// Cells of an axis.
const CELLS: usize = 1024;
/// Directions along which it is measured, in the frame: the axes, and those between x and y, which tell round from square.
const AXES: [[f64; 3]; 5] =
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0], [FRAC_1_SQRT_2, -FRAC_1_SQRT_2, 0.0]];
/// Share of the flux at each end of an axis that does not count.
const STRAY: f64 = 1e-3;
/// Extents along all directions of a round thing differ by less than this; those of a square by √2.
const ROUND: f64 = 1.1;
/// Lengths below this share of the largest are none.
const FLAT: f64 = 4e-3;

/// The luminaire's opening, in its frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Opening {
    /// Least and greatest coordinates along x, y and z, metres.
    pub bounds: [[f64; 3]; 2],
    /// Whether it is round about z.
    pub round: bool,
}

impl Opening {
    /// Length, width and height along x, y and z, metres.
    pub fn size(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.bounds[1][k] - self.bounds[0][k])
    }

    /// The middle.
    pub fn centre(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| 0.5 * (self.bounds[0][k] + self.bounds[1][k]))
    }
}

/// Axes in the world, and what of each is divided into cells.
#[derive(Clone, Debug)]
pub(super) struct ExtentAxes {
    axes: [[f64; 3]; AXES.len()],
    /// Least place and length, metres.
    ranges: [[f64; 2]; AXES.len()],
}

impl ExtentAxes {
    /// For points within the bounds, which are the frame's.
    pub(super) fn new(frame: &Frame, bounds: &Bounds) -> Self {
        let axes = AXES.map(|axis| frame.world_vector(axis));
        let range = |axis: [f64; 3]| {
            let corners =
                (0..8).map(|corner: usize| dot(axis, [0, 1, 2].map(|k| if corner >> k & 1 == 0 { bounds.min[k] } else { bounds.max[k] })));
            let [least, greatest] = corners.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            [least, greatest - least]
        };
        Self { axes, ranges: AXES.map(range) }
    }

    pub(super) fn len() -> usize {
        CELLS * AXES.len()
    }

    /// The cells of a point of the world, its distances from the frame's origin given.
    #[inline]
    pub(super) fn find(&self, from_origin: [f64; 3]) -> [usize; AXES.len()] {
        std::array::from_fn(|i| {
            let [least, length] = self.ranges[i];
            let place = (dot(self.axes[i], from_origin) - least) / length * CELLS as f64;
            // Not a number where the range has no length: the first cell.
            i * CELLS + (place.max(0.0) as usize).min(CELLS - 1)
        })
    }

    /// The opening; `flux` is what left in each cell.
    pub(super) fn opening(&self, flux: impl Fn(usize) -> Channels) -> Opening {
        let ends: Vec<[f64; 2]> = (0..AXES.len()).map(|axis| self.ends(axis, |cell| flux(cell).iter().sum())).collect();
        let length = |axis: usize| ends[axis][1] - ends[axis][0];
        let largest = (0..3).map(length).fold(0.0, f64::max);
        let mut bounds = [[0.0; 3]; 2];
        for axis in 0..3 {
            let [least, greatest] = ends[axis];
            let flat = length(axis) <= FLAT * largest;
            let middle = 0.5 * (least + greatest);
            (bounds[0][axis], bounds[1][axis]) = if flat { (middle, middle) } else { (least, greatest) };
        }
        let lengths = [0, 1, 3, 4].map(length);
        let [least, greatest] = lengths.iter().fold([f64::INFINITY, 0.0_f64], |[a, b], x| [a.min(*x), b.max(*x)]);
        Opening { bounds, round: greatest > 0.0 && greatest < ROUND * least }
    }

    /// Where along an axis light leaves.
    fn ends(&self, axis: usize, flux: impl Fn(usize) -> f64) -> [f64; 2] {
        let cells: Vec<f64> = (0..CELLS).map(|cell| flux(axis * CELLS + cell)).collect();
        let stray = STRAY * cells.iter().sum::<f64>();
        let [before, behind] = [cells_before(cells.iter(), stray), cells_before(cells.iter().rev(), stray)];
        let [least, length] = self.ranges[axis];
        // One cell is a point, and without light there is no opening.
        if before + behind + 1 >= CELLS {
            return [least + length * (before as f64 + 0.5) / CELLS as f64; 2];
        }
        [before, CELLS - behind].map(|cell| least + length * cell as f64 / CELLS as f64)
    }
}

/// Cells that hold no more than some flux together.
fn cells_before<'a>(cells: impl Iterator<Item = &'a f64>, flux: f64) -> usize {
    let sums = cells.scan(0.0, |sum, cell| {
        *sum += cell;
        Some(*sum)
    });
    sums.take_while(|sum| *sum <= flux).count().min(CELLS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The opening of points that all send alike.
    fn opening(points: impl Iterator<Item = [f64; 3]>) -> Opening {
        let bounds = Bounds { min: [-1.0, -1.0, -0.5], max: [1.0, 1.0, 0.5] };
        let axes = ExtentAxes::new(&Frame::default(), &bounds);
        let mut flux = vec![[0.0; 3]; ExtentAxes::len()];
        points.for_each(|point| axes.find(point).into_iter().for_each(|cell| flux[cell] = flux[cell].map(|sum: f64| sum + 1.0)));
        axes.opening(|cell| flux[cell])
    }

    fn grid() -> impl Iterator<Item = [f64; 2]> {
        (0..300).flat_map(|i| (0..300).map(move |j| [i, j].map(|k| (f64::from(k) + 0.5) / 150.0 - 1.0)))
    }

    #[test]
    fn disks_are_round_and_squares_are_not() {
        let disk = opening(grid().filter(|[x, y]| x * x + y * y < 0.25).map(|[x, y]| [x, y, -0.5]));
        let size = disk.size();
        assert!(disk.round && (size[0] - 1.0).abs() < 0.03 && (size[1] - 1.0).abs() < 0.03 && size[2] == 0.0, "{disk:?}");
        let square = opening(grid().map(|[x, y]| [x, y, 0.2]));
        assert!(!square.round && (square.size()[0] - 2.0).abs() < 0.02 && (square.centre()[2] - 0.2).abs() < 1e-3, "{square:?}");
    }

    #[test]
    fn a_point_has_no_size() {
        let point = opening((0..100).map(|_| [0.1, 0.2, 0.3]));
        let size = point.size();
        assert!(size == [0.0; 3] && (point.centre()[1] - 0.2).abs() < 2e-3, "{point:?}");
        assert_eq!(opening(std::iter::empty()).size(), [0.0; 3]);
    }
}
