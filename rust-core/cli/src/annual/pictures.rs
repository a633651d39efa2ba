//! A grid's year in pictures: figures on the plan, and the mean of the points over days and hours.

use super::plots::Cells;
use crate::falsecolor;
use gonio::{
    Result,
    output::{Canvas, FalseColour, FalseColourScale},
};
use gonio_annual::{Grid, Point, Year};
use std::path::{Path, PathBuf};

/// Pixels of a day's side and of an hour's in the carpet plot.
const DAY: usize = 3;
const HOUR: usize = 14;
/// Pixels of the longer side of a plan, about.
const SIDE: usize = 900;
/// Steps of the scales, and decades of that of the year.
const STEPS: u32 = 10;
const DECADES: f32 = 2.0;
/// End and steps of the scale of glare: 0.35, 0.40 and 0.45 are edges.
const GLARE: f32 = 0.6;
const GLARE_STEPS: u32 = 12;
/// Pixels at the left and below for hours and months, and of their letters.
const MARGIN: [usize; 2] = [32, 28];
const LETTERS: usize = 15;
const PAPER: [u8; 4] = [24, 24, 24, 255];
const INK: [u8; 4] = [235, 235, 235, 255];

/// A figure that is drawn on the plan.
struct Drawn {
    name: &'static str,
    unit: &'static str,
    /// The scale's end; without one a round number that nearly all values stay below.
    max: Option<f32>,
    of: fn(&Point) -> Option<f64>,
}

const DRAWN: [Drawn; 3] = [
    Drawn { name: "da_300", unit: "%", max: Some(100.0), of: |point| Some(100.0 * point.da_300) },
    Drawn { name: "udi_100_3000", unit: "%", max: Some(100.0), of: |point| Some(100.0 * point.udi_100_3000) },
    Drawn { name: "hours_direct_1000", unit: "h", max: None, of: |point| point.hours_direct_1000 },
];

/// The pictures of a grid: plans, and the carpet plot.
pub(super) fn paths(folder: &Path, name: &str) -> Vec<PathBuf> {
    let plans = DRAWN.iter().map(|drawn| drawn.name);
    plans.chain(["year"]).map(|ending| folder.join(format!("{name}_{ending}.png"))).collect()
}

/// Draws a grid whose points have their places in cells; `means` are those of all points by step.
pub(super) fn draw(folder: &Path, name: &str, (grid, places): (&Grid, &Cells), year: &Year, means: &[f32]) -> Result<Vec<PathBuf>> {
    let paths = paths(folder, name);
    for (drawn, path) in DRAWN.iter().zip(&paths) {
        let of_points: Vec<Option<f64>> = grid.points.iter().map(drawn.of).collect();
        let values: Vec<f32> = places.spread(&of_points).iter().map(|value| value.map_or(f32::NAN, |value| value as f32)).collect();
        let (pixels, size) = cells(&values, places.size);
        falsecolor::write(path, &style(drawn.max, &values, drawn.unit)?.draw(&pixels, size))?;
    }
    if let Some(path) = paths.last() {
        let scale = FalseColourScale::new(FalseColourScale::round_max(means), STEPS, Some(DECADES))?;
        falsecolor::write(path, &carpet(year, means, scale, "lx"))?;
    }
    Ok(paths)
}

fn style(max: Option<f32>, values: &[f32], unit: &str) -> Result<FalseColour> {
    let max = max.unwrap_or_else(|| FalseColourScale::round_max(values));
    Ok(FalseColour { scale: FalseColourScale::new(max, STEPS, None)?, unit: unit.into(), contours: false, smoothing: 0, legend: true })
}

/// A square of pixels for each value; the first row lies at the bottom.
fn cells(values: &[f32], [columns, rows]: [usize; 2]) -> (Vec<f32>, [usize; 2]) {
    let side = (SIDE / columns.max(rows).max(1)).max(1);
    let size = [columns * side, rows * side];
    let value = |pixel: usize| values[(rows - 1 - pixel / size[0] / side) * columns + pixel % size[0] / side];
    ((0..size[0] * size[1]).map(value).collect(), size)
}

/// Draws a year of glare at an eye.
pub(super) fn glare_carpet(path: &Path, year: &Year, values: &[f32]) -> Result<()> {
    let scale = FalseColourScale::new(GLARE, GLARE_STEPS, None)?;
    falsecolor::write(path, &carpet(year, values, scale, "DGP"))
}

/// Days from left to right, hours from the bottom up, with months and hours beside them.
fn carpet(year: &Year, means: &[f32], scale: FalseColourScale, unit: &str) -> Canvas {
    let of_day = (24.0 / year.step_hours).round() as usize;
    let days = means.len() / of_day.max(1);
    let inner = [days * DAY, 24 * HOUR];
    let size = [inner[0] + MARGIN[0], inner[1] + MARGIN[1]];
    let value = |pixel: usize| {
        let (x, y) = (pixel % size[0], pixel / size[0]);
        if x < MARGIN[0] || y >= inner[1] {
            return f32::NAN;
        }
        means[(x - MARGIN[0]) / DAY * of_day + (inner[1] - 1 - y) * of_day / inner[1]]
    };
    let pixels: Vec<f32> = (0..size[0] * size[1]).map(value).collect();
    let style = FalseColour { scale, unit: unit.into(), contours: false, smoothing: 0, legend: true };
    let mut canvas = style.draw(&pixels, size);
    canvas.fill([0, 0], [MARGIN[0], size[1]], PAPER);
    canvas.fill([0, inner[1]], [size[0], MARGIN[1]], PAPER);
    for hour in [0, 6, 12, 18, 24] {
        let text = hour.to_string();
        let [width, height] = Canvas::text_size(&text, LETTERS);
        let middle = (inner[1] - hour * HOUR).clamp(height / 2, inner[1] - height / 2);
        canvas.write(&text, [MARGIN[0] - 6 - width, middle - height / 2], LETTERS, INK);
    }
    let starts = (0..days).filter(|day| year.steps[day * of_day].day == 1);
    for (day, month) in starts.zip(1..=12) {
        canvas.write(&month.to_string(), [MARGIN[0] + day * DAY + 4, inner[1] + 6], LETTERS, INK);
    }
    canvas
}
