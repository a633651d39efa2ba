//! A road's results as drawings in SVG: the plan, lines of equal illuminance and luminance, and what a driver sees.

mod frame;
mod isolines;
mod view;

pub use view::view;

use crate::{
    contours::Sampled,
    illuminance::{Measurand, illuminance},
    line::Line,
    luminance::{AWAY, Seen},
    results::Results,
    road::Road,
    text,
};
use frame::{Frame, LEFT, WIDTH};
use gonio_formats::{Anchor, Canvas, short_number};
use isolines::{columns, isolines, rows};

/// Height of a line of text.
const LINE: f64 = 20.0;
/// Metres beside the outermost of what is drawn.
const BESIDE: f64 = 1.0;

const ROAD: &str = "#e3e5e8";
const PATH: &str = "#f2ecdf";
const INK: &str = "#30353b";
const SOFT: &str = "#8a929c";
const LAMP: &str = "#c9820a";

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
