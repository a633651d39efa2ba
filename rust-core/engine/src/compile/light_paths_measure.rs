//! Which lights' light meters get of light paths, where mirrors and clear glass send it on: that which a meter's own paths would seldom or never meet.
//!
//! Pictures weigh noise against time (`light_paths_pay`). A meter that misses light shows a wrong figure without noise, so little is left to chance here.

use super::{
    compiled::CompiledScene,
    light_paths_pay::{self, Brought, dome_mean, is_sizeless, mean},
};
use crate::{
    bsdf::{
        Surface,
        parameter::{COAT_ROUGHNESS, ROUGHNESS},
    },
    light::{EmissionSampler, LightKind, LightRecord},
    scene::{Caustics, Integrator, Settings},
};
use std::{f64::consts::PI, iter::once, sync::atomic::AtomicBool};

/// Batches of light paths that tell it.
const BATCHES: u64 = 8;
/// Variance of a meter's path from such light of a light, in squares of the light that it would give without mirrors and glass, from which light paths
/// bring it: thousands of paths meet it often enough below.
const LEAST_NOISE: f64 = 10.0;

/// Roughness below which facets are mirrors.
const SMOOTH: f32 = 5e-3;

/// Whether light may come by glass that is rough, or by clear glass and then by what scatters in the air, which is no business of light paths else.
pub(crate) fn may_be_missed(scene: &CompiledScene, settings: &Settings) -> bool {
    let lights = &scene.tables.lights;
    let hides = has_rough_glass(scene) || sends_into_media(scene);
    settings.integrator == Integrator::Path && hides && !(0..lights.len() as u32).any(|light| lights.has_falloff(light))
}

/// Whether mirrors and clear glass may send light into what scatters it.
pub(super) fn sends_into_media(scene: &CompiledScene) -> bool {
    scene.tables.materials.media.scatters() && bends_light(scene)
}

/// Whether there is any.
pub(crate) fn has_rough_glass(scene: &CompiledScene) -> bool {
    let rough = |surface: &Surface| surface.lobes.transmission && !surface.lobes.smooth;
    scene.tables.materials.surfaces.iter().any(|material| rough(&material.surface))
}

/// Whether anything sends light on sharply that no straight ray comes through: mirrors and solid clear glass.
pub(crate) fn bends_light(scene: &CompiledScene) -> bool {
    scene.tables.materials.surfaces.iter().any(|material| material.surface.lobes.smooth && !material.lets_light_pass)
}

/// How light paths of all lights start.
pub(crate) fn all_light(scene: &CompiledScene) -> EmissionSampler {
    let (centre, radius) = scene.bounds.sphere(scene.tables.origin);
    EmissionSampler::new(&scene.tables.lights, None, (centre, (radius * (1.0 + 1e-5)) as f32), &[])
}

/// Whether anything sends light on sharply: mirrors and clear glass, and the polish on what else is not.
fn sends_on(scene: &CompiledScene) -> bool {
    let polished = |surface: &Surface| {
        let [base, coat] = [ROUGHNESS, COAT_ROUGHNESS].map(|place| surface.constants[place] < SMOOTH);
        surface.lobes.specular && base || surface.lobes.coat && coat
    };
    !scene.casters.targets.is_empty() || scene.tables.materials.surfaces.iter().any(|material| polished(&material.surface))
}

