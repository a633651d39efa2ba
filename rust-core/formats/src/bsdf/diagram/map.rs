//! The lobe map: the BSDF over whole hemispheres of view as colours.

use core::f64::consts::TAU;

use super::{DECADES, INCIDENCE_DEG, Luminance, decade, height, power_of_ten};
use crate::bsdf::direction::{Direction, spherical, through};
use crate::bsdf::hemispheres::Hemispheres;
use crate::bsdf::measured::Measured;
use crate::svg::{Anchor, Canvas};

/// Radius of a disk, and from one disk's middle to the next, pixels.
const RADIUS: f64 = 105.0;
const PITCH: [f64; 2] = [230.0, 260.0];

/// Room above the disks and below them.
const HEAD: f64 = 44.0;
const FOOT: f64 = 56.0;

/// Rings of a disk, and sectors of a turn.
const RINGS: usize = 36;
const SECTORS: usize = 90;

/// Shades of the colour scale.
const SHADES: usize = 40;

/// Dark violet to yellow, of rising lightness.
const COLOURS: [[f64; 3]; 6] =
    [[20.0, 10.0, 50.0], [80.0, 18.0, 120.0], [160.0, 40.0, 120.0], [222.0, 80.0, 75.0], [248.0, 150.0, 40.0], [250.0, 235.0, 120.0]];

/// The BSDF for light at some angles over all directions of view as an SVG document, a row for each pair of hemispheres that the light of
/// the lit side goes to: distance from a disk's middle is the angle from the normal, light comes from the left at azimuth 180°, colour is
/// the logarithm of the luminance of the BSDF in 1/sr.
pub fn lobe_map(measured: &Measured, title: &str) -> String {
    let luminance = Luminance::new(measured);
    let pairs: Vec<Hemispheres> = luminance.pairs().collect();
    let disks: Vec<Vec<f64>> = pairs.iter().flat_map(|pair| INCIDENCE_DEG.map(|theta| disk(&luminance, *pair, theta))).collect();
    let top = decade(disks.iter().flatten().copied().fold(0.0, f64::max));
    let columns = INCIDENCE_DEG.len();
    let size = [PITCH[0] * columns as f64, HEAD + PITCH[1] * pairs.len() as f64 + FOOT];
    let mut canvas = Canvas::new(size[0], size[1]);
    canvas.text([size[0] / 2.0, 24.0], Anchor::Middle, title);
    for (i, values) in disks.iter().enumerate() {
        let (row, column) = (i / columns, i % columns);
        let centre = [PITCH[0] * (column as f64 + 0.5), HEAD + PITCH[1] * row as f64 + RADIUS + 4.0];
        draw(&mut canvas, centre, values, top);
        let words = format!("light at {}°, {}", INCIDENCE_DEG[column], title_of(pairs[row]));
        canvas.text([centre[0], centre[1] + RADIUS + 22.0], Anchor::Middle, &words);
        mark(&mut canvas, centre, INCIDENCE_DEG[column]);
    }
    scale(&mut canvas, size, top);
    canvas.finish()
}

/// The BSDF at the middles of a disk's cells, sectors fastest.
fn disk(luminance: &Luminance<'_>, pair: Hemispheres, theta_deg: f64) -> Vec<f64> {
    let wi = luminance.light(theta_deg);
    let is_up = pair.is_from_front() == pair.is_reflection();
    let view = |cell: usize| -> Direction {
        let theta = (0.5 + (cell / SECTORS) as f64) / RINGS as f64 * core::f64::consts::FRAC_PI_2;
        let up = spherical(theta, (0.5 + (cell % SECTORS) as f64) / SECTORS as f64 * TAU);
        if is_up { up } else { through(up) }
    };
    (0..RINGS * SECTORS).map(|cell| luminance.bsdf(wi, view(cell))).collect()
}

/// A disk of cells; neighbours of a ring that have the same shade are drawn as one.
fn draw(canvas: &mut Canvas, centre: [f64; 2], values: &[f64], top: f64) {
    let shade = |value: f64| (height(value, top) * SHADES as f64) as usize;
    for (ring, values) in values.chunks_exact(SECTORS).enumerate() {
        let mut start = 0;
        while start < SECTORS {
            let same = values[start..].iter().take_while(|v| shade(**v) == shade(values[start])).count();
            canvas.area(&band(centre, ring, start, start + same), &colour(shade(values[start])));
            start += same;
        }
    }
}

/// The outline of a ring's cells from one sector to another; a little wider than they are, so that no gaps show.
fn band([x, y]: [f64; 2], ring: usize, from: usize, to: usize) -> Vec<[f64; 2]> {
    let point = |radius: f64, sector: usize| {
        let (sine, cosine) = (TAU * sector as f64 / SECTORS as f64).sin_cos();
        [x + radius * cosine, y - radius * sine]
    };
    let [inner, outer] = [ring as f64, ring as f64 + 1.15].map(|r| RADIUS * r / RINGS as f64);
    let there = (from..=to).map(|sector| point(outer, sector));
    there.chain((from..=to).rev().map(|sector| point(inner, sector))).collect()
}

/// Where the light comes from, and the mirror direction.
fn mark(canvas: &mut Canvas, [x, y]: [f64; 2], theta_deg: f64) {
    let distance = RADIUS * theta_deg / 90.0;
    canvas.circle([x - distance, y], 4.0, "white");
    canvas.line([x + distance - 4.0, y], [x + distance + 4.0, y], "white");
    canvas.line([x + distance, y - 4.0], [x + distance, y + 4.0], "white");
}

/// The colour scale with its decades.
fn scale(canvas: &mut Canvas, [width, height]: [f64; 2], top: f64) {
    let (left, length, y) = (60.0, width - 260.0, height - FOOT + 8.0);
    for shade in 0..=SHADES {
        let [x0, x1] = [shade, shade + 1].map(|s| left + length * s as f64 / (SHADES + 1) as f64);
        canvas.area(&[[x0, y], [x1 + 0.5, y], [x1 + 0.5, y + 12.0], [x0, y + 12.0]], &colour(shade));
    }
    for step in 0..=DECADES as u32 {
        let x = left + length * f64::from(step) / DECADES;
        canvas.text([x, y + 28.0], Anchor::Middle, &power_of_ten(top - DECADES + f64::from(step)));
    }
    canvas.text([width - 20.0, y + 11.0], Anchor::End, "BSDF, 1/sr; ○ light, + mirror");
}

/// What a row shows.
fn title_of(pair: Hemispheres) -> &'static str {
    if pair.is_reflection() { "reflected" } else { "transmitted" }
}

/// The colour of a shade, as SVG names it.
fn colour(shade: usize) -> String {
    let place = shade as f64 / SHADES as f64 * (COLOURS.len() - 1) as f64;
    let low = (place as usize).min(COLOURS.len() - 2);
    let t = place - low as f64;
    let [r, g, b] = [0, 1, 2].map(|c| (COLOURS[low][c] * (1.0 - t) + COLOURS[low + 1][c] * t).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
