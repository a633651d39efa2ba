//! Passes by wavelength beside the colour: illuminance and light groups.

use crate::{
    colour::luminance_of_pixel,
    error::{Error, Result},
    film::{Image, Layer},
    scene::{Aov, LIGHT_GROUP, Settings},
};
use gonio_spectrum::Bands;

/// A pass by wavelength.
#[derive(Clone, Debug)]
pub struct SpectralLayer {
    /// The pass.
    pub aov: Aov,
    /// Its name: `color`, `illuminance`, `lightgroup:Kitchen`.
    pub name: String,
    /// By band, rows from the top: spectral radiance in W/(m² sr nm), or irradiance in W/(m² nm).
    pub bands: Vec<Vec<f32>>,
    /// Of a light group what all of its lamps send, by band over daylight D65, both of luminance 1; none where they differ or no spectrum is known.
    pub lamp: Option<Vec<f32>>,
}

/// Whether a pass is kept by wavelength.
fn is_kept(aov: Aov) -> bool {
    matches!(aov, Aov::Color | Aov::Illuminance | Aov::LightGroup(_))
}

/// The passes of some settings that are kept by wavelength, without their light: the colour first.
pub(super) fn kept(settings: &Settings) -> Vec<SpectralLayer> {
    let others = settings.aovs.iter().copied().filter(|aov| is_kept(*aov) && *aov != Aov::Color);
    let layer = |aov| SpectralLayer { aov, name: settings.pass_name(aov), bands: Vec::new(), lamp: None };
    std::iter::once(Aov::Color).chain(others).map(layer).collect()
}

/// Names of the passes of some settings that are not kept by wavelength; luminance is made of the colour.
pub(super) fn left_out(settings: &Settings) -> Vec<String> {
    let is_left = |aov: &Aov| !is_kept(*aov) && *aov != Aov::Luminance;
    settings.aovs.iter().copied().filter(is_left).map(|aov| settings.pass_name(aov)).collect()
}

impl SpectralLayer {
    /// Adds a band as it was rendered, where light is a grey relative to daylight D65; colours are times `exposure`.
    pub(super) fn add(&mut self, bands: &Bands, image: &Image, exposure: f64) -> Result<()> {
        let layer = image.layer(self.aov).ok_or_else(|| Error::Internal(format!("a picture without its pass {}", self.name)))?;
        let band = self.bands.len();
        let scale = if self.aov == Aov::Illuminance { 1.0 } else { 1.0 / exposure };
        let power = |pixel: &[f32]| bands.power(band, scale * f64::from(pixel[layer.channels.min(2) - 1])) as f32;
        self.bands.push(layer.values.chunks_exact(layer.channels).map(power).collect());
        Ok(())
    }

    /// The name of a light group, where the pass is one.
    pub fn group(&self) -> Option<&str> {
        matches!(self.aov, Aov::LightGroup(_)).then(|| self.name.strip_prefix(LIGHT_GROUP)).flatten()
    }

    /// Sets the picture's layer of the pass to what all bands are together.
    pub(super) fn sum(&self, bands: &Bands, image: &mut Image, exposure: f64) {
        let weights = colours(bands);
        let Some(layer) = image.layers.iter_mut().find(|layer| layer.aov == self.aov) else { return };
        for (number, pixel) in layer.values.chunks_exact_mut(layer.channels).enumerate() {
            let colour = summed(&weights, &self.bands, number);
            if self.aov == Aov::Illuminance {
                pixel[0] = luminance_of_pixel(colour.map(|part| part as f32));
            } else {
                pixel.iter_mut().zip(colour).for_each(|(part, sum)| *part = (exposure * sum) as f32);
            }
        }
    }
}

/// Linear Rec.709 of a W/(m² sr nm) in each band.
fn colours(bands: &Bands) -> Vec<[f64; 3]> {
    bands.film().iter().enumerate().map(|(band, film)| film.map(|part| f64::from(part) / bands.power(band, 1.0))).collect()
}

/// A pixel's colour.
fn summed(weights: &[[f64; 3]], bands: &[Vec<f32>], pixel: usize) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (weights, values) in weights.iter().zip(bands) {
        sum.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * f64::from(values[pixel]));
    }
    sum
}

/// Luminance in cd/m² of a picture's colour.
pub(super) fn luminance(image: &Image, exposure: f64) -> Option<Layer> {
    let colour = image.layer(Aov::Color)?;
    let of_pixel = |pixel: &[f32]| (f64::from(luminance_of_pixel([pixel[0], pixel[1], pixel[2]])) / exposure) as f32;
    let values = colour.values.chunks_exact(colour.channels).map(of_pixel).collect();
    Some(Layer { aov: Aov::Luminance, name: Aov::Luminance.name().to_owned(), values, channels: 1 })
}
