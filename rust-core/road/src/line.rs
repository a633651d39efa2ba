//! Luminaires in their places, and what each sends where.

use crate::road::{Road, Row, Side};

/// Share of a length within which two places count as one: what stands exactly at a limit counts.
const SLACK: f64 = 1e-9;

/// Luminaires at one edge, without end in both directions.
#[derive(Clone, Debug)]
pub(crate) struct Line<'a> {
    pub(crate) row: &'a Row,
    /// Whether it stands at the left edge.
    pub(crate) left: bool,
    /// Where a luminaire is along the road.
    pub(crate) offset: f64,
    /// Where they are across the road.
    pub(crate) y: f64,
    /// The luminaire's C0, C90 and zenith in the road's frame, C90 to the carriageway.
    axes: [[f64; 3]; 3],
    /// Cosine and sine of what turns the file's front to C90.
    front: [f64; 2],
}

/// One luminaire as a point sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// From the point to the luminaire, in metres.
    pub(crate) to: [f64; 3],
    /// Its length squared.
    pub(crate) square: f64,
    /// Initial intensity in cd towards the point.
    pub(crate) intensity: f64,
}

impl<'a> Line<'a> {
    /// The lines of all rows of a road.
    pub(crate) fn all(road: &'a Road) -> Vec<Self> {
        let of_row = |row: &'a Row| -> Vec<Self> {
            let further = row.offset + row.spacing / 2.0;
            let places: &[(bool, f64)] = match row.side {
                Side::Left => &[(true, row.offset)],
                Side::Right => &[(false, row.offset)],
                Side::Opposite => &[(false, row.offset), (true, row.offset)],
                Side::Staggered => &[(false, row.offset), (true, further)],
            };
            places.iter().map(|(left, offset)| Self::new(row, *left, *offset, road.carriageway_width)).collect()
        };
        road.rows.iter().flat_map(of_row).collect()
    }

    fn new(row: &'a Row, left: bool, offset: f64, width: f64) -> Self {
        let y = if left { width - row.overhang } else { row.overhang };
        // The luminaire was measured at a tilt of its own, which a tilt on the road is counted from (EN 13201-3, tilt during measurement).
        let [up, level] = sin_cos(row.tilt - row.goniogram.stated.measurement_tilt);
        let [sin, cos] = sin_cos(row.orientation + if left { 180.0 } else { 0.0 });
        let axes = [[cos, sin, 0.0], [-sin * level, cos * level, up], [sin * up, -cos * up, level]];
        let [front_sin, front_cos] = sin_cos(row.front - 90.0);
        Self { row, left, offset, y, axes, front: [front_cos, front_sin] }
    }

    /// Where luminaires are along the road from one place to another, both included.
    pub(crate) fn between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> + use<> {
        let (spacing, offset) = (self.row.spacing, self.offset);
        let first = ((from - offset) / spacing - SLACK).ceil() as i64;
        let last = ((to - offset) / spacing + SLACK).floor() as i64;
        (first..=last).map(move |index| offset + index as f64 * spacing)
    }

    /// The luminaire at a place along the road, as a point sees it.
    pub(crate) fn ray(&self, x: f64, point: [f64; 3]) -> Ray {
        let to = [x - point[0], self.y - point[1], self.row.height - point[2]];
        Ray { to, square: dot(to, to), intensity: self.intensity(to.map(|part| -part)) }
    }

    /// Initial intensity in cd in a direction of the road's frame, of any length.
    fn intensity(&self, direction: [f64; 3]) -> f64 {
        let [along, across, up] = self.axes.map(|axis| dot(axis, direction));
        let [cos, sin] = self.front;
        self.row.goniogram.intensity([along * cos - across * sin, along * sin + across * cos, up])
    }
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Sine and cosine of degrees, without rounding at right angles.
pub(crate) fn sin_cos(degrees: f64) -> [f64; 2] {
    let turn = degrees.rem_euclid(360.0);
    match turn {
        0.0 => [0.0, 1.0],
        90.0 => [1.0, 0.0],
        180.0 => [0.0, -1.0],
        270.0 => [-1.0, 0.0],
        _ => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [sin, cos]
        }
    }
}
