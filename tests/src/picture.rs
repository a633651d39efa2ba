//! Rendering to an image, and statistics of images.

use gonio::{
    Severity,
    compile::{CompiledScene, compile},
    film::Image,
    render::Render,
    scene::{Aov, Scene, Settings},
};
use gonio_simd::Execution;
use std::sync::{Arc, atomic::AtomicBool};

/// Settings for a small square picture.
pub fn settings(pixels: u32, samples: u32, aovs: &[Aov]) -> Settings {
    Settings { resolution: [pixels, pixels], samples, aovs: aovs.to_vec(), threads: 2, ..Settings::default() }
}

/// Compiles a scene that warns of nothing.
pub fn compiled(scene: &Scene) -> Arc<CompiledScene> {
    let scene = compile(scene, None, &AtomicBool::new(false)).expect("the scene compiles");
    assert!(scene.diagnostics.iter().all(|d| d.severity == Severity::Info), "{:?}", scene.diagnostics);
    Arc::new(scene)
}

/// Renders to the end.
pub fn render(scene: &Arc<CompiledScene>, settings: &Settings, execution: Execution) -> Image {
    let mut render = Render::start(scene.clone(), settings, execution).expect("the render starts");
    render.finish().expect("the render ends well");
    render.film().develop()
}

/// Mean of a channel of a pass.
pub fn mean(image: &Image, aov: Aov, channel: usize) -> f64 {
    let layer = image.layer(aov).expect("the pass was asked for");
    let values = layer.values.iter().skip(channel).step_by(layer.channels);
    values.clone().map(|v| f64::from(*v)).sum::<f64>() / values.count() as f64
}
