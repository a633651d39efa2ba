//! What was measured, for machines.

use crate::{arguments::GoniometerOptions, messages::diagnostics_json, photometry};
use gonio::{
    Diagnostic,
    goniometer::{Reading, Value as Measured, colour},
};
use gonio_formats::photometry::measured::{MeasuredSpread, Reduced, WithError};
use serde_json::{Value, json};

/// Everything in one object.
pub(super) fn as_json(options: &GoniometerOptions, reading: &Reading, reduced: &Reduced, diagnostics: &[Diagnostic]) -> Value {
    let figures = reduced.figures();
    let fluxes = &reading.fluxes;
    let of = |value: WithError| json!({ "value": value.value, "standard_error": value.error });
    let value = |value: Measured| of(WithError { value: value.value, error: value.error });
    let spreads =
        |spreads: [MeasuredSpread; 2]| spreads.map(|spread| json!({ "value": spread.spread.angle(), "standard_error": spread.error }));
    let gammas = reading.angles.gamma.len();
    let rows = |values: &[f64]| values.chunks(gammas).map(<[f64]>::to_vec).collect::<Vec<_>>();
    json!({
        "luminaire": options.luminaire,
        "c_deg": reading.angles.c,
        "gamma_deg": reading.angles.gamma,
        "intensities_cd": rows(&reading.intensities),
        "standard_errors_cd": rows(&reading.errors),
        "emitted_lm": value(fluxes.emitted),
        "flux_lm": value(fluxes.escaped),
        "flux_up_lm": value(fluxes.up),
        "absorbed_lm": value(fluxes.absorbed),
        "cut_off_lm": value(fluxes.cut_off),
        "light_output_ratio": reading.light_output_ratio().map(value),
        "downward_fraction": of(figures.downward_fraction),
        "symmetry": photometry::symmetry_name(reduced.goniogram.symmetry),
        "peak_cd": of(figures.peak),
        "peak_direction_deg": figures.peak_direction,
        "beam_angle_deg": spreads(figures.beam),
        "field_angle_deg": spreads(figures.field),
        "beam_aside": figures.aside.as_ref().map(photometry::aside_json),
        "opening_m": json!({
            "min": reading.opening.bounds[0],
            "max": reading.opening.bounds[1],
            "round": reading.opening.is_round(),
            "area_m2": reading.opening.area,
            "parts": reading.opening.parts.iter().map(|[min, max]| json!({ "min": min, "max": max })).collect::<Vec<_>>(),
            "in_files": {
                "shape": photometry::shape_name(reading.opening.shape.shape),
                "size_m": reading.opening.shape.size,
                "side_heights_m": reading.opening.shape.heights,
            },
        }),
        "body_m": json!({ "min": reading.body[0], "max": reading.body[1] }),
        "chromaticity": colour::chromaticity(reading.escaped_rgb),
        "chromaticity_1976": colour::uniform_chromaticity(reading.escaped_rgb),
        "colour_temperature_k": reading.colour_temperature(),
        "duv": reading.temperature_and_duv().map(|[_, duv]| duv),
        "screen": reading.screen.as_ref().map(|screen| json!({
            "size": screen.screen.size,
            "illuminance_lx": screen.illuminance,
            "standard_errors_lx": screen.errors,
        })),
        "rays": reading.paths,
        "seconds": reading.elapsed.as_secs_f64(),
        "converged": reading.converged,
        "diagnostics": diagnostics_json(diagnostics),
    })
}
