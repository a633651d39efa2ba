//! Whether light paths bring caustics by themselves: a few thousand of them tell how much light mirrors and clear glass send on, and how noisy it
//! would be if camera paths had to meet the lights by chance.

use super::{casters, compiled::CompiledScene, light_paths_measure, view};
use crate::{
    error::{Diagnostic, Result},
    light::{EmissionSampler, LightKind, LightRecord, LightTexture},
    scene::{Aov, Caustics, Integrator, Origin, Scene, Settings},
    transport::{Arrivals, Arriving, Emission, Escapes, LIGHT_BATCH, LightTracer, Receiver, Wanted},
};
use gonio_simd::Execution;
use std::{
    f64::consts::PI,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// Batches of light paths that tell it of pictures.
const BATCHES: u64 = 1;
/// Other random numbers than splats and photons have, whatever the seed of the picture: frames of a sequence go one way.
const FIRST_BATCH: u64 = 3 << 62;
const SEED: u32 = 0;
/// Variance of a camera path from the light that mirrors and glass send on, in squares of the mean light, from which light paths pay: scenes of
/// `tests/peers` have up to 24 where they do not, and 300 and more where they do.
const LEAST_NOISE: f64 = 100.0;
/// Least part of all light that lights without size send on, which is lost where no light path brings it.
const LEAST_LOST: f64 = 0.02;
/// The same that is told where light paths do not run for it.
const LEAST_TOLD: f64 = 5e-3;
/// A light that sends most of what it lights by mirrors and glass decides for itself from this part of all light on.
const LEAST_SHARE: f64 = 1e-3;
/// Texels of a dome that its mean is taken of.
const TEXELS: usize = 4096;

/// Flux of a light that arrives on surfaces which are neither mirrors nor clear glass, of magnitudes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Brought {
    pub(super) straight: f64,
    pub(super) by_casters: f64,
}

impl Brought {
    fn add(&mut self, bounces: u32, flux: f64) {
        *(if bounces == 0 { &mut self.straight } else { &mut self.by_casters }) += flux;
    }
}

/// What decides.
#[derive(Clone, Copy, Debug, Default)]
struct Findings {
    /// See [`LEAST_NOISE`].
    noise: f64,
    /// Part of all light that lights without size send on.
    lost: f64,
    /// Whether a light is as good as shut in.
    shut_in: bool,
    /// The light of which mirrors and clear glass send most on, and the part of it.
    most: (usize, f64),
}

/// Whether the scene and settings go with light paths that bring caustics.
pub(crate) fn are_possible(scene: &CompiledScene, settings: &Settings) -> bool {
    !scene.casters.targets.is_empty()
        && settings.caustic_paths == [true; 2]
        && settings.integrator == Integrator::Path
        && !settings.antialiasing.is_adaptive()
        // Expressions that are followed know nothing of how light came to the surfaces that light paths bring it to.
        && !settings.aovs.iter().any(|aov| matches!(aov, Aov::LightExpression(_)))
        // What shadow catchers hide is compared path by path, from the camera.
        && scene.tables.geometry.set_catcher.is_empty()
}

/// By light, whether light paths start there. Rays that look for a wide sky find it better than its paths find the picture. Light that falls otherwise
/// than by nature has no flux to carry.
pub(crate) fn starts(scene: &CompiledScene) -> Vec<bool> {
    let lights = &scene.tables.lights;
    (0..lights.len() as u32).map(|light| !lights.is_dome(light) && !lights.has_falloff(light)).collect()
}

/// How paths start at these lights, half of them aimed at what casts caustics.
pub(crate) fn emission(scene: &CompiledScene, starts: &[bool]) -> EmissionSampler {
    let numbers: Vec<u32> = (0..).zip(starts).filter(|(_, starts)| **starts).map(|(light, _)| light).collect();
    let (centre, radius) = scene.bounds.sphere(scene.tables.origin);
    EmissionSampler::new(&scene.tables.lights, Some(&numbers), (centre, (radius * (1.0 + 1e-5)) as f32), &scene.casters.targets)
}

