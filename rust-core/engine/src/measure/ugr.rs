//! The Unified Glare Rating of a scene's luminaires at observers' places (CIE 117).
//!
//! UGR = 8 log₁₀(0.25 / L_b · Σ L² ω / p²), summed over the luminous parts that the eye sees: L is the luminance towards the eye, ω the solid angle,
//! p Guth's position index as CIE 117 tabulates it; what is not in its table is left out. Small luminaires have CIE 147's formula, which UGR tables do
//! not know: where there are any, the rating without it stands beside the other. The background's luminance L_b is the illuminance at the eye without the luminaires' direct light, over π.

use super::{
    eye::{Eye, Share},
    glare::Coverage,
    reading::{Reading, SmallSources},
    sense::{Probe, Sensed, sense},
    watch::Watch,
};
use crate::{
    compile::{compile, luminaires},
    error::{Diagnostic, Result},
    scene::{Integrator, Light, Meter, Scene, Settings},
};
use gonio_simd::Execution;
use std::{f64::consts::PI, sync::Arc};

/// A rating with what it leaves out, and with small sources.
pub(super) type Rating = (Reading, Coverage, SmallSources);

/// Ratings at all observers with what they leave out. 0 where no luminaire is seen or the rating is below; infinite where the luminaires stand before utter darkness.
pub(super) fn ratings(
    scene: &Scene,
    meters: &[&Meter],
    execution: Execution,
    watch: &mut Watch<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Rating>> {
    let eyes = meters.iter().map(|meter| Eye::new(meter)).collect::<Result<Vec<_>>>()?;
    let probes = meters.iter().map(|meter| Probe::new(meter)).collect::<Result<Vec<_>>>()?;
    let compiled = Arc::new(compile(scene, watch.previous, watch.cancel)?);
    diagnostics.extend(compiled.diagnostics.iter().cloned());
    let Sensed { readings: all, discs, .. } = sense(&compiled, &probes, &scene.settings, execution, watch)?;
    if let (Some(_), Some(first)) = (discs, meters.first()) {
        let message = "light of luminaires that mirrors and clear glass send to the eye counts as background: as a source each is rated where it is \
                       seen directly";
        diagnostics.push(Diagnostic::info(&first.origin, message));
    }
    let alone = under_luminaires(scene);
    let under_them = Arc::new(compile(&alone, Some(&compiled), watch.cancel)?);
    let direct = sense(&under_them, &probes, &alone.settings, execution, watch)?.readings;
    for light in scene.lights.iter().filter(|light| light.is_luminaire() && light.takes_away()) {
        diagnostics.push(Diagnostic::warning(&light.origin, "it takes light away, and so is no source of glare"));
    }
    let luminaires = luminaires(scene, compiled.tables.origin, &compiled.light_images.means(scene));
    let rated = eyes.iter().zip(all.iter().zip(&direct)).map(|(eye, (all, direct))| {
        let rest = if all.is_known() { (all.value - direct.value).max(0.0) } else { all.value };
        let background = Reading { value: rest, standard_error: all.standard_error.hypot(direct.standard_error) };
        let mut coverage = Coverage::default();
        let shares: Vec<Share> = luminaires.iter().map(|luminaire| eye.glare(luminaire, &compiled, &mut coverage)).collect();
        let tabular: Option<f64> = shares.iter().map(|share| share.tabular).sum();
        let count = shares.iter().filter(|share| share.is_small).count();
        let small = SmallSources { count, tabular: tabular.map(|sum| rating(sum, &background)) };
        let sum: f64 = shares.iter().map(|share| share.sum).sum();
        // What is seen through glass alone is not rated, and zero would be a good mark.
        let found = if sum <= 0.0 && coverage.covered > 0 { Reading::UNKNOWN } else { rating(sum, &background) };
        (found, coverage, small)
    });
    Ok(rated.collect())
}

/// The luminaires' direct light alone.
fn under_luminaires(scene: &Scene) -> Scene {
    let lights: Vec<Light> = scene.lights.iter().filter(|light| light.is_luminaire()).cloned().collect();
    let settings = Settings { integrator: Integrator::Direct, ..scene.settings.clone() };
    Scene { lights, settings, ..scene.without_emission() }
}

/// By the sum over the sources and the background's illuminance at the eye.
fn rating(sum: f64, background: &Reading) -> Reading {
    if !background.is_known() {
        return *background;
    }
    if sum <= 0.0 {
        return Reading::default();
    }
    if background.value <= 0.0 {
        return Reading { value: f64::INFINITY, standard_error: 0.0 };
    }
    let value = 8.0 * (0.25 * PI / background.value * sum).log10();
    // d log₁₀ x = dx / (x ln 10).
    let error = 8.0 / std::f64::consts::LN_10 * background.standard_error / background.value;
    if value > 0.0 { Reading { value, standard_error: error } } else { Reading::default() }
}
