//! A road's results as drawings in SVG: the plan, and lines of equal illuminance and luminance.

use crate::{
    contours::Sampled,
    illuminance::{Measurand, illuminance},
    line::Line,
    luminance::{AWAY, Seen},
    results::Results,
    road::Road,
    text,
};
use gonio_formats::{Anchor, Canvas, short_number};

/// Width of a drawing, its margins left and right, and the height of its title and its foot, in pixels.
const WIDTH: f64 = 900.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 110.0;
const HEAD: f64 = 46.0;
const FOOT: f64 = 34.0;
/// Pixels of a metre across, at least: a long field is drawn stretched.
const LEAST_SCALE: f64 = 10.0;
/// Height of a line of text.
const LINE: f64 = 20.0;
/// Metres beside the outermost of what is drawn.
const BESIDE: f64 = 1.0;
/// Samples of a map along and, at least, across; metres between those across.
const ALONG: usize = 80;
const ACROSS: usize = 13;
const STEP: f64 = 0.5;

const ROAD: &str = "#e3e5e8";
const PATH: &str = "#f2ecdf";
const INK: &str = "#30353b";
const SOFT: &str = "#8a929c";
const LAMP: &str = "#c9820a";
/// Colours of lines from low to high.
const RAMP: [&str; 8] = ["#2c3e91", "#1f6fb4", "#118f9c", "#1d9a5b", "#7a9a12", "#c28a00", "#d2591c", "#b51f2e"];

/// Where metres come to lie on a canvas.
struct Frame {
    top: f64,
    x: [f64; 2],
    y: [f64; 2],
    scale: [f64; 2],
}

impl Frame {
    fn new(results: &Results, y: [f64; 2], top: f64) -> Self {
        let x = [results.field.start, results.field.start + results.field.length];
        let along = (WIDTH - LEFT - RIGHT) / (x[1] - x[0]);
        Self { top, x, y, scale: [along, along.clamp(LEAST_SCALE, 40.0)] }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [LEFT + (x - self.x[0]) * self.scale[0], self.top + HEAD + (self.y[1] - y) * self.scale[1]]
    }

    fn height(&self) -> f64 {
        HEAD + FOOT + (self.y[1] - self.y[0]) * self.scale[1]
    }

    fn band(&self, canvas: &mut Canvas, [low, high]: [f64; 2], colour: &str) {
        let corners = [[self.x[0], low], [self.x[1], low], [self.x[1], high], [self.x[0], high]];
        canvas.area(&corners.map(|corner| self.at(corner)), colour);
    }
}

/// The plan: carriageway, paths, luminaires, observers' lanes and points.
pub fn plan(road: &Road, results: &Results) -> String {
    alone(&Frame::new(results, extent(road), 0.0), |canvas, frame| draw_plan(canvas, frame, road, results))
}

/// Lines of equal maintained illuminance on carriageway and paths.
pub fn isolux(road: &Road, results: &Results) -> String {
    alone(&Frame::new(results, lit(road), 0.0), |canvas, frame| draw_isolux(canvas, frame, road))
}

/// Lines of equal maintained luminance of the carriageway, as the observer in a lane sees it; lanes count from 1.
pub fn isoluminance(road: &Road, results: &Results, lane: u32) -> String {
    let y = [0.0, road.carriageway_width];
    alone(&Frame::new(results, y, 0.0), |canvas, frame| draw_isoluminance(canvas, frame, road, results, lane))
}

/// Everything on one sheet: results as text, the plan, and lines of equal value.
pub fn sheet(road: &Road, results: &Results, title: &str) -> String {
    let lines: Vec<String> = text::lines(results).iter().flat_map(|line| wrapped(line)).collect();
    let mut top = 40.0 + LINE * lines.len() as f64;
    let mut frames = Vec::new();
    let carriageway = [0.0, road.carriageway_width];
    for y in [extent(road), lit(road)].into_iter().chain(results.observers.iter().map(|_| carriageway)) {
        let frame = Frame::new(results, y, top);
        top += frame.height();
        frames.push(frame);
    }
    let mut canvas = Canvas::new(WIDTH, top);
    canvas.text([LEFT, 26.0], Anchor::Start, title);
    for (index, line) in lines.iter().enumerate() {
        canvas.text([LEFT, 50.0 + LINE * index as f64], Anchor::Start, line);
    }
    for (index, frame) in frames.iter().enumerate() {
        match index {
            0 => draw_plan(&mut canvas, frame, road, results),
            1 => draw_isolux(&mut canvas, frame, road),
            _ => draw_isoluminance(&mut canvas, frame, road, results, index as u32 - 1),
        }
    }
    canvas.finish()
}

fn alone(frame: &Frame, draw: impl Fn(&mut Canvas, &Frame)) -> String {
    let mut canvas = Canvas::new(WIDTH, frame.height().ceil());
    draw(&mut canvas, frame);
    canvas.finish()
}