/// By light, whether light paths bring its light to meters that lie within `reach` metres of the scene's middle; none where nothing has to be brought.
pub(crate) fn for_meters(scene: &CompiledScene, settings: &Settings, reach: f64, cancel: &AtomicBool) -> Option<Vec<bool>> {
    if !sends_on(scene) || settings.integrator != Integrator::Path {
        return None;
    }
    if settings.caustics == Caustics::On {
        return Some(light_paths_pay::starts(scene));
    }
    let (brought, escaped) = light_paths_pay::trace(scene, settings, BATCHES, cancel);
    let all = with_escaped(&brought, &escaped);
    let records = scene.kept.lights.records();
    let either = |noise: &dyn Fn(&[Brought]) -> f64| noise(&brought) >= LEAST_NOISE || noise(&all) >= LEAST_NOISE;
    let is_triangle = |(record, _): &(&LightRecord, &Brought)| record.kind == LightKind::Triangle;
    let triangles = either(&|brought| noise(reach, records.iter().zip(brought).filter(is_triangle)));
    let starts = (0..).zip(records).map(|(light, record)| {
        if scene.tables.lights.has_falloff(light) {
            return false;
        }
        match record.kind {
            LightKind::Dome => is_peaked(scene, record),
            LightKind::Triangle => triangles,
            _ if is_sizeless(record) && record.opening.is_none() => true,
            _ => either(&|brought| noise(reach, once((record, &brought[light as usize])))),
        }
    });
    Some(starts.collect()).filter(|starts: &Vec<bool>| starts.contains(&true))
}

/// Scatterings that light has on its way through a pane.
const THROUGH_A_PANE: u32 = 2;

/// Whether paths with these settings miss light that mirrors and clear glass send on, while none of light is followed: by other integrators than path
/// tracing, without caustics, or where paths end before they are through.
pub(crate) fn is_left_out(scene: &CompiledScene, settings: &Settings, reach: f64, cancel: &AtomicBool) -> bool {
    let max_bounces = settings.max_bounces.max(THROUGH_A_PANE);
    let whole = Settings { integrator: Integrator::Path, caustics: Caustics::Auto, max_bounces, ..settings.clone() };
    settings.integrator != Integrator::Light && for_meters(scene, &whole, reach, cancel).is_some()
}

/// Whether meters' paths end before light can have come through glass.
pub(crate) fn are_followed(settings: &Settings) -> bool {
    settings.integrator == Integrator::Path && settings.max_bounces >= THROUGH_A_PANE
}

/// What arrives of each light, and its part of what leaves the scene by what of all arrives: a meter may stand where no surface is.
fn with_escaped(brought: &[Brought], escaped: &Brought) -> Vec<Brought> {
    let arrived: f64 = brought.iter().map(|b| b.straight + b.by_casters).sum();
    let with_part = |b: &Brought| {
        let part = if arrived > 0.0 { (b.straight + b.by_casters) / arrived } else { 1.0 / brought.len() as f64 };
        Brought { straight: b.straight + part * escaped.straight, by_casters: b.by_casters + part * escaped.by_casters }
    };
    brought.iter().map(with_part).collect()
}

/// The variance for lights together, see [`LEAST_NOISE`], of meters that lie within a radius in metres.
fn noise<'a>(radius: f64, lights: impl Iterator<Item = (&'a LightRecord, &'a Brought)>) -> f64 {
    let (mut total, mut sent_on) = (0.0, 0.0);
    for (record, Brought { straight, by_casters }) in lights {
        total += straight + by_casters;
        sent_on += radiance(record, straight + by_casters) * by_casters;
    }
    if total > 0.0 { 4.0 * PI * PI * radius * radius * sent_on / (total * total) } else { 0.0 }
}

/// About the radiance of a light that sends a flux; that of an opening is not at hand, but its area.
fn radiance(record: &LightRecord, flux: f64) -> f64 {
    if record.opening.is_none() {
        return mean(record.radiance.map(f32::abs));
    }
    let [a, b, ..] = record.to_world.map(|axis| axis.map(f64::from));
    let cross = [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
    let area = 4.0 * cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    if area > 0.0 { flux / (PI * area) } else { f64::MAX }
}

/// Whether a dome has its light from a small part of it, as pictures of skies with a sun have.
fn is_peaked(scene: &CompiledScene, record: &LightRecord) -> bool {
    let images = scene.kept.lights.images();
    let [once, twice] = [dome_mean(record, images, |radiance| radiance), dome_mean(record, images, |radiance| radiance * radiance)];
    once > 0.0 && twice >= LEAST_NOISE * once * once
}
