//! Pictures by wavelength: spectral radiance of every pixel in even bands.
//!
//! The view is rendered in one band after another by the same random numbers: the noise of a pixel is that of its brightness and hardly of its colour.

use crate::{
    compile::{BandedScene, compile},
    error::{Diagnostic, Error, Result},
    film::Image,
    measure::Watch,
    render::{Progress, Render},
    scene::{Aov, Integrator, Scene, Settings},
};
use gonio_simd::Execution;
use gonio_spectrum::Bands;
use std::time::{Duration, Instant};

/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);

/// A picture by wavelength.
#[derive(Debug)]
pub struct SpectralPicture {
    /// Its colour, linear Rec.709 in cd/m² and coverage, and how it was taken.
    pub image: Image,
    /// The bands.
    pub bands: &'static Bands,
    /// By band, W/(m² sr nm): rows from the top.
    pub radiance: Vec<Vec<f32>>,
}

/// Renders a scene's view with its settings, as many samples for each band; one of [`Bands::WIDTHS_NM`].
///
/// # Errors
/// What compiling finds, settings that know no wavelengths or render in parts, cancellation.
pub fn spectral_picture(
    scene: &Scene,
    bands: &'static Bands,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(SpectralPicture, Vec<Diagnostic>)> {
    check(&scene.settings)?;
    let mut scene = scene.clone();
    let settings = &mut scene.settings;
    (settings.spectral, settings.aovs) = (true, vec![Aov::Color]);
    // Pixels that stop at different samples in different bands would have colours of noise.
    (settings.noise_threshold, settings.time_limit_s) = (0.0, 0.0);
    let compiled = compile(&scene, watch.previous, watch.cancel)?;
    let diagnostics = compiled.diagnostics.clone();
    let mut banded = BandedScene::new(compiled, bands);
    let start = Instant::now();
    let mut first: Option<(Image, f64)> = None;
    let mut radiance = Vec::with_capacity(bands.count());
    for band in 0..bands.count() {
        let mut progress = |part: &Progress| (watch.progress)(&part.of_whole(band, bands.count(), start));
        let mut render = Render::start(banded.at(band)?.clone(), &scene.settings, execution)?;
        while !render.is_finished() {
            let _ = render.next_tile(TELL_EVERY);
            if !progress(&render.progress()) {
                render.cancel();
            }
        }
        render.finish()?;
        let (image, exposure) = (render.film().develop(), f64::from(render.film().exposure()));
        let found = |pixel: &[f32]| bands.power(band, f64::from(pixel[1]) / exposure) as f32;
        let colour = image.layer(Aov::Color).ok_or_else(|| Error::Internal("a picture without colour".to_owned()))?;
        radiance.push(colour.values.chunks_exact(colour.channels).map(found).collect::<Vec<f32>>());
        first.get_or_insert((image, exposure));
    }
    let (mut image, exposure) = first.ok_or_else(|| Error::Internal("no band was rendered".to_owned()))?;
    colour(&mut image, bands, &radiance, exposure);
    Ok((SpectralPicture { image, bands, radiance }, diagnostics))
}

/// # Errors
/// What cannot be rendered band by band.
fn check(settings: &Settings) -> Result<()> {
    if settings.integrator == Integrator::Whitted {
        return Err(Error::setting(
            "integrator",
            "direct light without noise (whitted) knows no wavelengths, expected path, direct or light",
        ));
    }
    if settings.sample_range.is_some() || settings.tile_range.is_some() {
        return Err(Error::setting("part", "a picture by wavelength is rendered whole"));
    }
    Ok(())
}

/// Sets the picture's colour to that of all bands.
fn colour(image: &mut Image, bands: &Bands, radiance: &[Vec<f32>], exposure: f64) {
    let film = bands.film();
    // Linear Rec.709 of a W/(m² sr nm) in each band.
    let weights: Vec<[f64; 3]> =
        film.iter().enumerate().map(|(band, film)| film.map(|part| exposure * f64::from(part) / bands.power(band, 1.0))).collect();
    let Some(layer) = image.layers.iter_mut().find(|layer| layer.aov == Aov::Color) else { return };
    for (number, pixel) in layer.values.chunks_exact_mut(layer.channels).enumerate() {
        let mut sum = [0.0; 3];
        for (weights, values) in weights.iter().zip(radiance) {
            sum.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * f64::from(values[number]));
        }
        pixel.iter_mut().zip(sum).for_each(|(part, sum)| *part = sum as f32);
    }
}
