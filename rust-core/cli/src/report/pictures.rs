//! What a stage's cameras see, as it looks and in false colour.

use super::html::Page;
use crate::{arguments::ReportOptions, denoise::Denoiser, falsecolor, glare, render::drive, words::Words};
use gonio::{
    Diagnostic, Error, Result,
    colour::luminance_of_pixel,
    compile::{CompiledScene, compile},
    film::Image,
    measure::glare::{EyeView, Glare, GlareOptions},
    output::{FalseColour, Look, display_over_black, encode_jpeg},
    render::Render,
    scene::{Aov, Integrator},
};
use gonio_page::fill;
use gonio_simd::Execution;
use gonio_usd::{
    Loaded,
    view::{Resolution, ViewOptions, complete},
};
use std::sync::{Arc, atomic::AtomicBool};

/// Decades of luminance that the steps cover: lamps are thousands of times as bright as what they light.
const DECADES: f32 = 3.0;

/// What a camera sees.
#[derive(Debug)]
pub(super) struct Picture {
    camera: String,
    /// JPEG.
    colour: Vec<u8>,
    /// PNG.
    luminance: Vec<u8>,
    /// Mean and greatest, cd/m².
    figures: [f64; 2],
    samples: u32,
    denoised: bool,
    /// What an eye in the camera's place would say, if it sees enough.
    glare: Option<Glare>,
}

/// Pictures of cameras by path, one after the other, and the scene as it was compiled last; what compiling finds goes to `diagnostics`.
pub(super) fn pictures(
    options: &ReportOptions,
    loaded: &mut Loaded,
    cameras: &[Option<String>],
    denoiser: Option<&Denoiser>,
    interrupted: &'static AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Vec<Picture>, Option<Arc<CompiledScene>>)> {
    let mut previous: Option<Arc<CompiledScene>> = None;
    let mut found = Vec::new();
    for camera in cameras {
        // Each picture has a shape of its own, which the stage's cameras are made to fit.
        let (known, settings) = (loaded.scene.cameras.clone(), loaded.scene.settings.clone());
        let (resolution, camera) = (Resolution::Width(options.image_width), camera.clone());
        complete(loaded, "", &ViewOptions { camera, resolution, camera_light: false, data_window: false, ..ViewOptions::default() })?;
        apply_settings(options, loaded);
        if denoiser.is_some() {
            Denoiser::ask_for_guides(&mut loaded.scene.settings);
        }
        let compiled = Arc::new(compile(&loaded.scene, previous.as_deref(), interrupted)?);
        if previous.is_none() {
            diagnostics.extend(compiled.diagnostics.iter().cloned());
        }
        found.push(picture(options, loaded, &compiled, denoiser, interrupted)?);
        previous = Some(compiled);
        (loaded.scene.cameras, loaded.scene.settings) = (known, settings);
    }
    Ok((found, previous))
}

fn apply_settings(options: &ReportOptions, loaded: &mut Loaded) {
    let settings = &mut loaded.scene.settings;
    settings.samples = options.spp;
    settings.max_bounces = options.max_bounces.unwrap_or(settings.max_bounces);
    settings.integrator = Integrator::Path;
    options.work.apply(settings);
    options.textures.apply(settings);
    (settings.crop, settings.time_limit_s) = (None, 0.0);
    settings.aovs = vec![Aov::Color, Aov::Luminance];
}

fn picture(
    options: &ReportOptions,
    loaded: &Loaded,
    compiled: &Arc<CompiledScene>,
    denoiser: Option<&Denoiser>,
    interrupted: &'static AtomicBool,
) -> Result<Picture> {
    let execution = Execution::detect();
    let scene = &loaded.scene;
    let mut render = Render::start(compiled.clone(), &scene.settings, execution)?;
    drive(&mut render, options.quiet, interrupted, |_| ())?;
    render.finish()?;
    let mut image = render.film().develop();
    let camera = &scene.cameras[scene.settings.camera as usize];
    let values = image.layer(Aov::Luminance).map_or_else(Vec::new, |layer| layer.values.clone());
    let shown = match denoiser {
        Some(denoiser) => {
            denoiser.run(&mut image)?;
            luminances(&image, camera.exposure.0)
        }
        None => values.clone(),
    };
    let style = FalseColour {
        scale: super::scale(options, options.max_luminance, Some(DECADES), &shown)?,
        unit: "cd/m²".into(),
        contours: false,
        smoothing: 0,
        legend: true,
    };
    let sum: f64 = values.iter().map(|value| f64::from(*value)).sum();
    let greatest = values.iter().copied().fold(0.0, f32::max);
    Ok(Picture {
        camera: camera.origin.name.to_string(),
        colour: as_jpeg(&image, options, execution)?,
        luminance: falsecolor::encoded(&options.output, &style.draw(&shown, image.size()))?,
        figures: [sum / values.len().max(1) as f64, f64::from(greatest)],
        samples: image.samples,
        denoised: denoiser.is_some(),
        glare: rating(&image, &values)?,
    })
}

/// Luminances in cd/m² of the colour pass, which was multiplied by the camera's exposure.
fn luminances(image: &Image, exposure: f32) -> Vec<f32> {
    let scale = if exposure > 0.0 { 1.0 / exposure } else { 1.0 };
    image.layer(Aov::Color).map_or_else(Vec::new, |layer| {
        layer.values.chunks_exact(layer.channels).map(|pixel| scale * luminance_of_pixel([pixel[0], pixel[1], pixel[2]])).collect()
    })
}

/// The picture as the eye would see it, over black.
fn as_jpeg(image: &Image, options: &ReportOptions, execution: Execution) -> Result<Vec<u8>> {
    let rgba = display_over_black(image, &Look { stops: options.exposure, ..Look::default() }, execution);
    let [width, height] = image.size().map(|side| side as u32);
    encode_jpeg(&rgba, width, height).map_err(|error| Error::io(&options.output, error))
}

/// UGR and DGP of what a camera sees, if that is half a world at least.
fn rating(image: &Image, luminances: &[f32]) -> Result<Option<Glare>> {
    let eye = image.frame.view.and_then(|view| EyeView::new(view, image.size()).ok()).filter(EyeView::covers_hemisphere);
    eye.map(|eye| Glare::new(luminances, &eye, &GlareOptions::default())).transpose()
}

/// The pictures with their captions.
pub(super) fn write(pictures: &[Picture], words: &Words, page: &mut Page) {
    if pictures.is_empty() {
        return;
    }
    let say = &words.pictures;
    page.section(&say.title);
    for picture in pictures {
        page.part(&picture.camera);
        let denoised = if picture.denoised { say.denoised.as_str() } else { "" };
        let seen = fill(&say.seen, &[("samples", &picture.samples.to_string()), ("denoised", denoised)]);
        page.picture("jpeg", &picture.colour, &seen);
        let [mean, greatest] = picture.figures.map(|value| words.numbers.short(value));
        page.picture("png", &picture.luminance, &fill(&say.luminance, &[("mean", &mean), ("greatest", &greatest)]));
        if let Some(glare) = &picture.glare {
            page.list(&glare::as_text(glare, words));
        }
    }
}
