//! Lamps that stand between the camera and what it should see.

use super::light_words::extents;
use gonio::{
    Diagnostic, Result,
    compile::{CompiledScene, compile},
    render::Render,
    scene::{Aov, Camera, Caustics, Closure, Guiding, Input, Light, Material, Model, Origin, Projection, Scene},
};
use gonio_simd::Execution;
use gonio_usd::{
    Loaded, camera,
    view::{Resolution, ViewOptions, complete},
};
use pyo3::prelude::*;
use std::{
    sync::{Arc, atomic::AtomicBool},
    time::Duration,
};

/// Width of the small picture in which they are looked for, pixels.
const WIDTH: u32 = 24;
/// Share of the picture from which a lamp is named.
const MUCH: f32 = 0.5;
/// Most lamps that are looked for.
const MOST: usize = 32;
/// A lamp whose radius is below this share of half of the picture's smaller side fills no half of it, wherever it stands in it.
const SMALL: f64 = 0.5;

/// A note for each lamp that fills much of the view of the camera that is looked through without a word.
pub(super) fn notes(py: Python<'_>, loaded: &Loaded, compiled: &CompiledScene, interrupted: &AtomicBool) -> Result<Vec<Diagnostic>> {
    if loaded.scene.cameras.is_empty() {
        return Ok(Vec::new());
    }
    let mut loaded = loaded.clone();
    let view = ViewOptions { resolution: Resolution::Width(WIDTH), camera_light: false, data_window: false, ..ViewOptions::default() };
    let primary = camera::primary_camera_name(py, loaded.scene.cameras.len());
    complete(&mut loaded, &primary, &view)?;
    let scene = &mut loaded.scene;
    let camera = scene.cameras[scene.settings.camera as usize].clone();
    let lamps: Vec<usize> = (0..scene.lights.len()).filter(|lamp| may_fill(&scene.lights[*lamp], &camera)).take(MOST).collect();
    if lamps.is_empty() {
        return Ok(Vec::new());
    }
    let paths: Vec<Origin> = lamps.iter().map(|lamp| scene.lights[*lamp].origin.clone()).collect();
    keep_shapes(scene, &lamps);
    let shares = py.detach(|| shares(scene, compiled, interrupted))?;
    let filled = paths.into_iter().zip(shares).filter(|(_, share)| *share > MUCH);
    Ok(filled.map(|(path, share)| note(&path, share, &camera)).collect())
}

fn note(path: &Origin, share: f32, camera: &Camera) -> Diagnostic {
    let message = format!(
        "the lamp fills {:.0} % of the view of {}; --hide-lights hides lamps from the camera, primvars:gonio:visibility:camera = 0 this one",
        100.0 * share,
        camera.origin.name
    );
    Diagnostic::info(path, message)
}

/// Whether a lamp is seen, and large enough for its distance to fill much of a picture.
fn may_fill(light: &Light, camera: &Camera) -> bool {
    if light.shape.is_at_infinity() || !light.visibility.camera {
        return false;
    }
    let radius = 0.5 * extents(light).iter().map(|x| x * x).sum::<f64>().sqrt();
    let (lamp, eye) = (light.transform.columns[3], camera.transform.columns[3]);
    let distance = (0..3).map(|axis| (lamp[axis] - eye[axis]).powi(2)).sum::<f64>().sqrt();
    let half = 0.5 * camera.aperture[0].min(camera.aperture[1]);
    match camera.projection {
        Projection::Perspective { focal_length } => radius >= SMALL * half / focal_length * (distance - radius).max(0.0),
        Projection::Orthographic => radius >= SMALL * half,
        _ => radius >= SMALL * distance,
    }
}

/// Leaves of the scene black surfaces and the lamps, each of a light group of its own.
fn keep_shapes(scene: &mut Scene, lamps: &[usize]) {
    let mut black = Closure { model: Model::OpenPbr, ..Closure::default() };
    black.set_input("base_color", Input::Constant([0.0, 0.0, 0.0, 1.0]));
    black.set("specular_weight", 0.0);
    let black = scene.add_material(Material::of(Origin::new("black"), black));
    for instances in &mut scene.instances {
        let slots = instances.materials.len().max(1);
        instances.materials = vec![black; slots];
    }
    scene.lights.iter_mut().for_each(|light| light.group.clear());
    lamps.iter().enumerate().for_each(|(number, lamp)| scene.lights[*lamp].group = format!("lamp {number}"));
    let settings = &mut scene.settings;
    (settings.samples, settings.max_bounces, settings.crop, settings.time_limit_s) = (4, 0, None, 0.0);
    (settings.caustics, settings.guiding, settings.noise_threshold) = (Caustics::Off, Guiding::Off, 0.0);
    settings.aovs.clear();
    settings.light_groups.clear();
    settings.add_light_groups((0..lamps.len()).map(|number| format!("lamp {number}")).collect());
}

/// Share of the picture in which each group is seen.
fn shares(scene: &Scene, previous: &CompiledScene, interrupted: &AtomicBool) -> Result<Vec<f32>> {
    let compiled = Arc::new(compile(scene, Some(previous), interrupted)?);
    let mut render = Render::start(compiled, &scene.settings, Execution::detect())?;
    while !render.is_finished() {
        let _ = render.next_tile(Duration::from_millis(20));
    }
    render.finish()?;
    let image = render.film().develop();
    let [width, height] = image.size();
    let mut shares = vec![0.0; scene.settings.light_groups.len()];
    for layer in &image.layers {
        let Aov::LightGroup(group) = layer.aov else { continue };
        let lit = layer.values.chunks(layer.channels).filter(|pixel| pixel[..3].iter().any(|x| *x > 0.0)).count();
        shares[usize::from(group)] = lit as f32 / (width * height).max(1) as f32;
    }
    Ok(shares)
}
