//! What the driver in a lane sees of the field, with its luminances.

use super::{
    LAMP, ROAD,
    frame::{HEAD, LEFT, WIDTH},
};
use crate::{
    luminance::{AWAY, EYE},
    results::{Observed, Results},
    road::Road,
};
use gonio_formats::{Anchor, Canvas, short_number};

/// Pixels of the carriageway's width where the field begins, and those of a row of cells in the mean.
const ACROSS: f64 = WIDTH - 2.0 * LEFT;
const ROW: f64 = 24.0;
/// How far road is drawn before and behind the field, of the way to its ends.
const BEFORE: f64 = 0.9;
const BEHIND: f64 = 1.15;
/// What is left for a line of text below.
const FOOT: f64 = 34.0;

/// The picture plane of an observer.
struct Eye {
    position: [f64; 2],
    centre: f64,
    /// Pixels of a unit of the tangent, to the side and down.
    scale: [f64; 2],
    /// Tangent of the angle below the horizon at the picture's top.
    top: f64,
}

impl Eye {
    fn new(road: &Road, results: &Results, seen: &Observed) -> Self {
        let [x, y, _] = seen.position;
        let far = AWAY + results.field.length;
        let across = ACROSS * AWAY / road.carriageway_width;
        let down = ROW * results.field.along as f64 / (EYE / AWAY - EYE / far);
        let centre = LEFT + across * (road.carriageway_width - y) / AWAY;
        Self { position: [x, y], centre, scale: [across, down], top: EYE / (far * BEHIND) }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ahead = x - self.position[0];
        [self.centre - self.scale[0] * (y - self.position[1]) / ahead, HEAD + self.scale[1] * (EYE / ahead - self.top)]
    }

    /// How many times heights are drawn as large as widths.
    fn stretch(&self) -> f64 {
        self.scale[1] / self.scale[0]
    }
}

/// The field as the observer in a lane sees it: each cell as bright as its luminance, the greatest white, with the number; lanes count from 1.
pub fn view(road: &Road, results: &Results, lane: u32) -> String {
    let Some(seen) = results.observers.iter().find(|seen| seen.lane == lane) else { return Canvas::new(WIDTH, HEAD).finish() };
    let eye = Eye::new(road, results, seen);
    let (field, width) = (&results.field, road.carriageway_width);
    let [near, far] = [seen.position[0] + AWAY * BEFORE, seen.position[0] + (AWAY + field.length) * BEHIND];
    let quad = |[x0, x1]: [f64; 2], [y0, y1]: [f64; 2]| [[x0, y0], [x0, y1], [x1, y1], [x1, y0]].map(|corner| eye.at(corner));
    let mut canvas = Canvas::new(WIDTH, (eye.at([near, 0.0])[1] + FOOT).ceil());
    canvas.text([LEFT, 28.0], Anchor::Start, &format!("What the driver in lane {lane} sees: luminance in cd/m², maintained"));
    canvas.area(&quad([near, far], [0.0, width]), ROAD);
    let greatest = seen.luminance.iter().flatten().copied().fold(0.0, f64::max);
    let [along, across] = [field.step(), width / field.across as f64];
    for (row, values) in seen.luminance.iter().enumerate() {
        for (column, value) in values.iter().enumerate() {
            let [x, y] = [field.start + column as f64 * along, row as f64 * across];
            canvas.area(&quad([x, x + along], [y, y + across]), &grey(if greatest > 0.0 { value / greatest } else { 0.0 }));
            let [u, v] = eye.at([x + 0.5 * along, y + 0.5 * across]);
            canvas.text([u, v + 4.0], Anchor::Middle, &short_number(*value));
        }
    }
    for lane in 1..road.lanes {
        let y = f64::from(lane) * road.lane_width();
        canvas.curve(&[eye.at([near, y]), eye.at([far, y])], LAMP, "12 8");
    }
    let foot = format!("from {AWAY} m before the field, {EYE} m high; heights are drawn {:.0} times as large as widths", eye.stretch());
    canvas.text([LEFT, eye.at([near, 0.0])[1] + 22.0], Anchor::Start, &foot);
    canvas.finish()
}

/// A luminance over the greatest as a screen's grey (sRGB).
fn grey(share: f64) -> String {
    let code = if share <= 0.003_130_8 { 12.92 * share } else { 1.055 * share.powf(1.0 / 2.4) - 0.055 };
    let byte = (255.0 * code.clamp(0.0, 1.0)).round() as u8;
    format!("#{byte:02x}{byte:02x}{byte:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greys_are_srgb() {
        assert_eq!([grey(0.0), grey(0.5), grey(1.0), grey(f64::NAN)], ["#000000", "#bcbcbc", "#ffffff", "#000000"]);
    }
}
