//! What was measured, for readers.

use crate::{arguments::GoniometerOptions, photometry, progress::clock, words::Words};
use gonio::goniometer::{Fluxes, Opening, Reading, ScreenReading, Value, colour};
use gonio_formats::photometry::measured::{MeasuredSpread, Reduced};

/// Line by line.
pub(super) fn as_text(options: &GoniometerOptions, reading: &Reading, reduced: &Reduced) -> Vec<String> {
    let mut lines = vec![format!("luminaire: {}", options.luminaire)];
    lines.extend(fluxes(reading));
    lines.extend(figures(reading, reduced));
    lines.extend(colours(reading));
    lines.extend(reading.screen.as_ref().map(screen));
    lines.push(rays(reading));
    lines.extend(options.output.iter().map(|path| format!("written: {}", path.display())));
    lines
}

/// A value with its standard error, as exact as that is.
fn with_error(value: Value) -> String {
    let digits = if value.error > 0.0 { (1.0 - value.error.log10().floor()).clamp(0.0, 6.0) as usize } else { 2 };
    format!("{:.digits$} ± {:.digits$}", value.value, value.error)
}

fn fluxes(reading: &Reading) -> Vec<String> {
    let Fluxes { emitted, escaped, absorbed, cut_off, .. } = reading.fluxes;
    let share = |value: Value| if emitted.value > 0.0 { 100.0 * value.value / emitted.value } else { 0.0 };
    let ratio = reading.light_output_ratio().map_or(String::new(), |ratio| {
        let percents = Value { value: 100.0 * ratio.value, error: 100.0 * ratio.error };
        format!(", light output ratio {} %", with_error(percents))
    });
    // What is 0 but for noise is not below.
    let none = if absorbed.value == 0.0 && absorbed.error > 0.0 { ", nothing within the noise" } else { "" };
    vec![
        format!("sources: {:.1} lm", emitted.value),
        format!("flux: {} lm{ratio}", with_error(escaped)),
        format!("absorbed: {} lm ({:.2} %){none}", with_error(absorbed), share(absorbed)),
        format!("cut off: {} lm ({:.2} %)", with_error(cut_off), share(cut_off)),
    ]
}

fn figures(reading: &Reading, reduced: &Reduced) -> Vec<String> {
    let figures = reduced.figures();
    let symmetry = photometry::symmetry_name(reduced.goniogram.symmetry);
    let (planes, gammas) = (reading.angles.c.len(), reading.angles.gamma.len());
    let [c, gamma] = figures.peak_direction;
    let peak = Value { value: figures.peak.value, error: figures.peak.error };
    let spreads = |spreads: [MeasuredSpread; 2]| {
        let [c0, c90] = spreads.map(spread);
        let about = if spreads[0].spread.up { ", about zenith" } else { "" };
        format!("{c0} in C0–C180, {c90} in C90–C270{about}")
    };
    let [bx, by, bz] = [0, 1, 2].map(|k| reading.body[1][k] - reading.body[0][k]);
    let below = Value { value: 100.0 * figures.downward_fraction.value, error: 100.0 * figures.downward_fraction.error };
    let mut lines = vec![
        format!("photometry: {planes} planes of {gammas} angles, {symmetry}"),
        format!("downwards: {} %", with_error(below)),
        format!("peak: {} cd at C {c}°, γ {gamma}°", with_error(peak)),
        format!("beam angle (50 %): {}", spreads(figures.beam)),
        format!("field angle (10 %): {}", spreads(figures.field)),
    ];
    lines.extend(figures.aside.as_ref().map(|aside| photometry::aside(aside, Words::english())));
    lines.extend(opening(&reading.opening));
    lines.push(format!("body: {bx:.4} × {by:.4} × {bz:.4} m"));
    lines
}

/// The angle between the ends of a beam, and how sure it is.
fn spread(measured: MeasuredSpread) -> String {
    let angle = measured.spread.angle();
    match measured.error {
        Some(error) => format!("{angle:.1}° ± {error:.1}°"),
        None if measured.spread.open != [false; 2] => format!("{angle:.1}° (to the horizon)"),
        None => format!("{angle:.1}° (not defined: hidden by noise)"),
    }
}

/// Where light leaves, and what files say of it.
fn opening(opening: &Opening) -> Vec<String> {
    let ([x, y, z], [cx, cy, cz]) = (opening.size(), opening.centre());
    let round = if opening.is_round() { "round, " } else { "" };
    let area = if opening.area > 0.0 { format!(", {:.6} m² seen", opening.area) } else { String::new() };
    let mut lines =
        vec![format!("opening: {round}{x:.4} × {y:.4} × {z:.4} m about {cx:.4}, {cy:.4}, {cz:.4} in the luminaire's axes{area}")];
    if opening.parts.len() > 1 {
        lines.push(format!("opening's parts: {}, apart from each other; files have one of the same luminous area", opening.parts.len()));
    }
    lines.push(format!("opening in files: {}", photometry::opening(&opening.shape, Words::english())));
    lines
}

fn colours(reading: &Reading) -> Option<String> {
    let rgb = reading.escaped_rgb;
    let [x, y] = colour::chromaticity(rgb).filter(|_| colour::is_coloured(rgb))?;
    let kelvin = reading.temperature_and_duv().map_or(String::new(), |[kelvin, duv]| format!(", {kelvin:.0} K, Duv {duv:+.4}"));
    let varies = if reading.varies_in_colour() { "; it differs by direction, --csv tells how" } else { "" };
    Some(format!("colour: x {x:.4}, y {y:.4}{kelvin}{varies}"))
}

fn screen(screen: &ScreenReading) -> String {
    let count = screen.illuminance.len() as f64;
    let mean = screen.illuminance.iter().sum::<f64>() / count;
    let [least, most] = screen.illuminance.iter().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], x| [a.min(*x), b.max(*x)]);
    let [columns, rows] = screen.screen.size;
    format!("screen: {columns} × {rows} points, {mean:.2} lx in the mean, {least:.2} to {most:.2} lx")
}

fn rays(reading: &Reading) -> String {
    let seconds = reading.elapsed.as_secs_f64().max(1e-3);
    let millions = reading.paths as f64 * 1e-6;
    let short = if reading.converged { "" } else { "; the error that was asked for was not reached" };
    format!("rays: {millions:.1} M in {}, {:.1} M a second{short}", clock(reading.elapsed), millions / seconds)
}