/// A line of text in pieces that fit the page.
fn wrapped(line: &str) -> Vec<String> {
    const LETTERS: usize = 120;
    let mut pieces = vec![String::new()];
    for word in line.split(' ') {
        let last = pieces.len() - 1;
        if !pieces[last].is_empty() && pieces[last].chars().count() + word.chars().count() > LETTERS {
            pieces.push(format!("    {word}"));
        } else {
            let blank = if pieces[last].is_empty() { "" } else { " " };
            pieces[last] += &format!("{blank}{word}");
        }
    }
    pieces
}

/// Carriageway and paths across.
fn lit(road: &Road) -> [f64; 2] {
    let paths = road.footpaths.iter().map(|path| path.range(road.carriageway_width));
    paths.fold([0.0, road.carriageway_width], |[low, high], [from, to]| [low.min(from), high.max(to)])
}

/// The same with luminaires.
fn extent(road: &Road) -> [f64; 2] {
    let [low, high] = Line::all(road).iter().fold(lit(road), |[low, high], line| [low.min(line.y), high.max(line.y)]);
    [low - BESIDE, high + BESIDE]
}

fn draw_plan(canvas: &mut Canvas, frame: &Frame, road: &Road, results: &Results) {
    ground(canvas, frame, road, "Plan");
    for y in &results.luminance_y {
        for x in &results.x {
            canvas.circle(frame.at([*x, *y]), 1.5, SOFT);
        }
    }
    for line in Line::all(road) {
        let edge = if line.left { road.carriageway_width } else { 0.0 };
        for x in line.between(frame.x[0], frame.x[1]) {
            let at = frame.at([x, line.y]);
            canvas.line(frame.at([x, edge]), at, LAMP);
            canvas.circle(at, 5.0, LAMP);
            canvas.circle(at, 2.0, LAMP);
        }
    }
    for seen in &results.observers {
        let [x, y] = frame.at([frame.x[0], seen.position[1]]);
        canvas.curve(&[[x - 34.0, y], [x - 8.0, y]], INK, "");
        canvas.curve(&[[x - 14.0, y - 4.0], [x - 8.0, y], [x - 14.0, y + 4.0]], INK, "");
    }
    let foot = frame.top + frame.height() - 8.0;
    let text = format!(
        "{} m × {} m; circles: points of luminance; arrows: observers, {AWAY} m before the field",
        short_number(results.field.length),
        short_number(road.carriageway_width)
    );
    canvas.text([LEFT, foot], Anchor::Start, &text);
}

/// Title, carriageway with lanes, and paths.
fn ground(canvas: &mut Canvas, frame: &Frame, road: &Road, title: &str) {
    canvas.text([LEFT, frame.top + 28.0], Anchor::Start, title);
    frame.band(canvas, [0.0, road.carriageway_width], ROAD);
    for path in &road.footpaths {
        let [low, high] = path.range(road.carriageway_width);
        if low >= frame.y[0] && high <= frame.y[1] {
            frame.band(canvas, [low, high], PATH);
        }
    }
    for lane in 1..road.lanes {
        let y = f64::from(lane) * road.lane_width();
        canvas.curve(&[frame.at([frame.x[0], y]), frame.at([frame.x[1], y])], "white", "12 8");
    }
}

fn draw_isolux(canvas: &mut Canvas, frame: &Frame, road: &Road) {
    ground(canvas, frame, road, "Lines of equal illuminance, maintained");
    let lines = Line::all(road);
    let value = |at| illuminance(&lines, &road.reach, at, Measurand::Horizontal);
    isolines(canvas, frame, &Sampled::new(columns(frame), rows(frame), value), "lx");
}

fn draw_isoluminance(canvas: &mut Canvas, frame: &Frame, road: &Road, results: &Results, lane: u32) {
    ground(canvas, frame, road, &format!("Lines of equal luminance for the observer in lane {lane}, maintained"));
    let lines = Line::all(road);
    let y = (f64::from(lane) - 0.5) * road.lane_width();
    let seen: Seen<'_> = road.seen(&lines, &road.surface, [results.field.start - AWAY, y]);
    isolines(canvas, frame, &Sampled::new(columns(frame), rows(frame), |at| seen.luminance(at)[0]), "cd/m²");
}

/// Where a map is sampled along the road.
fn columns(frame: &Frame) -> Vec<f64> {
    ends(frame.x, ALONG)
}

/// Where a map is sampled across the road.
fn rows(frame: &Frame) -> Vec<f64> {
    let [low, high] = frame.y;
    ends(frame.y, (((high - low) / STEP) as usize + 1).max(ACROSS))
}

/// So many places from one end to the other.
fn ends([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|index| from + (to - from) * index as f64 / (count - 1) as f64).collect()
}

/// Lines of round levels with a legend.
fn isolines(canvas: &mut Canvas, frame: &Frame, sampled: &Sampled, unit: &str) {
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
