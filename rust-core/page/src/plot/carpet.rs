//! A year at a glance: days from left to right, hours from the bottom up.

use super::{
    Head, Scale,
    drawing::{Anchor, Drawing, Ink, LETTERS, WIDTH},
};
use crate::Numbers;
use std::fmt::Write;

/// Room for the days and the hours.
const ROOM: [f64; 2] = [570.0, 300.0];
/// Room for hours at the left, and for months below.
const LEFT: f64 = 46.0;
const BELOW: f64 = 30.0;
/// Hours that are written.
const HOURS: [f64; 9] = [0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0, 24.0];

/// Values of a year's steps, from the first of January on.
#[derive(Clone, Debug)]
pub struct Carpet<'a> {
    /// Title and what else is to be said.
    pub head: Head,
    /// A value a step; what is not above 0 is night.
    pub values: &'a [f32],
    /// Steps of a day.
    pub a_day: usize,
    /// Places of the months' first days, counted from 0, and their names.
    pub months: Vec<(usize, String)>,
    /// By day when the sun rises and sets, hours; `None` where it does not.
    pub sun: &'a [Option<[f64; 2]>],
    /// Colours.
    pub scale: &'a Scale,
}

impl Carpet<'_> {
    /// The plot.
    pub fn svg(&self, numbers: Numbers) -> String {
        let a_day = self.a_day.max(1);
        let days = (self.values.len() / a_day).max(1);
        let cell = [ROOM[0] / days as f64, ROOM[1] / a_day as f64];
        let mut drawing = Drawing::new();
        drawing.add(format_args!(
            "<rect class=\"night\" x=\"{LEFT}\" y=\"0\" width=\"{}\" height=\"{}\" fill=\"#e4e7ea\"/>",
            ROOM[0], ROOM[1]
        ));
        // Cells are whole numbers in a frame of their own, so that a year of hours stays small.
        let [x, y] = cell;
        drawing.add(format_args!("<g transform=\"matrix({x:.5} 0 0 {:.5} {LEFT} {})\" shape-rendering=\"crispEdges\">", -y, ROOM[1]));
        for (class, path) in self.paths(a_day).iter().enumerate().filter(|(_, path)| !path.is_empty()) {
            drawing.add(format_args!("<path fill=\"{}\" d=\"{path}\"/>", self.scale.colour(class)));
        }
        drawing.add(format_args!("</g>"));
        self.sun(&mut drawing, cell[0]);
        self.axes(&mut drawing, cell[0]);
        self.scale.legend(&mut drawing, [WIDTH - 80.0, 0.0], ROOM[1], numbers);
        drawing.finish(&self.head, ROOM[1] + BELOW)
    }

    /// By class the hours that have it, as runs of a day.
    fn paths(&self, a_day: usize) -> Vec<String> {
        let mut paths = vec![String::new(); self.scale.classes()];
        let class = |value: &f32| (*value > 0.0).then(|| self.scale.class(f64::from(*value)));
        for (day, values) in self.values.chunks_exact(a_day).enumerate() {
            let mut start = 0;
            for run in values.chunk_by(|a, b| class(a) == class(b)) {
                if let Some(class) = class(&run[0]) {
                    // Writing to a string cannot fail.
                    let _ = write!(paths[class], "M{day} {start}h1v{}h-1z", run.len());
                }
                start += run.len();
            }
        }
        paths
    }

    /// Sunrise and sunset, a curve for each stretch of days that have them.
    fn sun(&self, drawing: &mut Drawing, day: f64) {
        let mut first = 0;
        for days in self.sun.chunk_by(|a, b| a.is_some() == b.is_some()) {
            for side in 0..2 {
                let times = days.iter().flatten().enumerate();
                let place = |(number, times): (usize, &[f64; 2])| {
                    let x = LEFT + ((first + number) as f64 + 0.5) * day;
                    format!("{x:.1} {:.1}", ROOM[1] * (1.0 - times[side] / 24.0))
                };
                let path = times.map(place).collect::<Vec<_>>().join("L");
                if path.contains('L') {
                    drawing
                        .add(format_args!("<path class=\"curve\" d=\"M{path}\" fill=\"none\" stroke=\"#1d2126\" stroke-width=\"1.5\"/>"));
                }
            }
            first += days.len();
        }
    }

    fn axes(&self, drawing: &mut Drawing, day: f64) {
        for hour in HOURS {
            let y = ROOM[1] * (1.0 - hour / 24.0);
            drawing.line([LEFT - 5.0, y], [LEFT, y]);
            drawing.text([LEFT - 9.0, y + 0.35 * LETTERS], Anchor::End, Ink::Soft, &format!("{hour}"));
        }
        let ends = self.months.iter().skip(1).map(|(start, _)| *start).chain([(ROOM[0] / day).round() as usize]);
        for ((start, name), end) in self.months.iter().zip(ends) {
            let [x, next] = [*start, end].map(|place| LEFT + place as f64 * day);
            drawing.line([x, ROOM[1]], [x, ROOM[1] + 5.0]);
            drawing.text([0.5 * (x + next), ROOM[1] + 6.0 + LETTERS], Anchor::Middle, Ink::Soft, name);
        }
        drawing.text([0.0, 0.35 * LETTERS], Anchor::Start, Ink::Soft, "h");
    }
}
