//! A grid as a picture: false colour between the points, isolines, and the values where they were measured.

use super::GridReading;
use crate::output::{Canvas, FalseColour};
use gonio_formats::short_number;

/// Pixels of the picture's longer side, about.
const SIDE: usize = 960;
/// Pixels of a cell, at least and at most.
const CELL: [usize; 2] = [4, 96];
const INK: [u8; 4] = [0, 0, 0, 255];
const PAPER: [u8; 4] = [255, 255, 255, 160];

/// The grid seen against its normal: rows run to the right, the first row lies at the bottom. Values stand at their points where there is room.
pub fn value_picture(grid: &GridReading, style: &FalseColour) -> Canvas {
    let [columns, rows] = grid.size;
    let cell = (SIDE / columns.max(rows).max(1)).clamp(CELL[0], CELL[1]);
    let size = [columns * cell, rows * cell];
    let values = grid.values();
    let pixels: Vec<f32> =
        (0..size[0] * size[1]).map(|i| interpolated(&values, grid.size, [i % size[0], size[1] - 1 - i / size[0]], cell)).collect();
    let mut canvas = style.draw(&pixels, size);
    // A cell holds five digits; those of less than nine pixels cannot be read.
    let (digits, margin) = ((cell / 5).clamp(9, 24), (cell / 32).max(1));
    for (index, value) in values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        let text = short_number(f64::from(*value));
        let [width, height] = Canvas::text_size(&text, digits);
        if width.max(height) + 2 * margin < cell {
            let middle = [index % columns * cell + cell / 2, (rows - 1 - index / columns) * cell + cell / 2];
            let corner = [middle[0] - width / 2, middle[1] - height / 2];
            canvas.shade(corner.map(|at| at - margin), [width + 2 * margin, height + 2 * margin], PAPER);
            canvas.write(&text, corner, digits, INK);
        }
    }
    canvas
}

/// The value at a pixel counted from the first row's start, bilinear between points; that of the cell alone where a neighbour is missing.
fn interpolated(values: &[f32], [columns, rows]: [usize; 2], pixel: [usize; 2], cell: usize) -> f32 {
    let own = values[(pixel[1] / cell) * columns + pixel[0] / cell];
    let place = pixel.map(|p| (p as f32 + 0.5) / cell as f32 - 0.5);
    let low = place.map(|p| p.floor().max(0.0) as usize);
    let part = [0, 1].map(|axis| (place[axis] - low[axis] as f32).clamp(0.0, 1.0));
    let at = |x: usize, y: usize| values[(low[1] + y).min(rows - 1) * columns + (low[0] + x).min(columns - 1)];
    let row = |y: usize| at(0, y) * (1.0 - part[0]) + at(1, y) * part[0];
    let mixed = row(0) * (1.0 - part[1]) + row(1) * part[1];
    if mixed.is_nan() {
        own
    } else if own.is_nan() {
        f32::NAN
    } else {
        mixed
    }
}
