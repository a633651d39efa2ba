//! A grid's values in false colour.

use crate::plan::Plan;
use gonio_page::{
    Numbers,
    colour::{colour, ink},
    escaped,
    plot::cell_text,
};

/// Most cells that are drawn.
const MOST: usize = 10_000;
/// Room for the cells, and the legend's height below them.
const ROOM: [f64; 2] = [720.0, 440.0];
const LEGEND: f64 = 52.0;
/// The greatest half width of the least point's ring.
const RING: f64 = 42.0;
/// Steps and ticks of the legend.
const STEPS: usize = 36;
const TICKS: usize = 5;

/// A plan as SVG.
pub(super) struct Drawn {
    pub(super) svg: String,
    /// How many points along a side a cell is the mean of.
    pub(super) block: usize,
}

impl Drawn {
    pub(super) fn new(plan: &Plan, numbers: Numbers) -> Self {
        let [low, high] = plan.range();
        let (coarse, block) = plan.coarser(MOST);
        let extent = [0, 1].map(|axis| coarse.size[axis] as f64 * coarse.spacing[axis]);
        let scale = (ROOM[0] / extent[0]).min(ROOM[1] / extent[1]);
        let cell = coarse.spacing.map(|length| length * scale);
        let height = extent[1] * scale;
        let share = |value: f64| if high > low { (value - low) / (high - low) } else { 0.5 };
        let mut svg = format!("<svg viewBox=\"0 0 {:.0} {:.1}\" role=\"img\" shape-rendering=\"crispEdges\">", ROOM[0], height + LEGEND);
        let corner = |index: usize| {
            let [column, row] = [index % coarse.size[0], index / coarse.size[0]];
            [column as f64 * cell[0], (coarse.size[1] - 1 - row) as f64 * cell[1]]
        };
        for (index, value) in coarse.values.iter().enumerate() {
            let [x, y] = corner(index);
            let Some(value) = *value else { continue };
            let fill = colour(share(value));
            svg.push_str(&format!("<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{fill}\"/>", cell[0], cell[1]));
            svg.push_str(&cell_text(&numbers.short(value), [x + 0.5 * cell[0], y + 0.5 * cell[1]], cell, ink(share(value))));
        }
        if let Some(index) = least(plan) {
            let [x, y] = corner(index / plan.size[0] / block * coarse.size[0] + index % plan.size[0] / block);
            svg.push_str(&ring([x + 0.5 * cell[0], y + 0.5 * cell[1]], cell));
        }
        svg.push_str(&legend([low, high], height, &plan.unit, numbers));
        svg.push_str("</svg>");
        Self { svg, block }
    }
}

/// The number of the least point.
fn least(plan: &Plan) -> Option<usize> {
    let values = plan.values.iter().enumerate().filter_map(|(index, value)| Some((index, (*value)?)));
    values.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
}

/// The least point's mark: white within black, to be seen on any colour.
fn ring([x, y]: [f64; 2], cell: [f64; 2]) -> String {
    let [rx, ry] = cell.map(|length| (0.46 * length).clamp(3.0, RING));
    let ellipse = |colour: &str, width: f64| {
        format!(
            "<ellipse cx=\"{x:.2}\" cy=\"{y:.2}\" rx=\"{rx:.2}\" ry=\"{ry:.2}\" fill=\"none\" stroke=\"{colour}\" \
             stroke-width=\"{width}\" shape-rendering=\"auto\"/>"
        )
    };
    ellipse("#000", 4.0) + &ellipse("#fff", 2.0)
}

fn legend([low, high]: [f64; 2], top: f64, unit: &str, numbers: Numbers) -> String {
    let (y, step) = (top + 12.0, 0.5 * ROOM[0] / STEPS as f64);
    let left = 30.0;
    let bar = |index: usize| {
        let fill = colour((index as f64 + 0.5) / STEPS as f64);
        format!("<rect x=\"{:.2}\" y=\"{y:.1}\" width=\"{:.2}\" height=\"10\" fill=\"{fill}\"/>", left + step * index as f64, step + 0.3)
    };
    let tick = |index: usize| {
        let share = index as f64 / (TICKS - 1) as f64;
        let sign = if index + 1 == TICKS { format!(" {unit}") } else { String::new() };
        let value = numbers.short(low + share * (high - low)) + &sign;
        let (x, y) = (left + 0.5 * ROOM[0] * share, y + 30.0);
        format!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"16\" text-anchor=\"middle\" fill=\"currentColor\">{}</text>",
            escaped(value.trim())
        )
    };
    (0..STEPS).map(bar).chain((0..TICKS).map(tick)).collect()
}
