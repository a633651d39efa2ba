//! A figure beside its limit, drawn.

use crate::{bound::Bound, requirement::Requirement, sheet::Reached};

/// Width and height.
const SIZE: [f64; 2] = [160.0, 20.0];
/// Where the ends of what is shown lie, of the width.
const ENDS: [f64; 2] = [0.08, 0.92];
/// The least half width of what is shown, of the limit or the figure.
const LEAST: f64 = 0.05;

/// The limit as a line, the side that keeps it shaded, the figure as a dot with two standard errors to each side.
pub(super) fn gauge(reached: &Reached, requirement: &Requirement) -> String {
    let [low, high] = reached.interval;
    let limit = requirement.limit;
    let middle = 0.5 * (low.min(limit) + high.max(limit));
    let half = (0.5 * (high.max(limit) - low.min(limit))).max(LEAST * limit.abs().max(reached.value.abs())).max(f64::MIN_POSITIVE);
    let [width, height] = SIZE;
    let at = |value: f64| width * (ENDS[0] + (ENDS[1] - ENDS[0]) * (0.5 + 0.5 * (value - middle) / half)).clamp(0.0, 1.0);
    let (edge, line) = (at(limit), 0.5 * height);
    let (start, long) = match requirement.bound {
        Bound::AtLeast => (edge, width - edge),
        Bound::AtMost => (0.0, edge),
    };
    format!(
        "<svg class=\"gauge\" viewBox=\"0 0 {width} {height}\" preserveAspectRatio=\"xMinYMid\" aria-hidden=\"true\">\
         <rect class=\"kept\" x=\"{start:.1}\" y=\"4\" width=\"{long:.1}\" height=\"12\"/>\
         <line class=\"limit\" x1=\"{edge:.1}\" x2=\"{edge:.1}\" y1=\"1\" y2=\"19\" stroke-width=\"1.5\"/>\
         <line x1=\"{:.1}\" x2=\"{:.1}\" y1=\"{line}\" y2=\"{line}\" stroke=\"currentColor\" stroke-width=\"3\"/>\
         <circle cx=\"{:.1}\" cy=\"{line}\" r=\"4\" fill=\"currentColor\"/></svg>",
        at(low),
        at(high),
        at(reached.value)
    )
}
