//! Pictures by wavelength: spectral radiance of every pixel in even bands.
//!
//! The view is rendered in one band after another by the same random numbers: the noise of a pixel is that of its brightness and hardly of its colour.

mod figures;
mod layers;
mod relight;

pub use figures::LightFigure;
pub use layers::SpectralLayer;
pub use relight::NewLamp;

use crate::{
    compile::{BandedScene, compile},
    error::{Diagnostic, Error, Result},
    film::Image,
    measure::{Watch, is_by_colours},
    render::{Progress, Render},
    scene::{Aov, Integrator, Origin, Scene, Settings},
};
use gonio_simd::Execution;
use gonio_spectrum::Bands;
use std::time::{Duration, Instant};

/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);

/// A picture by wavelength.
#[derive(Clone, Debug)]
pub struct SpectralPicture {
    /// Its colour, linear Rec.709 in cd/m² and coverage, how it was taken, and what the further passes are together.
    pub image: Image,
    /// The bands.
    pub bands: &'static Bands,
    /// What its colours are multiplied by.
    pub exposure: f64,
    /// The passes by wavelength, the colour first.
    pub layers: Vec<SpectralLayer>,
}

impl SpectralPicture {
    /// Spectral radiance by band, W/(m² sr nm): rows from the top.
    pub fn radiance(&self) -> &[Vec<f32>] {
        self.layers.first().map_or(&[], |layer| &layer.bands)
    }

    /// Sets the picture's passes to what all bands are together; luminance is made of the colour.
    fn sum(&mut self, has_luminance: bool) {
        self.layers.iter().for_each(|layer| layer.sum(self.bands, &mut self.image, self.exposure));
        self.image.layers.retain(|layer| layer.aov != Aov::Luminance);
        self.image.layers.extend(has_luminance.then(|| layers::luminance(&self.image, self.exposure)).flatten());
    }
}

/// Renders a scene's view with its settings, as many samples for each band; one of [`Bands::WIDTHS_NM`]. Of the settings' passes illuminance and light
/// groups are by wavelength as well.
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
    let mut layers = layers::kept(&scene.settings);
    let mut scene = scene.clone();
    let settings = &mut scene.settings;
    let has_luminance = settings.aovs.contains(&Aov::Luminance);
    let left_out = layers::left_out(settings);
    (settings.spectral, settings.aovs) = (true, layers.iter().map(|layer| layer.aov).collect());
    // Pixels that stop at different samples in different bands would have colours of noise.
    (settings.noise_threshold, settings.time_limit_s) = (0.0, 0.0);
    let compiled = compile(&scene, watch.previous, watch.cancel)?;
    let mut diagnostics = compiled.diagnostics.clone();
    diagnostics.extend((!left_out.is_empty()).then(|| without_wavelengths(&left_out)));
    diagnostics.extend(is_by_colours(&scene).then(by_colours));
    let mut banded = BandedScene::new(compiled, bands);
    for layer in &mut layers {
        let Aov::LightGroup(number) = layer.aov else { continue };
        layer.lamp = scene.settings.light_groups.get(usize::from(number)).and_then(|group| banded.lamp_of_group(&scene, group));
    }
    let (image, exposure) = rendered(&scene.settings, &mut banded, &mut layers, execution, watch)?;
    let mut picture = SpectralPicture { image, bands, exposure, layers };
    picture.sum(has_luminance);
    Ok((picture, diagnostics))
}

/// Renders band after band into the layers. Gives the first band's picture and its exposure.
fn rendered(
    settings: &Settings,
    banded: &mut BandedScene,
    layers: &mut [SpectralLayer],
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(Image, f64)> {
    let bands = banded.bands();
    let start = Instant::now();
    let mut first: Option<(Image, f64)> = None;
    for band in 0..bands.count() {
        let mut progress = |part: &Progress| (watch.progress)(&part.of_whole(band, bands.count(), start));
        let mut render = Render::start(banded.at(band)?.clone(), settings, execution)?;
        while !render.is_finished() {
            let _ = render.next_tile(TELL_EVERY);
            if !progress(&render.progress()) {
                render.cancel();
            }
        }
        render.finish()?;
        let (image, exposure) = (render.film().develop(), f64::from(render.film().exposure()));
        layers.iter_mut().try_for_each(|layer| layer.add(bands, &image, exposure))?;
        first.get_or_insert((image, exposure));
    }
    first.ok_or_else(|| Error::Internal("no band was rendered".to_owned()))
}

fn by_colours() -> Diagnostic {
    let message = "lamps or surfaces shine without a spectrum and count as daylight D65 of their colour: Ra, Rf, Rg and melanopic light of this picture are not \
        those of the lamps";
    Diagnostic::warning(&Origin::new("lights"), message)
}

fn without_wavelengths(passes: &[String]) -> Diagnostic {
    let message = format!("by wavelength there are the colour, illuminance, luminance and light groups; left out: {}", passes.join(", "));
    Diagnostic::info(&Origin::new("render settings"), message)
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
