//! The lobe diagram: the BSDF in the plane of incidence as a logarithmic radius, the normal of the lit side up.

use super::{DECADES, INCIDENCE_DEG, Luminance, decade, height, power_of_ten};
use crate::bsdf::direction::Direction;
use crate::bsdf::measured::Measured;
use crate::svg::{Anchor, Canvas};

/// Page's width, the centre and the radius of the outermost ring in pixels.
const WIDTH: f64 = 640.0;
const CENTRE: [f64; 2] = [320.0, 310.0];
const RADIUS: f64 = 250.0;

/// Room for the legend below the rings.
const LEGEND: f64 = 70.0;

/// Steps of the curves, degrees.
const STEP_DEG: f64 = 0.25;

const GREY: &str = "#bbbbbb";
const COLOURS: [&str; INCIDENCE_DEG.len()] = ["#1f5fa8", "#2a8c4a", "#d98200", "#c0282d"];

/// The lobes of light at some angles in the plane of incidence at azimuth 0 as an SVG document: radius is the logarithm of the luminance of
/// the BSDF in 1/sr, light comes from the left.
pub fn lobe_diagram(measured: &Measured, title: &str) -> String {
    let luminance = Luminance::new(measured);
    let has_transmission = luminance.pairs().any(|pair| !pair.is_reflection());
    let lobes = INCIDENCE_DEG.map(|theta| lobe(&luminance, theta));
    let peak = lobes.iter().flatten().map(|point| point[1]).fold(0.0, f64::max);
    let top = decade(peak);
    let bottom = CENTRE[1] + if has_transmission { RADIUS + 20.0 } else { 20.0 };
    let mut canvas = Canvas::new(WIDTH, bottom + LEGEND);
    rings(&mut canvas, top, has_transmission);
    for ((lobe, theta), colour) in lobes.iter().zip(INCIDENCE_DEG).zip(COLOURS) {
        // From the source to the surface.
        canvas.curve(&[at(-theta, RADIUS), CENTRE], colour, "3 4");
        let points: Vec<[f64; 2]> = lobe.iter().map(|[angle, value]| at(*angle, RADIUS * height(*value, top))).collect();
        canvas.curve(&points, colour, "");
    }
    canvas.text([WIDTH / 2.0, 24.0], Anchor::Middle, title);
    legend(&mut canvas, bottom + 24.0);
    canvas.finish()
}

/// The BSDF for light at an angle by the signed angle of view from the lit side's normal, degrees, all around where anything passes through.
fn lobe(luminance: &Luminance<'_>, theta_deg: f64) -> Vec<[f64; 2]> {
    let wi = luminance.light(theta_deg);
    let last = if luminance.pairs().any(|pair| !pair.is_reflection()) { 180.0 } else { 90.0 };
    let count = (2.0 * last / STEP_DEG) as usize;
    let angles = (0..=count).map(|i| STEP_DEG * i as f64 - last);
    angles.map(|angle| [angle, luminance.bsdf(wi, view(luminance, angle))]).collect()
}

/// The view at a signed angle from the lit side's normal.
fn view(luminance: &Luminance<'_>, angle_deg: f64) -> Direction {
    let (sine, cosine) = angle_deg.to_radians().sin_cos();
    [sine, 0.0, if luminance.is_lit_from_front() { cosine } else { -cosine }]
}

/// The point at a signed angle from the upward normal and a distance from the centre in pixels.
fn at(angle_deg: f64, distance: f64) -> [f64; 2] {
    let (sine, cosine) = angle_deg.to_radians().sin_cos();
    [CENTRE[0] + sine * distance, CENTRE[1] - cosine * distance]
}

/// Rings of decades with their values, rays with their angles, and the surface.
fn rings(canvas: &mut Canvas, top: f64, has_transmission: bool) {
    let last: i32 = if has_transmission { 180 } else { 90 };
    for ring in 1..=DECADES as u32 {
        let radius = RADIUS * f64::from(ring) / DECADES;
        let arc: Vec<[f64; 2]> = (-last..=last).step_by(3).map(|angle| at(f64::from(angle), radius)).collect();
        canvas.path(&arc, GREY);
        canvas.text(at(0.0, radius + 3.0), Anchor::Start, &power_of_ten(top - DECADES + f64::from(ring)));
    }
    for angle in (-last..=last).step_by(15).filter(|angle| *angle != -180).map(f64::from) {
        canvas.line(CENTRE, at(angle, RADIUS), GREY);
        if angle % 30.0 == 0.0 && angle != 0.0 {
            let [x, y] = at(angle, RADIUS + 16.0);
            canvas.text([x, y + 4.0], Anchor::Middle, &format!("{}°", angle.abs()));
        }
    }
    canvas.line(at(-90.0, RADIUS), at(90.0, RADIUS), "black");
}

/// Which colour is which angle of light, and the unit.
fn legend(canvas: &mut Canvas, y: f64) {
    for ((theta, colour), i) in INCIDENCE_DEG.iter().zip(COLOURS).zip(0..) {
        let x = 40.0 + 120.0 * f64::from(i);
        canvas.curve(&[[x, y - 4.0], [x + 30.0, y - 4.0]], colour, "");
        canvas.text([x + 36.0, y], Anchor::Start, &format!("light at {theta}°"));
    }
    canvas.text([WIDTH - 30.0, y], Anchor::End, "BSDF, 1/sr");
    let words = "from the left (dotted) in the plane of incidence at azimuth 0; luminance, logarithmic radius";
    canvas.text([40.0, y + 24.0], Anchor::Start, words);
}
