//! How bright the view is: the value that would be shown as white, from a small picture that nobody sees.

use super::learn::reduced;
use crate::{
    camera::sampler::{BATCH, Runs, TILE},
    colour::luminance,
    compile::{CompiledScene, View},
    output::KEY,
    scene::Settings,
    transport::{Start, Tracer},
};
use gonio_simd::Execution;

/// Samples a pixel of the picture, which is one tile, where noise is measured by it, and where neighbours without noise are compared: frames wait for it.
pub(super) const FOR_NOISE: u32 = 8;
pub(super) const FOR_EDGES: u32 = 1;

/// The value of the colour pass that the photographic operator would show as white before it compresses; what the settings say, if anything.
///
/// Its random numbers are others than the picture's, so that what is decided by it does not depend on the picture's noise.
pub(super) fn meter(scene: &CompiledScene, settings: &Settings, samples: u32, execution: Execution, cancelled: &dyn Fn() -> bool) -> f32 {
    if settings.noise_white > 0.0 {
        return settings.noise_white;
    }
    let Ok(view) = View::new(scene, &reduced(settings, TILE as u32, samples), execution) else { return 1.0 };
    let start = Start::Camera(&view.camera, &view.placement);
    let tracer = Tracer { tables: &scene.tables, start, transport: view.transport };
    let mut workspace = scene.workspaces.take();
    workspace.prepare(&scene.tables, &tracer.transport, false);
    for sample in 0..samples {
        tracer.trace(view.window.min, view.window.max, &Runs::whole(sample), &mut workspace, cancelled);
    }
    let [red, green, blue] = &workspace.deposits.sums.radiance;
    let luminances = (0..BATCH).map(|i| luminance([red[i], green[i], blue[i]].map(|x| f64::from(x).abs())));
    let (sum, count) = luminances.filter(|y| *y > 0.0 && y.is_finite()).fold((0.0, 0.0), |(sum, count), y| (sum + y.ln(), count + 1.0));
    if !cancelled() {
        scene.workspaces.leave(workspace);
    }
    let mean = if count > 0.0 { (sum / count).exp() / f64::from(samples) } else { 0.0 };
    let white = mean as f32 * view.exposure / KEY;
    if white > 0.0 { white } else { 1.0 }
}
