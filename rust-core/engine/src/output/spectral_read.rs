//! Reading back pictures by wavelength that were written here.

use super::{
    exr::{Channels, exposure_of_exr, full_name, texts_of_exr, view_of_exr},
    spectral::{channel_name, lamp_note},
};
use crate::{
    error::{Error, Result},
    film::{Frame, Image, Layer, channel_names},
    scene::{Aov, LIGHT_GROUP},
    spectral_picture::{SpectralLayer, SpectralPicture},
};
use gonio_spectrum::{Bands, bands_of};
use std::{collections::HashMap, path::Path};

/// The picture in the channels and the header of an OpenEXR file of [`super::write_spectral`], whose channels have been read ([`super::read_exr`]): the colour,
/// light groups and illuminance, each by wavelength and as it looks.
///
/// # Errors
/// What the file is instead: no picture by wavelength, bands of other widths.
pub fn spectral_of_exr(path: &Path, channels: &Channels, size: [usize; 2]) -> Result<SpectralPicture> {
    let wrong = |problem: String| Error::Format { path: path.to_owned(), line: None, problem };
    let texts = texts_of_exr(path)?;
    let bands = bands_in(channels).ok_or_else(|| {
        wrong("no picture by wavelength as gonio render --by-wavelength writes it: bands of 5, 10 or 20 nm from 380 to 780 nm".to_owned())
    })?;
    let exposure = exposure_of_exr(path)?;
    let of_name: OfName<'_> = channels.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    let mut image = Image::empty(size);
    image.frame = Frame { view: view_of_exr(path)?, ..Frame::default() };
    let mut layers = Vec::new();
    for (aov, name, prefix) in passes(&of_name) {
        let found = (0..bands.count())
            .map(|band| of_name.get(format!("{prefix}{}", channel_name(bands.centre(band))).as_str()).map(|values| values.to_vec()));
        let values = found.collect::<Option<Vec<_>>>().ok_or_else(|| wrong(format!("{name} lacks some of the bands")))?;
        let lamp = texts.get(&lamp_note(&name)).and_then(|text| lamp_of(text, bands));
        image.layers.push(flat(aov, &name, &of_name, size));
        layers.push(SpectralLayer { aov, name, bands: values, lamp });
    }
    if of_name.contains_key("Luminance") {
        image.layers.push(flat(Aov::Luminance, Aov::Luminance.name(), &of_name, size));
    }
    Ok(SpectralPicture { image, bands, exposure: f64::from(exposure), layers })
}

/// Values of channels by their names.
type OfName<'a> = HashMap<&'a str, &'a [f32]>;

/// The bands of a file.
fn bands_in(channels: &Channels) -> Option<&'static Bands> {
    let count = channels.iter().filter(|(name, _)| name.starts_with("S0.")).count();
    let fits = |bands: &&Bands| {
        bands.count() == count && (0..count).all(|band| channels.iter().any(|(name, _)| *name == channel_name(bands.centre(band))))
    };
    Bands::WIDTHS_NM.into_iter().filter_map(bands_of).find(fits)
}

/// The passes by wavelength of some channels, the colour first: what they are, their names, and what stands before those of their bands.
fn passes(channels: &OfName<'_>) -> Vec<(Aov, String, String)> {
    let mut found = vec![(Aov::Color, Aov::Color.name().to_owned(), String::new())];
    let mut prefixes: Vec<&str> = channels.keys().filter_map(|name| Some(name.rsplit_once(".S0.")?.0)).collect();
    prefixes.sort_unstable();
    prefixes.dedup();
    if prefixes.contains(&"Illuminance") {
        found.push((Aov::Illuminance, Aov::Illuminance.name().to_owned(), "Illuminance.".to_owned()));
    }
    let groups = prefixes.into_iter().filter(|prefix| prefix.starts_with(LIGHT_GROUP)).enumerate();
    found.extend(groups.map(|(number, prefix)| (Aov::LightGroup(number as u16), prefix.to_owned(), format!("{prefix}."))));
    found
}

/// A pass as it looks; black where the file has nothing of it.
fn flat(aov: Aov, name: &str, channels: &OfName<'_>, [width, height]: [usize; 2]) -> Layer {
    let names = channel_names(aov);
    let mut layer = Layer { aov, name: name.to_owned(), values: vec![0.0; names.len() * width * height], channels: names.len() };
    for (k, channel) in names.iter().enumerate() {
        let Some(found) = channels.get(full_name(&layer, channel).as_str()) else { continue };
        layer.values.chunks_exact_mut(names.len()).zip(*found).for_each(|(pixel, value)| pixel[k] = *value);
    }
    layer
}

fn lamp_of(text: &str, bands: &Bands) -> Option<Vec<f32>> {
    let values = text.split_whitespace().map(|value| value.parse().ok().filter(|value: &f32| value.is_finite() && *value >= 0.0));
    values.collect::<Option<Vec<f32>>>().filter(|values| values.len() == bands.count())
}
