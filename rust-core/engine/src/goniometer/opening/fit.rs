//! The shape in a file whose projected areas come nearest to what is seen.

use gonio_formats::photometry::{Opening, OpeningShape, PhotometricType};
use std::f64::consts::FRAC_PI_4;

/// γ in degrees at which the sides are looked at: rooms' luminaires are seen under these.
const GAMMAS: [f64; 3] = [45.0, 65.0, 80.0];
/// The one of them at which sides' heights are taken: from here a box has the area that is seen.
const MIDDLE: usize = 1;
/// From below, from above, and from four sides at each γ.
pub(super) const DIRECTIONS: usize = 2 + 4 * GAMMAS.len();
/// Share by which areas may be missed: counts of places are no better.
const NEAR: f64 = 0.03;
/// Extents that differ by less are equal.
const EQUAL: f64 = 0.02;
/// Share of what is seen from above below which what is seen from below is none.
const UP: f64 = 0.05;
/// Share of the largest area below which areas are alike.
const FAINT: f64 = 0.02;

/// Luminous square metres that directions see.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Seen {
    pub(super) areas: [f64; DIRECTIONS],
}

impl Seen {
    pub(super) fn sum(all: impl Iterator<Item = Self>) -> Self {
        all.fold(Self::default(), |sum, one| Self { areas: std::array::from_fn(|i| sum.areas[i] + one.areas[i]) })
    }

    /// Whether it shines up alone, or nearly so.
    pub(super) fn looks_up(&self) -> bool {
        self.areas[0] < UP * self.areas[1]
    }

    /// From below, where eyes are, or from above of what shines up alone.
    pub(super) fn floor(&self) -> f64 {
        self.areas[usize::from(self.looks_up())]
    }

    /// From a side, C0, C90, C180 and C270, at a γ of [`GAMMAS`].
    fn side(&self, side: usize, gamma: usize) -> f64 {
        self.areas[2 + 4 * gamma + side]
    }

    /// How far a shape's areas are from these: the root of the mean square of their ratios' logarithms.
    fn distance(&self, shape: &Opening) -> f64 {
        let faint = FAINT * self.areas.iter().copied().fold(0.0, f64::max);
        let misses = directions().into_iter().zip(self.areas).enumerate().filter(|(i, _)| *i != 1);
        let squares = misses.map(|(_, (direction, area))| (shape.projected_area(direction).max(faint) / area.max(faint)).ln().powi(2));
        (squares.sum::<f64>() / (DIRECTIONS - 1) as f64).sqrt()
    }
}

/// The directions that are looked from, in the luminaire's frame.
pub(super) fn directions() -> [[f64; 3]; DIRECTIONS] {
    std::array::from_fn(|i| match i {
        0 => [0.0, 0.0, -1.0],
        1 => [0.0, 0.0, 1.0],
        _ => PhotometricType::C.direction(90.0 * ((i - 2) % 4) as f64, GAMMAS[(i - 2) / 4]),
    })
}

/// The opening of a box of such a size, whether it is an ellipse from below, and what directions see.
pub(super) fn file_opening(size: [f64; 3], elliptic: bool, seen: &Seen) -> Opening {
    let [x, y, z] = size;
    let even = 0.5 * (x + y);
    let [x, y] = if (x - y).abs() <= EQUAL * even { [even; 2] } else { [x, y] };
    let filled = |share: f64| {
        let ratio = if x * y > 0.0 { seen.floor() / (share * x * y) } else { 1.0 };
        // What is seen from the sides alone keeps its extents.
        let factor = if ratio <= 0.0 || (ratio - 1.0).abs() < NEAR { 1.0 } else { ratio.sqrt() };
        [x * factor, y * factor]
    };
    let (square, round) = (filled(1.0), filled(FRAC_PI_4));
    let about = heights(round, seen);
    let mean = about.iter().sum::<f64>() / 4.0;
    let with = |shape: OpeningShape, [a, b]: [f64; 2], c: f64, heights: [f64; 4]| Opening { shape, size: [a, b, c], heights };
    let mut shapes = Vec::new();
    if elliptic && are_alike(about, round) {
        shapes.push(with(OpeningShape::Disk, round, 0.0, [0.0; 4]));
        shapes.push(with(OpeningShape::VerticalCylinder, round, mean, [mean; 4]));
        shapes.push(with(OpeningShape::Ellipsoid, [x, y], z, [mean; 4]));
    } else {
        let heights = heights(square, seen);
        shapes.push(with(OpeningShape::Rectangle, square, 0.0, [0.0; 4]));
        shapes.push(with(OpeningShape::Box, square, heights.iter().copied().fold(0.0, f64::max), heights));
        shapes.push(with(OpeningShape::CylinderAlongX, [x, y], z, heights));
        shapes.push(with(OpeningShape::CylinderAlongY, [x, y], z, heights));
    }
    // The plainer one unless another is nearer by more than chance.
    let nearer = |a: Opening, b: Opening| if seen.distance(&b) + NEAR < seen.distance(&a) { b } else { a };
    shapes.into_iter().reduce(nearer).unwrap_or_default()
}

/// Heights of the sides towards C0, C90, C180 and C270 with which a box has the areas that are seen.
fn heights([a, b]: [f64; 2], seen: &Seen) -> [f64; 4] {
    let (sin, cos) = GAMMAS[MIDDLE].to_radians().sin_cos();
    std::array::from_fn(|side| {
        let width = if side % 2 == 0 { b } else { a };
        let (of_floor, area) = (seen.areas[0] * cos, seen.side(side, MIDDLE));
        let more = area - of_floor;
        if more <= NEAR * of_floor || width <= 0.0 { 0.0 } else { more / (width * sin) }
    })
}

/// Whether all sides are as high.
fn are_alike(heights: [f64; 4], [a, b]: [f64; 2]) -> bool {
    let [least, most] = heights.iter().fold([f64::INFINITY, 0.0_f64], |[low, high], x| [low.min(*x), high.max(*x)]);
    most - least <= 0.1 * a.max(b)
}