/// Decides for a scene whose settings leave it open, and says so where light paths are to run; `of_light` gives the scene's lights.
pub(super) fn decide(compiled: &mut CompiledScene, scene: &Scene, of_light: &[u32], cancel: &AtomicBool) -> Result<()> {
    if scene.settings.caustics == Caustics::Auto && are_possible(compiled, &scene.settings) {
        let (brought, _) = trace(compiled, &scene.settings, BATCHES, cancel);
        super::cancel::check(cancel)?;
        let found = findings(compiled, &brought);
        compiled.casters.pay =
            found.noise >= LEAST_NOISE || found.lost >= LEAST_LOST || found.shut_in || is_measured(compiled, scene, cancel);
        if compiled.casters.pay {
            let (light, part) = found.most;
            let light = of_light.get(light).and_then(|light| scene.lights.get(*light as usize)).map(|light| &light.origin);
            if let Some(origin) = light.or(compiled.casters.first.as_ref()) {
                compiled.diagnostics.push(Diagnostic::info(origin, message(part)));
            }
        } else if found.lost >= LEAST_TOLD
            && let Some(origin) = &compiled.casters.first
        {
            compiled.diagnostics.push(Diagnostic::info(origin, lost(found.lost)));
        }
    }
    let traced = match scene.settings.caustics {
        Caustics::Off => false,
        Caustics::Auto => compiled.casters.pay,
        Caustics::On => !compiled.casters.targets.is_empty(),
    };
    if traced {
        casters::report_blockers(scene, &compiled.tables.links, &mut compiled.diagnostics);
        if light_paths_measure::sends_into_media(compiled) {
            compiled.diagnostics.push(Diagnostic::warning(&Origin::default(), INTO_MEDIA));
        }
    }
    let sought = scene.settings.caustics == Caustics::Off || !are_possible(compiled, &scene.settings);
    if sought
        && scene.settings.aovs.contains(&Aov::Illuminance)
        && light_paths_measure::is_left_out(compiled, &scene.settings, compiled.bounds.radius(), cancel)
    {
        compiled.diagnostics.push(Diagnostic::warning(&Origin::default(), ILLUMINANCE_IN_PART));
    }
    Ok(())
}

/// Said where light paths do without what glass sends into media.
const INTO_MEDIA: &str = "light that mirrors and clear glass send into fog or other media is found by chance: in pictures, passes and bakes it is noisy, and \
    lacks the more the smaller its lamps are; meters, grids and illumination maps have it";

/// Said where the illuminance pass is not all of it.
const ILLUMINANCE_IN_PART: &str = "the illuminance pass leaves out light that mirrors and clear glass send on: it comes by light paths, which these \
    settings do without; they run with the integrator path, caustics auto or on, and samples that are the same number in all pixels";

/// Whether illuminances are wanted of light that camera paths would seldom or never find, be it a small part of all.
fn is_measured(compiled: &CompiledScene, scene: &Scene, cancel: &AtomicBool) -> bool {
    let wanted = scene.settings.aovs.contains(&Aov::Illuminance);
    let rare = || light_paths_measure::for_meters(compiled, &scene.settings, compiled.bounds.radius(), cancel);
    wanted && rare().is_some_and(|rare| rare.iter().zip(starts(compiled)).any(|(rare, starts)| *rare && starts))
}

fn message(part: f64) -> String {
    let part = if part < 0.01 { "some".to_owned() } else { format!("{:.0} %", 100.0 * part) };
    format!("mirrors and clear glass send on {part} of its light, which camera paths seldom find; light paths bring it (caustics)")
}

fn lost(part: f64) -> String {
    let part = 100.0 * part;
    format!(
        "mirrors and clear glass such as this send on {part:.2} % of the light, from lamps without extent, which no camera path finds: pictures leave it out; \
         with caustics 'on' light paths bring it"
    )
}

/// What a few light paths bring, light by light, and what of all of them leaves the scene.
pub(super) fn trace(compiled: &CompiledScene, settings: &Settings, batches: u64, cancel: &AtomicBool) -> (Vec<Brought>, Brought) {
    let tables = &compiled.tables;
    let mut tally = Tally { arrived: vec![Brought::default(); tables.lights.len()], escaped: Brought::default() };
    let sampler = emission(compiled, &starts(compiled));
    if sampler.is_empty() {
        return (tally.arrived, tally.escaped);
    }
    let settings = Settings { seed: SEED, ..settings.clone() };
    let transport = view::transport(compiled, &settings, Execution::detect(), [0.0; 3], [0.0, 0.0, -1.0]);
    let wanted = Wanted { arrivals: Arriving::Photons, specular_only: true, picture: None };
    let tracer = LightTracer { tables, transport: &transport, emission: Emission::Lights(&sampler), wanted };
    let mut workspace = compiled.workspaces.take();
    for batch in 0..batches {
        tracer.trace(FIRST_BATCH | batch, &mut tally, &mut Vec::new(), &mut workspace, &|| cancel.load(Ordering::Relaxed));
    }
    compiled.workspaces.leave(workspace);
    let share = 1.0 / (batches * LIGHT_BATCH as u64) as f64;
    let of_path = |b: &Brought| Brought { straight: b.straight * share, by_casters: b.by_casters * share };
    (tally.arrived.iter().map(of_path).collect(), of_path(&tally.escaped))
}

