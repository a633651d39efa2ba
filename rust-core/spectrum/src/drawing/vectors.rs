//! TM-30's colour vector graphic: bins' mean colours under the reference on a circle, under the lamp as a curve, arrows between.

use super::{add, screen, text};
use crate::rendition::{HueBin, Rendition};

/// The circle's middle and radius in pixels.
const MIDDLE: [f64; 2] = [690.0, 215.0];
const RADIUS: f64 = 115.0;
/// How far from the middle a curve may go, in radii.
const FARTHEST: f64 = 1.6;
/// Points of the curve between two bins.
const SMOOTH: usize = 12;

/// Draws the graphic with its two indices.
pub(super) fn graphic(page: &mut String, rendition: &Rendition) {
    let ends: Vec<[[f64; 2]; 2]> = rendition.bins.iter().enumerate().map(|(k, bin)| arrow(k, bin)).collect();
    let [x, y] = MIDDLE;
    for (k, [from, _]) in ends.iter().enumerate() {
        let [left, right] = [-0.5, 0.5].map(|side| on_circle(k as f64 + 0.5 + side, 1.0));
        let colour = colour(k);
        add(
            page,
            format_args!(
                "<polygon points=\"{x:.2},{y:.2} {:.2},{:.2} {:.2},{:.2} {:.2},{:.2}\" fill=\"{colour}\" fill-opacity=\"0.22\"/>",
                left[0], left[1], from[0], from[1], right[0], right[1]
            ),
        );
    }
    add(page, format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{RADIUS}\" fill=\"none\" stroke=\"black\" stroke-width=\"1.5\"/>"));
    add(page, format_args!("<line x1=\"{:.2}\" y1=\"{y}\" x2=\"{:.2}\" y2=\"{y}\" stroke=\"#bbb\"/>", x - RADIUS, x + RADIUS));
    add(page, format_args!("<line x1=\"{x}\" y1=\"{:.2}\" x2=\"{x}\" y2=\"{:.2}\" stroke=\"#bbb\"/>", y - RADIUS, y + RADIUS));
    let lamp: Vec<[f64; 2]> = ends.iter().map(|[_, to]| *to).collect();
    let curve: String = closed(&lamp).iter().map(|[x, y]| format!("{x:.2},{y:.2} ")).collect();
    add(page, format_args!("<polygon points=\"{}\" fill=\"none\" stroke=\"#d22\" stroke-width=\"2\"/>", curve.trim_end()));
    for (k, [from, to]) in ends.iter().enumerate() {
        arrow_line(page, *from, *to, &colour(k));
        let [x, y] = on_circle(k as f64 + 0.5, 1.22);
        text(page, [x, y + 4.0], "middle", 10, &(k + 1).to_string());
    }
    text(page, [MIDDLE[0], 384.0], "middle", 12, &format!("TM-30 colour vectors: Rf {:.0}, Rg {:.0}", rendition.rf, rendition.rg));
    text(page, [MIDDLE[0], 401.0], "middle", 11, "black: reference, red: this light;");
    text(page, [MIDDLE[0], 416.0], "middle", 11, "outside the circle colours are more saturated");
}

/// A place of the page at a hue in bins and a distance in radii.
fn on_circle(bins: f64, distance: f64) -> [f64; 2] {
    let (sin, cos) = (22.5 * bins).to_radians().sin_cos();
    [MIDDLE[0] + RADIUS * distance * cos, MIDDLE[1] - RADIUS * distance * sin]
}

/// From the reference's place on the circle to the lamp's, shifted by what the bin's mean is over the reference's chroma (TM-30-20).
fn arrow(k: usize, bin: &HueBin) -> [[f64; 2]; 2] {
    let angle = (22.5 * (k as f64 + 0.5)).to_radians();
    let chroma = bin.reference[0].hypot(bin.reference[1]);
    let shift = [0, 1].map(|axis| (bin.test[axis] - bin.reference[axis]) / chroma);
    let [a, b] = [angle.cos() + shift[0], angle.sin() + shift[1]];
    // Curves of strange lamps stay within the page.
    let scale = (FARTHEST / a.hypot(b)).min(1.0);
    [on_circle(k as f64 + 0.5, 1.0), [MIDDLE[0] + RADIUS * scale * a, MIDDLE[1] - RADIUS * scale * b]]
}

/// A closed curve through points (Catmull and Rom).
fn closed(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let count = points.len();
    let point = |k: usize| points[k % count];
    let piece = |k: usize, t: f64| {
        let [p0, p1, p2, p3] = [point(k + count - 1), point(k), point(k + 1), point(k + 2)];
        [0, 1].map(|axis| {
            let [a, b, c, d] = [p0[axis], p1[axis], p2[axis], p3[axis]];
            0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t + (3.0 * b - a - 3.0 * c + d) * t.powi(3))
        })
    };
    (0..count).flat_map(|k| (0..SMOOTH).map(move |step| (k, step as f64 / SMOOTH as f64))).map(|(k, t)| piece(k, t)).collect()
}

/// An arrow with a head as long as fits.
fn arrow_line(page: &mut String, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], colour: &str) {
    let [dx, dy] = [x1 - x0, y1 - y0];
    let length = dx.hypot(dy);
    add(page, format_args!("<line x1=\"{x0:.2}\" y1=\"{y0:.2}\" x2=\"{x1:.2}\" y2=\"{y1:.2}\" stroke=\"{colour}\" stroke-width=\"2.5\"/>"));
    if length < 1.0 {
        return;
    }
    let head = (0.5 * length).min(8.0);
    let [ux, uy] = [dx / length * head, dy / length * head];
    let [bx, by] = [x1 - ux, y1 - uy];
    add(
        page,
        format_args!(
            "<polygon points=\"{x1:.2},{y1:.2} {:.2},{:.2} {:.2},{:.2}\" fill=\"{colour}\"/>",
            bx - 0.5 * uy,
            by + 0.5 * ux,
            bx + 0.5 * uy,
            by - 0.5 * ux
        ),
    );
}

/// A bin's colour: its hue in Oklab at a lightness and chroma that screens have all around.
fn colour(k: usize) -> String {
    let (sin, cos) = (22.5 * (k as f64 + 0.5)).to_radians().sin_cos();
    let [l, a, b] = [0.68, 0.125 * cos, 0.125 * sin];
    let [l, m, s] = [
        l + 0.396_337_777_4 * a + 0.215_803_757_3 * b,
        l - 0.105_561_345_8 * a - 0.063_854_172_8 * b,
        l - 0.089_484_177_5 * a - 1.291_485_548_0 * b,
    ]
    .map(|root| root.powi(3));
    screen([
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ])
}
