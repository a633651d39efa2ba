//! Pictures by wavelength, as `gonio render --by-wavelength` writes them, and what they tell: channels of sensors, CCT, Duv, melanopic luminance.

use super::{channel::colour_of, messages::say};
use gonio::{
    Error, Result,
    output::{Channels, has_other_primaries, spectral_of_exr},
    spectral_picture::LightFigure,
};
use gonio_spectrum::{TOLERANCE, cct_of_colour, melanopic_daylight};
use std::path::Path;

/// Bands of a picture by wavelength, by their channels' names, in order.
pub(super) struct Wavelengths<'a> {
    /// The middles, nm.
    pub(super) nm: Vec<f64>,
    /// By band, W/(m² sr nm).
    pub(super) radiance: Vec<&'a [f32]>,
}

impl<'a> Wavelengths<'a> {
    /// Those among the channels of a file; `wanted` says who asks.
    ///
    /// # Errors
    /// Fewer than three.
    pub(super) fn of(path: &Path, channels: &'a Channels, wanted: &str) -> Result<Self> {
        let number = |name: &str| name.strip_prefix("S0.")?.strip_suffix("nm")?.replace(',', ".").parse::<f64>().ok();
        let mut bands: Vec<(f64, &[f32])> =
            channels.iter().filter_map(|(name, values)| Some((number(name).filter(|nm| nm.is_finite())?, values.as_slice()))).collect();
        bands.sort_by(|a, b| a.0.total_cmp(&b.0));
        bands.dedup_by(|a, b| a.0.total_cmp(&b.0).is_eq());
        let (nm, radiance): (Vec<f64>, Vec<&[f32]>) = bands.into_iter().unzip();
        let none =
            || lacks(path, &format!("{wanted}, which gonio render --by-wavelength writes: there are no channels such as S0.550,000000nm"));
        (nm.len() >= 3).then_some(Self { nm, radiance }).ok_or_else(none)
    }

    /// The width of each band, nm: half of the way to its neighbours on both sides.
    pub(super) fn widths(&self) -> Vec<f64> {
        let last = self.nm.len() - 1;
        let gap = |below: usize| self.nm[below + 1] - self.nm[below];
        (0..self.nm.len()).map(|k| 0.5 * (gap(k.saturating_sub(1)) + gap(k.min(last - 1)))).collect()
    }

    /// The sum over the bands of radiance times these, pixel by pixel.
    pub(super) fn sum(&self, weights: &[f64]) -> Vec<f32> {
        let pixels = self.radiance.first().map_or(0, |band| band.len());
        let mut sums = vec![0.0_f64; pixels];
        for (band, weight) in self.radiance.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            sums.iter_mut().zip(*band).for_each(|(sum, value)| *sum += weight * f64::from(*value));
        }
        sums.into_iter().map(|sum| sum as f32).collect()
    }
}

/// A quantity of the light's colour that a file has no channel of; none of other quantities.
///
/// # Errors
/// The file has nothing of which it could be told.
pub(super) fn derived(path: &Path, (channels, size): (&Channels, [usize; 2]), quantity: &str) -> Result<Option<Vec<f32>>> {
    if let Some(figure) = LightFigure::by_name(quantity) {
        return on_surfaces(path, (channels, size), figure).map(Some);
    }
    let figure: fn((f64, f64)) -> f64 = match quantity.to_ascii_lowercase().as_str() {
        "cct" => |(kelvin, _)| kelvin,
        "duv" => |(_, duv)| duv,
        "melanopic" => return melanopic(path, channels).map(Some),
        _ => return Ok(None),
    };
    if has_other_primaries(path)? {
        return Err(lacks(path, &format!("{quantity} wants colours in linear Rec.709, and the file's have other primaries")));
    }
    let [red, green, blue] = colour_of(path, channels, &format!("{quantity} wants the colour channels R, G and B"))?;
    let of_pixel =
        |((r, g), b): ((&f32, &f32), &f32)| cct_of_colour([*r, *g, *b].map(f64::from)).map_or(f32::NAN, |found| figure(found) as f32);
    Ok(Some(red.iter().zip(green).zip(blue).map(of_pixel).collect()))
}

/// A figure of the light on what the picture shows.
fn on_surfaces(path: &Path, (channels, size): (&Channels, [usize; 2]), figure: LightFigure) -> Result<Vec<f32>> {
    let values = spectral_of_exr(path, channels, size)?.light_figure(figure)?;
    let without = values.iter().filter(|value| value.is_nan()).count() as f64 / values.len().max(1) as f64;
    if without > 0.0 {
        let range = if figure == LightFigure::Ra {
            format!(", or is more than {TOLERANCE} in Duv from Ra's reference (CIE 13.3)")
        } else {
            String::new()
        };
        let share = 100.0 * without;
        say(&format!("note: {share:.1} % of the picture have no {}: nothing is lit there, the light is not white{range}", figure.name()));
    }
    Ok(values)
}

/// Melanopic equivalent daylight luminance, cd/m².
fn melanopic(path: &Path, channels: &Channels) -> Result<Vec<f32>> {
    let found = Wavelengths::of(path, channels, "colour does not tell melanopic luminance, but a picture by wavelength")?;
    let weights: Vec<f64> = found.nm.iter().zip(found.widths()).map(|(nm, width)| width * melanopic_daylight(*nm)).collect();
    Ok(found.sum(&weights))
}

fn lacks(path: &Path, problem: &str) -> Error {
    Error::Format { path: path.to_owned(), line: None, problem: problem.to_owned() }
}
