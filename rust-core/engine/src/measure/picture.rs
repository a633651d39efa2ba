//! A grid as a picture: false colour between the points, isolines, and the values where they were measured.

use super::GridReading;
use crate::{
    error::Result,
    output::{Canvas, FalseColour, FalseColourScale},
};
use gonio_formats::short_number;

/// Pixels of the picture's longer side, about.
const SIDE: usize = 960;
/// Pixels of a cell, at least and at most.
const CELL: [usize; 2] = [4, 96];
const INK: [u8; 4] = [0, 0, 0, 255];
const PAPER: [u8; 4] = [255, 255, 255, 160];

impl GridReading {
    /// The scale of the grid's picture: `steps` up to `max`, a round number without it, even or over `decades`; of figures of colour, whose 0 means
    /// nothing, from the least value to the greatest where no `max` is asked for.
    ///
    /// # Errors
    /// As [`FalseColourScale::new`].
    pub fn scale(&self, max: Option<f32>, steps: u32, decades: Option<f32>) -> Result<FalseColourScale> {
        FalseColourScale::of_values(&self.values(), max, steps, decades, self.measurand.is_of_colour())
    }
}

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
        if let Some((text, [width, height])) = fitting(f64::from(*value), [digits, margin], cell) {
            let middle = [index % columns * cell + cell / 2, (rows - 1 - index / columns) * cell + cell / 2];
            let corner = [middle[0] - width / 2, middle[1] - height / 2];
            canvas.shade(corner.map(|at| at - margin), [width + 2 * margin, height + 2 * margin], PAPER);
            canvas.write(&text, corner, digits, INK);
        }
    }
    canvas
}

/// A value in as many digits, of such a height and with such a margin, as a cell has room for, with its width and height; none where there is room for
/// none.
fn fitting(value: f64, [digits, margin]: [usize; 2], cell: usize) -> Option<(String, [usize; 2])> {
    let rounded = |decimals: usize| format!("{value:.decimals$e}").parse().unwrap_or(value);
    let texts = [short_number(value), short_number(rounded(1)), short_number(rounded(0)), format!("{value:.0e}")];
    let least = (value > 0.0 && value < 1.0).then(|| "<1".to_owned());
    let mut sized = texts.into_iter().chain(least).map(|text| {
        let size = Canvas::text_size(&text, digits);
        (text, size)
    });
    sized.find(|(_, [width, height])| width.max(height) + 2 * margin < cell)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_values_are_written_where_large_ones_are() {
        // A cell with room for three digits has some for any value.
        let (sizes, cell) = ([9, 1], 28);
        let text = |value: f64| fitting(value, sizes, cell).map(|(text, _)| text);
        assert_eq!(text(500.0).as_deref(), Some("500"));
        assert!(text(0.25).is_some_and(|text| text.starts_with("0.2")));
        for value in [0.0333, 0.001_234, 12.34, 0.000_123_4, 3.2e-7, 1234.0, 98_765.0] {
            let (text, [width, _]) = fitting(value, sizes, cell).unwrap_or_else(|| panic!("{value} has no text"));
            let near = text.parse::<f64>().is_ok_and(|read| (read / value - 1.0).abs() < 0.5);
            assert!(width + 2 < cell && (near || value < 1.0 && text == "<1"), "{value}: {text}");
        }
        assert_eq!(fitting(500.0, sizes, 6), None);
    }
}
