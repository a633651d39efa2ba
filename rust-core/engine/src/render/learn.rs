//! The learned light cache (light guiding), which lights arrive where. It is learned from a small picture of the view, which nobody sees, or from a few
//! paths of all sensors or places.

use super::source::Source;
use crate::{
    camera::sampler::{Runs, TILE},
    compile::{CompiledScene, View},
    light::LightCache,
    scene::{Antialiasing, Aov, Crop, Integrator, Settings},
    transport::{Start, Tracer, Transport},
};
use std::sync::Arc;

/// The small picture's longer side, and samples a pixel.
const SIDE: u32 = 128;
const SAMPLES: u32 = 4;
/// Paths that a pixel of sensors sends to learn from: many pixels make a sensor.
const SENSOR_SAMPLES: u32 = 1;
/// Pictures of fewer samples, and sensors of fewer a pixel, end before it pays.
const LEAST_SAMPLES: u32 = 16;
/// Other random numbers than the picture's: what is learned from some must not choose among the same.
const OTHER_SEED: u32 = 0x5bd1_e995;

/// None where lights are few, samples too few, or nothing could be learned.
pub(super) fn learn(scene: &CompiledScene, settings: &Settings, source: &Source, cancelled: &dyn Fn() -> bool) -> Option<Arc<LightCache>> {
    if settings.samples < LEAST_SAMPLES
        || matches!(settings.integrator, Integrator::Whitted | Integrator::Light)
        || !scene.tables.lights.has_tree()
    {
        return None;
    }
    match source {
        Source::View(view) => {
            let View { camera, placement, transport, window, .. } =
                View::new(scene, &reduced(settings, SIDE, SAMPLES), view.transport.execution).ok()?;
            let tracer = Tracer { tables: &scene.tables, start: Start::Camera(&camera, &placement), transport };
            from_paths(scene, &tracer, window, SAMPLES, cancelled)
        }
        Source::Sensors { transport, .. } | Source::Places { transport, .. } => {
            let transport = Transport { seed: settings.seed ^ OTHER_SEED, samples: SENSOR_SAMPLES, ..transport.clone() };
            let tracer = Tracer { tables: &scene.tables, start: source.start(), transport };
            from_paths(scene, &tracer, Crop { min: [0; 2], max: settings.resolution }, SENSOR_SAMPLES, cancelled)
        }
    }
}

/// What the paths of a window's pixels tell.
fn from_paths(
    scene: &CompiledScene,
    tracer: &Tracer<'_>,
    window: Crop,
    samples: u32,
    cancelled: &dyn Fn() -> bool,
) -> Option<Arc<LightCache>> {
    let mut workspace = scene.workspaces.take();
    workspace.prepare(&scene.tables, &tracer.transport, false);
    workspace.deposits.arrivals = Some(Vec::new());
    for y in (window.min[1]..window.max[1]).step_by(TILE) {
        for x in (window.min[0]..window.max[0]).step_by(TILE) {
            let end = [(x + TILE as u32).min(window.max[0]), (y + TILE as u32).min(window.max[1])];
            for sample in 0..samples {
                tracer.trace([x, y], end, &Runs::whole(sample), &mut workspace, cancelled);
                if cancelled() {
                    return None;
                }
            }
        }
    }
    let arrivals = workspace.deposits.arrivals.take()?;
    scene.workspaces.leave(workspace);
    scene.tables.lights.learn(&arrivals).map(Arc::new)
}

/// The same view in a few pixels, of which the longer side has at most `side`, without passes, of other random numbers.
pub(super) fn reduced(settings: &Settings, side: u32, samples: u32) -> Settings {
    let [width, height] = settings.resolution;
    let scale = (f64::from(side) / f64::from(width.max(height))).min(1.0);
    let part = |pixels: u32| f64::from(pixels) * scale;
    let crop = settings.crop.map(|crop| Crop {
        min: crop.min.map(|pixels| part(pixels).floor() as u32),
        max: crop.max.map(|pixels| part(pixels).ceil() as u32),
    });
    Settings {
        resolution: [width, height].map(|pixels| (part(pixels).round() as u32).max(1)),
        crop,
        samples,
        sample_range: None,
        tile_range: None,
        noise_threshold: 0.0,
        antialiasing: Antialiasing::Sampled,
        seed: settings.seed ^ OTHER_SEED,
        aovs: vec![Aov::Color],
        ..settings.clone()
    }
}
