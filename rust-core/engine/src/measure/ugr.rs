//! The Unified Glare Rating of a scene's luminaires at observers' places (CIE 117).
//!
//! UGR = 8 log₁₀(0.25 / L_b · Σ L² ω / p²), one term for each luminaire ahead whose centre is seen: L = I / A is its mean luminance towards the eye,
//! ω = A / r² the solid angle of its luminous parts, p Guth's position index. Small sources count as CIE 147 has it, as if they had 0.005 m²; points
//! thereby have a rating too. The background's luminance L_b is the illuminance at the eye without the luminaires' direct light, over π.

use super::{
    Watch,
    daylight_factor::without_emission,
    glare::position_index,
    reading::Reading,
    sense::{Probe, sense},
    vector::{Vector, cross, dot, length, scaled, subtract, unit},
};
use crate::{
    accel::{RayBatch, SceneBvh},
    compile::{CompiledScene, Luminaire, compile, is_luminaire, luminaires},
    error::{Diagnostic, Error, Result},
    integrator::ray_mask,
    scene::{Integrator, Light, Meter, Scene, Settings},
};
use gonio_simd::Execution;
use std::{f64::consts::PI, sync::Arc};

/// Square metres below which a source counts as small (CIE 147).
const SMALL: f64 = 0.005;
/// Share of the way to a luminaire's centre that must be free: its own housing may begin there.
const FREE: f64 = 1.0 - 1e-4;

/// An observer's eye.
#[derive(Clone, Copy, Debug)]
struct Eye {
    position: Vector,
    /// Right, up and ahead; unit.
    axes: [Vector; 3],
}

impl Eye {
    /// A meter's `facing` is the line of sight, its `normal` tells where up is.
    fn new(meter: &Meter) -> Result<Self> {
        let found = || {
            let ahead = unit(meter.facing)?;
            let right = unit(cross(ahead, unit(meter.normal)?))?;
            Some([right, cross(right, ahead), ahead])
        };
        let problem = "an observer wants a line of sight (facing) and a way up (normal) that is not along it";
        Ok(Self { position: meter.position, axes: found().ok_or_else(|| Error::scene(&meter.origin, problem))? })
    }

    /// L² ω / p² of a luminaire, seen or not; 0 of what is not ahead.
    fn glare(&self, luminaire: &Luminaire) -> f64 {
        let way = subtract(luminaire.centre, self.position);
        let (distance, Some(towards)) = (length(way), unit(way)) else { return 0.0 };
        let direction = self.axes.map(|axis| dot(axis, towards));
        if direction[2] <= 0.0 {
            return 0.0;
        }
        let [intensity, area] = luminaire.far_field.seen_from(scaled(towards, -1.0));
        (intensity / (distance * position_index(direction))).powi(2) / area.max(SMALL)
    }
}

/// Ratings at all observers. 0 where no luminaire is seen or the rating is below; infinite where the luminaires stand before utter darkness.
pub(super) fn ratings(
    scene: &Scene,
    meters: &[&Meter],
    execution: Execution,
    watch: &mut Watch<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Reading>> {
    let eyes = meters.iter().map(|meter| Eye::new(meter)).collect::<Result<Vec<_>>>()?;
    let probes = meters.iter().map(|meter| Probe::new(meter)).collect::<Result<Vec<_>>>()?;
    let compiled = Arc::new(compile(scene, watch.previous, watch.cancel)?);
    diagnostics.extend(compiled.diagnostics.iter().cloned());
    let all = sense(compiled.clone(), &probes, &scene.settings, execution, watch.progress)?;
    let alone = under_luminaires(scene);
    let under_them = Arc::new(compile(&alone, Some(&compiled), watch.cancel)?);
    let direct = sense(under_them, &probes, &alone.settings, execution, watch.progress)?;
    let luminaires = luminaires(scene);
    let rated = eyes.iter().zip(all.iter().zip(&direct)).map(|(eye, (all, direct))| {
        let background =
            Reading { value: (all.value - direct.value).max(0.0), standard_error: all.standard_error.hypot(direct.standard_error) };
        rating(seen_glare(eye, &luminaires, &compiled), &background)
    });
    Ok(rated.collect())
}

/// The luminaires' direct light alone.
fn under_luminaires(scene: &Scene) -> Scene {
    let lights: Vec<Light> = scene.lights.iter().filter(|light| is_luminaire(light)).cloned().collect();
    let settings = Settings { integrator: Integrator::Direct, ..scene.settings.clone() };
    Scene { lights, materials: scene.materials.iter().map(without_emission).collect(), settings, ..scene.clone() }
}

/// By the sum over the sources and the background's illuminance at the eye.
fn rating(sum: f64, background: &Reading) -> Reading {
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

/// Σ L² ω / p² over the luminaires that nothing opaque hides.
fn seen_glare(eye: &Eye, luminaires: &[Luminaire], compiled: &CompiledScene) -> f64 {
    let glaring = luminaires.iter().map(|luminaire| (luminaire, eye.glare(luminaire))).filter(|(_, glare)| *glare > 0.0);
    let seen = |luminaire: &Luminaire| !luminaire.casts_shadow || is_free(&compiled.tables.bvh, compiled.tables.origin, eye, luminaire);
    glaring.filter(|(luminaire, _)| seen(luminaire)).map(|(_, glare)| glare).sum()
}

/// Whether nothing opaque stands between an eye and a luminaire's centre.
fn is_free(bvh: &SceneBvh, origin: Vector, eye: &Eye, luminaire: &Luminaire) -> bool {
    let from = subtract(eye.position, origin).map(|x| [x as f32]);
    let way = subtract(luminaire.centre, eye.position).map(|x| [x as f32]);
    let rays = RayBatch {
        origin: from.each_ref().map(|x| &x[..]),
        direction: way.each_ref().map(|x| &x[..]),
        t_min: &[0.0],
        t_max: &[FREE as f32],
        mask: &[ray_mask::SHADOW],
    };
    let mut blocked = [0];
    bvh.blocked_or_passed_scalar(&rays, &mut blocked, &mut Vec::new());
    blocked == [0]
}
