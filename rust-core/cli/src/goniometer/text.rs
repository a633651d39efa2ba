//! What was measured, for readers.

use crate::{arguments::GoniometerOptions, photometry, progress::clock};
use gonio::goniometer::{Fluxes, Reading, ScreenReading, Value, colour};
use gonio_formats::photometry::measured::Reduced;

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
    let Fluxes { emitted, escaped, absorbed, cut_off } = reading.fluxes;
    let share = |value: Value| if emitted.value > 0.0 { 100.0 * value.value / emitted.value } else { 0.0 };
    let ratio = reading.light_output_ratio().map_or(String::new(), |ratio| {
        let percents = Value { value: 100.0 * ratio.value, error: 100.0 * ratio.error };
        format!(", light output ratio {} %", with_error(percents))
    });
    vec![
        format!("sources: {:.1} lm", emitted.value),
        format!("flux: {} lm{ratio}", with_error(escaped)),
        format!("absorbed: {} lm ({:.2} %)", with_error(absorbed), share(absorbed)),
        format!("cut off: {} lm ({:.2} %)", with_error(cut_off), share(cut_off)),
    ]
}

fn figures(reading: &Reading, reduced: &Reduced) -> Vec<String> {
    let figures = reduced.figures();
    let symmetry = photometry::symmetry_name(reduced.goniogram.symmetry);
    let (planes, gammas) = (reading.angles.c.len(), reading.angles.gamma.len());
    let [c, gamma] = reduced.goniogram.figures().peak_direction;
    let peak = Value { value: figures.peak.value, error: figures.peak.error };
    let spreads = |spreads: [gonio_formats::photometry::measured::MeasuredSpread; 2]| {
        let [c0, c90] = spreads.map(|spread| {
            let error = spread.error.map_or(String::new(), |error| format!(" ± {error:.1}°"));
            format!("{:.1}°{error}", spread.spread.angle())
        });
        let about = if spreads[0].spread.up { ", about zenith" } else { "" };
        format!("{c0} in C0–C180, {c90} in C90–C270{about}")
    };
    let [x, y, z] = reading.opening.size();
    let round = if reading.opening.round { "round, " } else { "" };
    let [cx, cy, cz] = reading.opening.centre();
    let [bx, by, bz] = [0, 1, 2].map(|k| reading.body[1][k] - reading.body[0][k]);
    vec![
        format!("photometry: {planes} planes of {gammas} angles, {symmetry}"),
        format!("downwards: {:.1} %", 100.0 * figures.downward_fraction.value),
        format!("peak: {} cd at C {c}°, γ {gamma}°", with_error(peak)),
        format!("beam angle (50 %): {}", spreads(figures.beam)),
        format!("field angle (10 %): {}", spreads(figures.field)),
        format!("opening: {round}{x:.4} × {y:.4} × {z:.4} m about {cx:.4}, {cy:.4}, {cz:.4} in the luminaire's axes"),
        format!("body: {bx:.4} × {by:.4} × {bz:.4} m"),
    ]
}

fn colours(reading: &Reading) -> Option<String> {
    let rgb = reading.escaped_rgb;
    let [x, y] = colour::chromaticity(rgb).filter(|_| colour::is_coloured(rgb))?;
    let kelvin = reading.colour_temperature().map_or(String::new(), |kelvin| format!(", {kelvin:.0} K"));
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
