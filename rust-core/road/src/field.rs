//! Where is calculated.

use crate::{line::Line, results::Field, road::Road};

/// Points along a field that is not longer than [`LONG`], and the greatest distance of points on a longer one, in metres.
const POINTS: usize = 10;
const LONG: f64 = 30.0;
const STEP: f64 = 3.0;

/// Points across a lane, a strip or a path, at least.
const ACROSS: usize = 3;
/// The greatest distance of points of illuminance across, in metres.
const STEP_ACROSS: f64 = 1.5;

/// Rounding of lengths that are whole numbers of steps.
const SLACK: f64 = 1e-9;

/// The part of the road between two luminaires of the row whose spacing is the greatest.
pub(crate) fn field(road: &Road, lines: &[Line<'_>]) -> Field {
    let longest = lines.iter().fold(None::<&Line<'_>>, |best, line| match best {
        Some(best) if best.row.spacing >= line.row.spacing => Some(best),
        _ => Some(line),
    });
    let (start, length, height) = longest.map_or((0.0, 1.0, 2.0), |line| (line.offset, line.row.spacing, line.row.height));
    let along = if length <= LONG { POINTS } else { (length / STEP - SLACK).ceil() as usize };
    Field { start, length, height, along, across: ACROSS * road.lanes as usize }
}

impl Field {
    /// Distance of points along the road.
    pub fn step(&self) -> f64 {
        self.length / self.along as f64
    }

    /// Where points are along the road.
    pub fn xs(&self) -> Vec<f64> {
        (0..self.along).map(|index| self.start + (index as f64 + 0.5) * self.step()).collect()
    }
}

/// Middles of `count` equal parts from one place to another.
pub(crate) fn middles([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    let step = (to - from) / count as f64;
    (0..count).map(|index| from + (index as f64 + 0.5) * step).collect()
}

/// Where points of illuminance are across an area: three at least, at most 1.5 m apart.
pub(crate) fn across(range: [f64; 2]) -> Vec<f64> {
    let count = ((range[1] - range[0]) / STEP_ACROSS - SLACK).ceil() as usize;
    middles(range, count.max(ACROSS))
}

/// Where points are across a strip at an edge.
pub(crate) fn across_strip(range: [f64; 2]) -> Vec<f64> {
    middles(range, ACROSS)
}
