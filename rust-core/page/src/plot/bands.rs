//! Shares of a whole at many points, one above the other.

use super::{
    Head,
    axis::ticks,
    drawing::{Anchor, Drawing, Ink, LETTERS, LINE},
};
use crate::Numbers;
use std::fmt::Write;

/// Room for the points and their shares.
const ROOM: [f64; 2] = [500.0, 240.0];
/// Room for per cents at the left, and for the points below.
const LEFT: f64 = 46.0;
const BELOW: f64 = 46.0;
/// Steps of the axis of points at most.
const STEPS: usize = 10;

/// A band of values.
#[derive(Clone, Debug)]
pub struct Band {
    /// What it is.
    pub name: String,
    /// Its colour, as `#rrggbb`.
    pub colour: &'static str,
    /// By point its share, 0 to 1.
    pub shares: Vec<f64>,
}

/// Bands from the bottom up, whose shares are 1 together.
#[derive(Clone, Debug)]
pub struct Bands {
    /// Title and what else is to be said.
    pub head: Head,
    /// From the bottom up.
    pub bands: Vec<Band>,
    /// What stands below the points.
    pub points: String,
}

impl Bands {
    /// The plot.
    pub fn svg(&self, numbers: Numbers) -> String {
        let count = self.bands.first().map_or(0, |band| band.shares.len()).max(1);
        let one = ROOM[0] / count as f64;
        let mut drawing = Drawing::new();
        let mut below = vec![0.0; count];
        for band in &self.bands {
            let mut path = String::new();
            for (point, (share, below)) in band.shares.iter().zip(&mut below).enumerate() {
                // Writing to a string cannot fail.
                let _ = write!(
                    path,
                    "M{:.2} {:.2}h{one:.2}v{:.2}h-{one:.2}z",
                    LEFT + one * point as f64,
                    ROOM[1] * (1.0 - *below),
                    -ROOM[1] * share
                );
                *below += share;
            }
            drawing.add(format_args!("<path fill=\"{}\" shape-rendering=\"crispEdges\" d=\"{path}\"/>", band.colour));
        }
        axes(&mut drawing, count, one);
        drawing.text([LEFT + 0.5 * ROOM[0], ROOM[1] + 10.0 + 2.0 * LETTERS], Anchor::Middle, Ink::Soft, &self.points);
        self.legend(&mut drawing, numbers);
        drawing.finish(&self.head, ROOM[1] + BELOW)
    }

    /// Names from the top down, as the bands stand, with their means.
    fn legend(&self, drawing: &mut Drawing, numbers: Numbers) {
        let x = LEFT + ROOM[0] + 18.0;
        for (number, band) in self.bands.iter().rev().enumerate() {
            let y = 2.4 * LINE * number as f64;
            let mean = band.shares.iter().sum::<f64>() / band.shares.len().max(1) as f64;
            drawing.rectangle([x, y], [14.0, 14.0], band.colour);
            drawing.text([x + 20.0, y + 12.0], Anchor::Start, Ink::Full, &band.name);
            drawing.text([x + 20.0, y + 12.0 + LINE], Anchor::Start, Ink::Soft, &format!("∅ {}\u{a0}%", numbers.fixed(100.0 * mean, 1)));
        }
    }
}

/// Per cents at the left, points counted below.
fn axes(drawing: &mut Drawing, count: usize, one: f64) {
    for percent in [0, 20, 40, 60, 80, 100] {
        let y = ROOM[1] * (1.0 - f64::from(percent) / 100.0);
        drawing.line([LEFT - 5.0, y], [LEFT, y]);
        let unit = if percent == 100 { "\u{a0}%" } else { "" };
        drawing.text([LEFT - 8.0, y + 0.35 * LETTERS], Anchor::End, Ink::Soft, &format!("{percent}{unit}"));
    }
    for place in ticks(count as f64, STEPS.min(count)) {
        let x = LEFT + place * one;
        drawing.line([x, ROOM[1]], [x, ROOM[1] + 5.0]);
        drawing.text([x, ROOM[1] + 6.0 + LETTERS], Anchor::Middle, Ink::Soft, &place.to_string());
    }
}
