//! A spectrum and TM-30's colour vector graphic side by side, as SVG.

mod vectors;

use crate::{
    figures::Figures,
    observer::{OBSERVED, cie_1931},
    rendering::TOLERANCE,
    source::Spectrum,
};
use gonio_formats::escape;
use std::fmt::Write;

/// The page in pixels.
const PAGE: [f64; 2] = [880.0, 430.0];
/// The spectrum's frame: left, top, right, bottom.
const FRAME: [f64; 4] = [50.0, 70.0, 480.0, 370.0];
/// Wavelengths that are drawn, nm.
const SHOWN: [f64; 2] = [380.0, 780.0];
/// The widest strip of one colour, nm.
const STRIP: f64 = 2.0;

/// Draws the spectrum over 380 to 780 nm, its largest power there as the scale, and the colour vector graphic where the light is white.
pub fn spectrum_drawing(spectrum: &Spectrum, figures: &Figures) -> String {
    let [width, height] = PAGE;
    let mut page = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    text(&mut page, [20.0, 28.0], "start", 16, &spectrum.name);
    text(&mut page, [20.0, 48.0], "start", 12, &headline(figures));
    strips(&mut page, spectrum);
    axes(&mut page);
    match figures.white.as_ref().and_then(|white| white.rendition.as_ref()) {
        Some(rendition) => vectors::graphic(&mut page, rendition),
        None => text(&mut page, [690.0, 220.0], "middle", 12, "no colour vector graphic: not white"),
    }
    page.push_str("</svg>\n");
    page
}

/// Writing to a string cannot fail.
fn add(page: &mut String, element: std::fmt::Arguments<'_>) {
    let _ = writeln!(page, "{element}");
}

fn text(page: &mut String, [x, y]: [f64; 2], anchor: &str, size: u32, text: &str) {
    add(page, format_args!("<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{}</text>", escape(text)));
}

/// A line of figures.
fn headline(figures: &Figures) -> String {
    let Some(white) = &figures.white else {
        return format!("x {:.4}, y {:.4}", figures.xy[0], figures.xy[1]);
    };
    let tm30 = white.rendition.as_ref().map_or(String::new(), |tm30| format!(", Rf {:.0}, Rg {:.0}", tm30.rf, tm30.rg));
    let melanopic = figures.melanopic_der().map_or(String::new(), |der| format!(", melanopic DER {der:.2}"));
    let rendering = white.rendering.as_ref().map_or(String::new(), |rendering| {
        let doubt = if rendering.distance > TOLERANCE { " (outside of CIE 13.3's range)" } else { "" };
        format!(", Ra {:.0}{doubt}", rendering.ra)
    });
    format!("{:.0} K, Duv {:+.4}{rendering}{tm30}{melanopic}", white.cct, white.duv)
}

/// Where a wavelength and a share of the largest power lie.
fn place(nm: f64, share: f64) -> [f64; 2] {
    let [left, top, right, bottom] = FRAME;
    [left + (right - left) * (nm - SHOWN[0]) / (SHOWN[1] - SHOWN[0]), bottom - (bottom - top) * share]
}

/// Strips below the spectrum in its colours, and its line.
fn strips(page: &mut String, spectrum: &Spectrum) {
    let points: Vec<(f64, f64)> = shown(spectrum);
    let largest = points.iter().map(|(_, power)| *power).fold(0.0, f64::max);
    let at = |(nm, power): (f64, f64)| place(nm, if largest > 0.0 { power / largest } else { 0.0 });
    for pair in points.windows(2) {
        let [[x0, y0], [x1, y1]] = [at(pair[0]), at(pair[1])];
        let colour = hue(0.5 * (pair[0].0 + pair[1].0));
        let base = FRAME[3];
        // The same colour at the edge hides the seams between strips.
        add(
            page,
            format_args!(
                "<polygon points=\"{x0:.2},{base:.2} {x0:.2},{y0:.2} {x1:.2},{y1:.2} {x1:.2},{base:.2}\" \
                 fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"1\"/>"
            ),
        );
    }
    let line: String = points.iter().map(|point| at(*point)).map(|[x, y]| format!("{x:.2},{y:.2} ")).collect();
    add(page, format_args!("<polyline points=\"{}\" fill=\"none\" stroke=\"#333\"/>", line.trim_end()));
}

/// The points that are drawn: the spectrum's own, at most as many as pixels, and others between them where the colour changes.
fn shown(spectrum: &Spectrum) -> Vec<(f64, f64)> {
    let least = 0.25;
    let mut points: Vec<(f64, f64)> = Vec::new();
    for node in spectrum.nodes().iter().filter(|node| (SHOWN[0]..=SHOWN[1]).contains(&node.nm)) {
        let Some(&(nm, power)) = points.last() else {
            points.push((node.nm, node.power));
            continue;
        };
        if node.nm - nm < least {
            // Narrow lines keep their height.
            let end = points.len() - 1;
            points[end].1 = power.max(node.power);
            continue;
        }
        let parts = ((node.nm - nm) / STRIP).ceil();
        points.extend((1..=parts as usize).map(|part| {
            let t = part as f64 / parts;
            (nm + t * (node.nm - nm), power + t * (node.power - power))
        }));
    }
    points
}

fn axes(page: &mut String) {
    let [left, top, right, bottom] = FRAME;
    let grey = "stroke=\"#999\"";
    add(page, format_args!("<line x1=\"{left}\" y1=\"{bottom}\" x2=\"{right}\" y2=\"{bottom}\" {grey}/>"));
    add(page, format_args!("<line x1=\"{left}\" y1=\"{top}\" x2=\"{left}\" y2=\"{bottom}\" {grey}/>"));
    for nm in (400..=750).step_by(50) {
        let [x, y] = place(f64::from(nm), 0.0);
        add(page, format_args!("<line x1=\"{x:.2}\" y1=\"{y:.2}\" x2=\"{x:.2}\" y2=\"{:.2}\" {grey}/>", y + 4.0));
        text(page, [x, y + 18.0], "middle", 12, &nm.to_string());
    }
    for share in [0.0, 0.5, 1.0] {
        let [x, y] = place(SHOWN[0], share);
        add(page, format_args!("<line x1=\"{:.2}\" y1=\"{y:.2}\" x2=\"{x:.2}\" y2=\"{y:.2}\" {grey}/>", x - 4.0));
        text(page, [x - 8.0, y + 4.0], "end", 12, &share.to_string());
    }
    text(page, [0.5 * (left + right), bottom + 38.0], "middle", 12, "wavelength, nm; power over the largest");
}

/// A wavelength's colour on a screen: its chromaticity's nearest in sRGB, dim towards the ends.
fn hue(nm: f64) -> String {
    let [x, y, z] = cie_1931(nm.clamp(OBSERVED[0], OBSERVED[1]));
    let rgb = [3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z, 0.0557 * x - 0.2040 * y + 1.0570 * z];
    let rgb = rgb.map(|c| c.max(0.0));
    let largest = rgb.iter().copied().fold(1e-9, f64::max);
    let dim = (0.25 + 0.75 * (largest / 0.3).min(1.0)).min(1.0);
    screen(rgb.map(|c| dim * c / largest))
}

/// Linear sRGB as a page has it.
fn screen(rgb: [f64; 3]) -> String {
    let code = |c: f64| {
        let c = c.clamp(0.0, 1.0);
        (255.0 * if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }).round() as u8
    };
    let [r, g, b] = rgb.map(code);
    format!("#{r:02x}{g:02x}{b:02x}")
}