/// Adds up what arrives, light by light, and what leaves the scene.
struct Tally {
    arrived: Vec<Brought>,
    escaped: Brought,
}

impl Receiver for Tally {
    fn arrived(&mut self, arrivals: &Arrivals) {
        for entry in 0..arrivals.count {
            let flux = [0, 1, 2].map(|axis| arrivals.flux[axis][entry]);
            if let Some(of_light) = self.arrived.get_mut(arrivals.light[entry] as usize) {
                of_light.add(arrivals.bounces(entry), mean(flux.map(f32::abs)));
            }
        }
    }
    fn escaped(&mut self, escapes: &Escapes) {
        for entry in 0..escapes.count {
            self.escaped.add(escapes.bounces[entry], mean([0, 1, 2].map(|axis| escapes.flux[axis][entry].abs())));
        }
    }
}

/// What follows of it.
///
/// Where light of radiance L brings irradiance E by mirrors and glass, a camera path meets it with probability E / (π L) and then finds L: a variance of
/// L E / π. It is told in squares of the mean light, E₀ / π, over surfaces as large as the scene's sphere.
fn findings(compiled: &CompiledScene, brought: &[Brought]) -> Findings {
    let records = compiled.kept.lights.records();
    let radius = compiled.bounds.radius();
    let area = 4.0 * PI * radius * radius;
    let of_lights: f64 = brought.iter().map(|b| b.straight + b.by_casters).sum();
    let domes = records.iter().filter(|record| record.kind == LightKind::Dome);
    // Half of what comes through the sphere.
    let of_domes: f64 = domes.map(|dome| 2.0 * PI * PI * radius * radius * dome_radiance(dome, compiled.kept.lights.images())).sum();
    let total = of_lights + of_domes;
    let (mut found, mut most) = (Findings::default(), 0.0);
    if !(of_lights > 0.0 && total.is_finite()) {
        return found;
    }
    for (light, (brought, record)) in brought.iter().zip(records).enumerate() {
        let Brought { straight, by_casters } = *brought;
        let own = by_casters / (straight + by_casters).max(f64::MIN_POSITIVE);
        let sizeless = is_sizeless(record);
        // Noise if there were no other light; radiances of openings are not at hand.
        let alone = match record.opening {
            Some(_) => 0.0,
            None => PI * mean(record.radiance.map(f32::abs)) * by_casters * area / (straight + by_casters).max(f64::MIN_POSITIVE).powi(2),
        };
        if sizeless && record.opening.is_none() {
            found.lost += by_casters / total;
        } else {
            found.noise += alone * ((straight + by_casters) / total).powi(2);
        }
        found.shut_in |= own >= 0.5 && by_casters >= LEAST_SHARE * total && (sizeless || alone >= LEAST_NOISE);
        if by_casters > most {
            (most, found.most) = (by_casters, (light, own));
        }
    }
    found
}

/// Whether no ray finds the light by chance, its opening left aside.
pub(super) fn is_sizeless(record: &LightRecord) -> bool {
    record.kind == LightKind::Point || (record.kind == LightKind::Distant && record.angle <= 0.0)
}

/// Mean radiance of a dome, cd/m².
fn dome_radiance(record: &LightRecord, images: &[Arc<LightTexture>]) -> f64 {
    dome_mean(record, images, |radiance| radiance)
}

/// The mean of a function of the magnitude of a dome's radiance over all directions.
pub(super) fn dome_mean(record: &LightRecord, images: &[Arc<LightTexture>], of: impl Fn(f64) -> f64) -> f64 {
    let image = record.texture.and_then(|number| images.get(number as usize)).filter(|image| image.width * image.height > 0);
    let own = mean(record.radiance.map(f32::abs));
    let found = image.map_or(of(own), |image| {
        let step = (image.width * image.height / TEXELS).max(1);
        // Rows shrink towards the poles.
        let weight = |texel: usize| (PI * ((texel / image.width) as f64 + 0.5) / image.height as f64).sin();
        let texels = || (0..image.width * image.height).step_by(step);
        let value = |texel: usize| {
            image.rgb.get(3 * texel..3 * texel + 3).map_or(0.0, |rgb| of(own * mean([rgb[0], rgb[1], rgb[2]].map(f32::abs))))
        };
        texels().map(|texel| weight(texel) * value(texel)).sum::<f64>() / texels().map(weight).sum::<f64>()
    });
    if found.is_finite() { found.max(0.0) } else { 0.0 }
}

pub(super) fn mean(rgb: [f32; 3]) -> f64 {
    rgb.map(f64::from).iter().sum::<f64>() / 3.0
}
