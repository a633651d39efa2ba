//! The ratios as a bar chart in SVG.

use super::report::{Figure, Report, Row};
use std::fmt::Write;

/// Pixels from the left edge to the axis: room for the names.
const AXIS: f64 = 330.0;
/// Pixels of the longest bar.
const LONGEST: f64 = 560.0;
/// Pixels of a bar and of the gap between rows.
const BAR: f64 = 7.0;
const GAP: f64 = 6.0;
/// Pixels above the first row: title, key and the scale's numbers.
const TOP: f64 = 78.0;
/// Fills of the levels, narrow to wide (a ramp that survives grey printing).
const FILLS: [&str; 4] = ["#9ecae1", "#4292c6", "#084594", "#041f4a"];

/// A chart of all rows: a bar a level, as long as the median ratio, with a line from quartile to quartile.
pub fn plot(report: &Report) -> String {
    let height: f64 = TOP + report.rows.iter().map(row_height).sum::<f64>() + GAP;
    let most = report.rows.iter().flat_map(|row| &row.levels).map(|figure| figure.ratio.high).fold(1.0, f64::max);
    let scale = LONGEST / most;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{height}\" viewBox=\"0 0 {0} {height}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        AXIS + LONGEST + 60.0
    );
    let processor = report.machine.processor.as_deref().unwrap_or("unknown processor");
    text(
        &mut svg,
        [12.0, 20.0],
        "start",
        &format!("gonio {}, {processor}: times as fast as one lane (std: as the standard library)", report.machine.version),
    );
    key(&mut svg, report);
    grid(&mut svg, most, scale, height);
    let mut top = TOP;
    for row in &report.rows {
        bars(&mut svg, row, top, scale);
        top += row_height(row);
    }
    svg += "</svg>\n";
    svg
}

fn row_height(row: &Row) -> f64 {
    row.levels.len() as f64 * BAR + GAP
}

/// The levels' colours.
fn key(svg: &mut String, report: &Report) {
    let levels = report.rows.iter().map(|row| &row.levels).max_by_key(|levels| levels.len());
    for (place, figure) in levels.into_iter().flatten().enumerate() {
        let x = AXIS + place as f64 * 110.0;
        rectangle(svg, [x, 32.0], [12.0, 12.0], FILLS[place % FILLS.len()]);
        text(svg, [x + 18.0, 42.0], "start", &format!("{} x{}", figure.level, figure.lanes));
    }
}

/// Lines at round ratios; the one at 1 is the baseline.
fn grid(svg: &mut String, most: f64, scale: f64, height: f64) {
    let step = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0].into_iter().find(|step| most / step <= 12.0).unwrap_or(100.0);
    let lines = (0..=(most / step) as usize).map(|line| line as f64 * step);
    for ratio in lines.chain((step > 1.0).then_some(1.0)) {
        let (x, colour) = (AXIS + ratio * scale, if ratio == 1.0 { "#d62728" } else { "#dddddd" });
        line(svg, [x, TOP - 8.0], [x, height], colour);
        text(svg, [x, TOP - 12.0], "middle", &format!("{ratio}"));
    }
}

fn bars(svg: &mut String, row: &Row, top: f64, scale: f64) {
    let over = if row.baseline == "scalar" { String::new() } else { format!(" (over {})", row.baseline) };
    let middle = top + row.levels.len() as f64 * BAR * 0.5 + 4.0;
    text(svg, [AXIS - 6.0, middle], "end", &format!("{}: {}{over}", row.stage, row.name));
    for (place, Figure { ratio, .. }) in row.levels.iter().enumerate() {
        let y = top + place as f64 * BAR;
        rectangle(svg, [AXIS, y], [ratio.median * scale, BAR - 1.0], FILLS[place % FILLS.len()]);
        line(svg, [AXIS + ratio.low * scale, y + 3.0], [AXIS + ratio.high * scale, y + 3.0], "#ff7f0e");
    }
    if let Some(best) = row.levels.last() {
        text(svg, [AXIS + best.ratio.high * scale + 5.0, middle + BAR], "start", &format!("{:.1}", best.ratio.median));
    }
}

fn rectangle(svg: &mut String, [x, y]: [f64; 2], [width, height]: [f64; 2], fill: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(svg, "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{fill}\"/>");
}

fn line(svg: &mut String, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], colour: &str) {
    let _ = writeln!(svg, "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\"/>");
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, content: &str) {
    let content = content.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{content}</text>");
}
