//! The polar diagram: intensity as a radius, nadir down.

use super::Goniogram;
use crate::short_number;
use crate::svg::{Anchor, Canvas};

/// Page, centre and radius of the outermost ring in pixels.
const PAGE: [f64; 2] = [520.0, 580.0];
const CENTRE: [f64; 2] = [260.0, 275.0];
const RADIUS: f64 = 215.0;

/// Candela and lumens below this are none: no ring can be drawn for them.
const DARK: f64 = 1e-9;

const GREY: &str = "#bbbbbb";
const RED: &str = "#c0282d";
const BLUE: &str = "#1f5fa8";

/// What a polar diagram's rings count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PolarUnit {
    /// cd.
    Candela,
    /// cd for each 1000 lm of the lamps, or of the luminaire where its lamps' flux is not stated.
    CandelaPerKilolumen,
}

/// The polar diagram as an SVG document: C0–C180 drawn through, C90–C270 dashed, C0 and C90 to the right.
pub fn polar_diagram(goniogram: &Goniogram, unit: PolarUnit) -> String {
    let flux = goniogram.lamps().and_then(|lamps| lamps.flux).unwrap_or_else(|| goniogram.flux());
    let (factor, name) = match unit {
        PolarUnit::CandelaPerKilolumen if flux > DARK => (1000.0 / flux, "cd/klm"),
        _ => (1.0, "cd"),
    };
    let cuts = [goniogram.cut(0.0), goniogram.cut(90.0)];
    let peak = cuts.iter().flatten().map(|point| point[1] * factor).fold(0.0, f64::max);
    let step = ring_step(peak);
    let rings = (peak / step).ceil().max(1.0);
    let mut canvas = Canvas::new(PAGE[0], PAGE[1]);
    frame(&mut canvas, rings, step);
    let scale = factor * RADIUS / (rings * step);
    for (cut, colour, dashes) in [(&cuts[1], BLUE, "7 4"), (&cuts[0], RED, "")] {
        let points: Vec<[f64; 2]> = cut.iter().map(|[gamma, intensity]| at(*gamma, intensity * scale)).collect();
        canvas.curve(&points, colour, dashes);
    }
    legend(&mut canvas, goniogram, name);
    canvas.finish()
}

/// The point at a signed γ in degrees and a distance from the centre in pixels.
fn at(gamma: f64, distance: f64) -> [f64; 2] {
    let (sin, cos) = gamma.to_radians().sin_cos();
    [CENTRE[0] + sin * distance, CENTRE[1] + cos * distance]
}

/// A round distance of rings, such that there are three to seven of them.
fn ring_step(peak: f64) -> f64 {
    if peak <= DARK {
        return 1.0;
    }
    let power = 10f64.powf((peak / 3.0).log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|factor| factor * power).find(|step| peak / step >= 3.0).unwrap_or(power)
}

/// Rings with their values and rays with their angles.
fn frame(canvas: &mut Canvas, rings: f64, step: f64) {
    for gamma in (0..360).step_by(15).map(f64::from) {
        canvas.line(CENTRE, at(gamma, RADIUS), GREY);
    }
    for ring in 1..=rings as u32 {
        let radius = RADIUS * f64::from(ring) / rings;
        canvas.circle(CENTRE, radius, GREY);
        let [x, y] = at(0.0, radius);
        canvas.text([x + 3.0, y - 3.0], Anchor::Start, &short_number(f64::from(ring) * step));
    }
    for gamma in (-150..=180).step_by(30).map(f64::from) {
        let [x, y] = at(gamma, RADIUS + 16.0);
        canvas.text([x, y + 4.0], Anchor::Middle, &format!("{}°", gamma.abs()));
    }
}

fn legend(canvas: &mut Canvas, goniogram: &Goniogram, unit: &str) {
    let name = goniogram.text("LUMINAIRE").or_else(|| goniogram.text("LUMCAT")).unwrap_or("");
    canvas.text([PAGE[0] / 2.0, 24.0], Anchor::Middle, name);
    let y = PAGE[1] - 22.0;
    canvas.curve(&[[40.0, y - 4.0], [80.0, y - 4.0]], RED, "");
    canvas.text([86.0, y], Anchor::Start, "C0–C180");
    canvas.curve(&[[170.0, y - 4.0], [210.0, y - 4.0]], BLUE, "7 4");
    canvas.text([216.0, y], Anchor::Start, "C90–C270");
    canvas.text([PAGE[0] - 40.0, y], Anchor::End, &format!("{unit}, {} lm", short_number(goniogram.flux())));
}
