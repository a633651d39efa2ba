//! The cone diagram: illuminance on the axis and the beam's width by distance.

use super::Goniogram;
use crate::short_number;
use crate::svg::{Anchor, Canvas};

/// Distances in metres.
const DISTANCES: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];

/// Page, the cone's tip, height and greatest half width in pixels.
const PAGE: [f64; 2] = [560.0, 460.0];
const TIP: [f64; 2] = [250.0, 60.0];
const HEIGHT: f64 = 360.0;
const HALF_WIDTH: f64 = 150.0;

/// The steepest half angle whose width is told, in degrees: beyond it a width says nothing.
const WIDEST: f64 = 85.0;

/// The cone diagram as an SVG document: illuminance E in lx straight on at 1 to 5 m, and the diameters of the beam (half the greatest
/// intensity) in the planes C0–C180 and C90–C270.
///
/// Light that goes up is drawn about zenith.
pub fn cone_diagram(goniogram: &Goniogram) -> String {
    let beam = goniogram.figures().beam;
    let axis = if beam[0].up { [0.0, 0.0, 1.0] } else { [0.0, 0.0, -1.0] };
    let on_axis = goniogram.intensity(axis);
    // Ends of the two beams at 1 m.
    let ends = beam.map(|beam| beam.range.map(|angle| angle.clamp(-WIDEST, WIDEST).to_radians().tan()));
    let mut canvas = Canvas::new(PAGE[0], PAGE[1]);
    let name = goniogram.text("LUMINAIRE").or_else(|| goniogram.text("LUMCAT")).unwrap_or("");
    canvas.text([PAGE[0] / 2.0, 24.0], Anchor::Middle, name);
    draw(&mut canvas, ends[0]);
    canvas.text([14.0, TIP[1] - 6.0], Anchor::Start, "distance, E");
    canvas.text([PAGE[0] - 14.0, TIP[1] - 6.0], Anchor::End, "diameter C0, C90");
    for distance in DISTANCES {
        let y = TIP[1] + HEIGHT * distance / DISTANCES[4];
        let lux = on_axis / (distance * distance);
        canvas.text([14.0, y - 4.0], Anchor::Start, &format!("{} m, {} lx", short_number(distance), short_number(lux)));
        let [c0, c90] = ends.map(|[from, to]| short_number((to - from) * distance));
        canvas.text([PAGE[0] - 14.0, y - 4.0], Anchor::End, &format!("{c0} m, {c90} m"));
    }
    let [c0, c90] = beam.map(|beam| format!("{:.1}°", beam.angle()));
    let side = if beam[0].up { "about zenith" } else { "about nadir" };
    let bottom = format!("beam {c0} (C0–C180), {c90} (C90–C270), {} cd {side}", short_number(on_axis));
    canvas.text([PAGE[0] / 2.0, PAGE[1] - 14.0], Anchor::Middle, &bottom);
    canvas.finish()
}

/// The cone of the C0–C180 plane, whose ends at 1 m are given in metres, with a line at each distance.
fn draw(canvas: &mut Canvas, [from, to]: [f64; 2]) {
    let down = HEIGHT / DISTANCES[4];
    let widest = from.abs().max(to.abs()) * DISTANCES[4];
    // The same scale along and across while it fits.
    let across = if widest * down > HALF_WIDTH { HALF_WIDTH / widest } else { down };
    let at = |side: f64, distance: f64| [TIP[0] + side * distance * across, TIP[1] + distance * down];
    canvas.area(&[TIP, at(from, DISTANCES[4]), at(to, DISTANCES[4])], "#fff1c9");
    for distance in DISTANCES {
        let y = TIP[1] + distance * down;
        canvas.line([10.0, y], [PAGE[0] - 10.0, y], "#bbbbbb");
        canvas.line(at(from, distance), at(to, distance), "#7a5c00");
    }
    canvas.line(TIP, at(from, DISTANCES[4]), "#7a5c00");
    canvas.line(TIP, at(to, DISTANCES[4]), "#7a5c00");
}
