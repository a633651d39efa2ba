//! The place of a drawing on its page.

use crate::results::Results;
use gonio_formats::Canvas;

/// Width of a drawing, its margins left and right, and the height of its title and its foot, in pixels.
pub(super) const WIDTH: f64 = 900.0;
pub(super) const LEFT: f64 = 70.0;
pub(super) const RIGHT: f64 = 110.0;
pub(super) const HEAD: f64 = 46.0;
const FOOT: f64 = 34.0;
/// Pixels of a metre across: a long field is drawn stretched.
const SCALES: [f64; 2] = [10.0, 40.0];

/// Where metres come to lie on a canvas.
pub(super) struct Frame {
    pub(super) top: f64,
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    scale: [f64; 2],
}

impl Frame {
    pub(super) fn new(results: &Results, y: [f64; 2], top: f64) -> Self {
        let x = [results.field.start, results.field.start + results.field.length];
        let along = (WIDTH - LEFT - RIGHT) / (x[1] - x[0]);
        Self { top, x, y, scale: [along, along.clamp(SCALES[0], SCALES[1])] }
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [LEFT + (x - self.x[0]) * self.scale[0], self.top + HEAD + (self.y[1] - y) * self.scale[1]]
    }

    pub(super) fn height(&self) -> f64 {
        HEAD + FOOT + (self.y[1] - self.y[0]) * self.scale[1]
    }

    pub(super) fn band(&self, canvas: &mut Canvas, [low, high]: [f64; 2], colour: &str) {
        let corners = [[self.x[0], low], [self.x[1], low], [self.x[1], high], [self.x[0], high]];
        canvas.area(&corners.map(|corner| self.at(corner)), colour);
    }
}
