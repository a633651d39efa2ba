//! Lines of equal value with their legend.

use super::frame::{Frame, HEAD, RIGHT, WIDTH};
use crate::contours::Sampled;
use gonio_formats::{Anchor, Canvas, short_number};

/// Samples of a map along and, at least, across; metres between those across.
const ALONG: usize = 80;
const ACROSS: usize = 13;
const STEP: f64 = 0.5;

/// Colours of lines from low to high.
const RAMP: [&str; 8] = ["#2c3e91", "#1f6fb4", "#118f9c", "#1d9a5b", "#7a9a12", "#c28a00", "#d2591c", "#b51f2e"];

/// Where a map is sampled along the road.
pub(super) fn columns(frame: &Frame) -> Vec<f64> {
    ends(frame.x, ALONG)
}

/// Where a map is sampled across the road.
pub(super) fn rows(frame: &Frame) -> Vec<f64> {
    let [low, high] = frame.y;
    ends(frame.y, (((high - low) / STEP) as usize + 1).max(ACROSS))
}

/// So many places from one end to the other.
fn ends([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|index| from + (to - from) * index as f64 / (count - 1) as f64).collect()
}

/// Lines of round levels with a legend.
pub(super) fn isolines(canvas: &mut Canvas, frame: &Frame, sampled: &Sampled, unit: &str) {
    let levels = sampled.levels();
    let colour = |index: usize| RAMP[(index * (RAMP.len() - 1)) / levels.len().saturating_sub(1).max(1)];
    for (index, level) in levels.iter().enumerate() {
        let pieces = sampled.pieces(*level);
        for [a, b] in &pieces {
            canvas.line(frame.at(*a), frame.at(*b), colour(index));
        }
        if let Some([[x, y], _]) = pieces.get(pieces.len() * (index + 1) / (levels.len() + 1)) {
            canvas.text(frame.at([*x, *y]), Anchor::Middle, &short_number(*level));
        }
        let y = frame.top + HEAD + 6.0 + 15.0 * (levels.len() - 1 - index) as f64;
        canvas.curve(&[[WIDTH - RIGHT + 12.0, y], [WIDTH - RIGHT + 34.0, y]], colour(index), "");
        canvas.text([WIDTH - RIGHT + 40.0, y + 4.0], Anchor::Start, &format!("{} {unit}", short_number(*level)));
    }
}
