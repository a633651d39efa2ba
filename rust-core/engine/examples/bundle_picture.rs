//! A scene bundle rendered without any host, for machines and emulators that have none: `bundle_picture SCENE PICTURE.exr LEVEL SEED`.

use gonio::{compile::compile, output::write_exr, render::Render, scene::load_bundle};
use gonio_simd::Execution;
use std::{error::Error, path::Path, process::ExitCode, sync::Arc, sync::atomic::AtomicBool};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scene, picture, level, seed] = arguments.as_slice() else {
        eprintln!("bundle_picture SCENE PICTURE.exr LEVEL SEED");
        return ExitCode::from(2);
    };
    match render(Path::new(scene), Path::new(picture), level, seed) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Renders with the settings that the bundle holds.
fn render(scene: &Path, picture: &Path, level: &str, seed: &str) -> Result<(), Box<dyn Error>> {
    let mut scene = load_bundle(scene)?;
    scene.settings.seed = seed.parse()?;
    let compiled = Arc::new(compile(&scene, None, &AtomicBool::new(false))?);
    let mut render = Render::start(compiled, &scene.settings, Execution::named(level)?)?;
    render.finish()?;
    write_exr(picture, &render.film().develop(), &Default::default())?;
    Ok(())
}
