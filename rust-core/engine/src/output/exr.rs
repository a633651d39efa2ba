//! OpenEXR: all passes of an image in one part, named as compositors expect, with units in the header.

use super::write_atomically;
use crate::{
    colour::{Gamut, Primaries, apply, inverse},
    error::{Error, Result},
    film::{Image, Layer, PictureView, channel_names, is_absolute},
    scene::{Aov, matte_key, open_file},
};
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, ImageAttributes, IntegerBounds, Layer as ExrLayer, LayerAttributes,
    Text, Vec2, WritableImage, f16,
};
use std::{borrow::Cow, collections::HashMap, path::Path};

/// How colour is stored, and what the header says.
#[derive(Clone, Debug, Default)]
pub struct ExrOptions {
    /// Half floats for passes that are not absolute.
    pub half: bool,
    /// Names of further passes in half floats, whatever they hold.
    pub half_layers: Vec<String>,
    /// The gamut of the colours; `None` is Rec.709, in which images come. What is measured stays.
    pub gamut: Option<Gamut>,
    /// Exposure that the colour pass was multiplied by; 0 counts as 1.
    pub exposure: f32,
    /// Written at once rather than small and safe on disk: for a render that was interrupted.
    pub hasty: bool,
    /// Further text attributes.
    pub attributes: Vec<(String, String)>,
}

/// Channels by name, 32-bit floats a pixel, rows from the top.
pub type Further = Vec<(String, Vec<f32>)>;

/// Writes all passes of an image; absolute ones always as 32-bit floats.
pub fn write_exr(path: &Path, image: &Image, options: &ExrOptions) -> Result<()> {
    write_exr_with(path, image, &Further::new(), options)
}

/// The same with further channels beside the passes.
pub fn write_exr_with(path: &Path, image: &Image, further: &Further, options: &ExrOptions) -> Result<()> {
    write_atomically(path, !options.hasty, |file| {
        let mut out = picture(&in_gamut(image, options.gamut), options);
        let mut channels = std::mem::take(&mut out.layer_data.channel_data.list);
        channels.extend(further.iter().map(|(name, values)| AnyChannel::new(Text::from(name.as_str()), FlatSamples::F32(values.clone()))));
        out.layer_data.channel_data = AnyChannels::sort(channels);
        let written = out.write().to_buffered(file);
        written.map_err(|error| match error {
            exr::error::Error::Io(error) => error,
            other => std::io::Error::other(other.to_string()),
        })
    })
}

/// An image as the library writes it: one layer of channels of either depth.
type ExrImage = exr::image::Image<ExrLayer<AnyChannels<FlatSamples>>>;

fn picture(image: &Image, options: &ExrOptions) -> ExrImage {
    let [width, height] = image.size();
    let [left, top, right, bottom] = image.frame.overscan.map(signed);
    let is_half = |layer: &Layer| options.half_layers.contains(&layer.name) || options.half && !is_absolute(layer.aov);
    let channels = image.layers.iter().flat_map(|layer| channels_of(layer, is_half(layer))).collect();
    let mut attributes = LayerAttributes {
        layer_position: Vec2(signed(image.window.min[0]) - left, signed(image.window.min[1]) - top),
        software_name: Some(Text::from(concat!("gonio ", env!("CARGO_PKG_VERSION")))),
        white_luminance: Some(1.0 / if options.exposure > 0.0 { options.exposure } else { 1.0 }),
        ..LayerAttributes::default()
    };
    let mut note = |name: &str, text: &str| {
        attributes.other.insert(Text::from(name), AttributeValue::Text(Text::from(text)));
    };
    note("gonio:samples", &image.samples.to_string());
    for layer in &image.layers {
        if let Some(unit) = unit(layer.aov, options.gamut) {
            note(&format!("gonio:unit:{}", name(layer)), unit);
        }
    }
    for (key, value) in image.frame.view.iter().flat_map(PictureView::notes) {
        note(key, &value);
    }
    for (key, value) in &options.attributes {
        note(key, value);
    }
    for (key, text) in matte_notes(image, "") {
        attributes.other.insert(Text::from(key.as_str()), AttributeValue::Text(Text::from_slice_unchecked(text.as_bytes())));
    }
    let encoding = if options.hasty { Encoding::UNCOMPRESSED } else { Encoding::FAST_LOSSLESS };
    let layer = ExrLayer::new((width, height), attributes, encoding, AnyChannels::sort(channels));
    // The picture proper begins at 0; overscan lies outside it.
    let side = |axis: usize, beyond: i32| (signed(image.resolution[axis]) - beyond).max(1) as usize;
    let display = IntegerBounds::new((0, 0), (side(0, left + right), side(1, top + bottom)));
    let mut out = exr::image::Image::from_layer(layer);
    let chromaticities = options.gamut.map(|gamut| chromaticities(gamut.primaries()));
    let pixel_aspect = image.frame.pixel_aspect as f32;
    out.attributes = ImageAttributes { display_window: display, pixel_aspect, chromaticities, ..out.attributes };
    out
}

fn chromaticities(primaries: Primaries) -> Chromaticities {
    let place = |[x, y]: [f64; 2]| Vec2(x as f32, y as f32);
    let Primaries { red, green, blue, white } = primaries;
    Chromaticities { red: place(red), green: place(green), blue: place(blue), white: place(white) }
}

/// The image with its colours in a gamut.
fn in_gamut(image: &Image, gamut: Option<Gamut>) -> Cow<'_, Image> {
    let Some(matrix) = gamut.and_then(Gamut::to_rec709).and_then(|matrix| inverse(&matrix)) else { return Cow::Borrowed(image) };
    let mut image = image.clone();
    for layer in image.layers.iter_mut().filter(|layer| layer.channels >= 3 && is_colour(layer.aov)) {
        for pixel in layer.values.chunks_exact_mut(layer.channels) {
            let colour = apply(&matrix, [pixel[0], pixel[1], pixel[2]].map(f64::from));
            pixel.iter_mut().zip(colour).for_each(|(value, colour)| *value = colour as f32);
        }
    }
    Cow::Owned(image)
}

/// Whether a pass is of light or of what colours it.
fn is_colour(aov: Aov) -> bool {
    use Aov::{Albedo, Color, DenoisingAlbedo, DenoisingLight, Emission, Environment, Light, LightExpression, LightGroup, LightPaths};
    matches!(
        aov,
        Color
            | LightGroup(_)
            | LightPaths(..)
            | LightExpression(_)
            | Light(..)
            | Emission
            | Environment
            | Albedo
            | DenoisingAlbedo
            | DenoisingLight
    )
}

/// What headers say about mattes, by key (Cryptomatte specification 1.2, "Metadata"); `prefix` comes before the layers' names. Names of things
/// may be any UTF-8.
pub fn matte_notes(image: &Image, prefix: &str) -> Vec<(String, String)> {
    let mut notes = Vec::new();
    for layer in &image.layers {
        // The first layer of a matte speaks for all; their names end with two digits.
        let Aov::Cryptomatte(kind, 0) = layer.aov else { continue };
        let base = format!("{prefix}{}", layer.name.strip_suffix("00").unwrap_or(&layer.name));
        let key = |what: &str| format!("cryptomatte/{}/{what}", matte_key(&base));
        notes.push((key("name"), base.clone()));
        notes.push((key("hash"), "MurmurHash3_32".to_owned()));
        notes.push((key("conversion"), "uint32_to_float32".to_owned()));
        notes.push((key("manifest"), image.manifests.json(kind)));
    }
    notes
}

fn signed(x: u32) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX)
}

/// A pass's name in files.
fn name(layer: &Layer) -> &str {
    match layer.aov {
        Aov::Luminance => "Luminance",
        Aov::Illuminance => "Illuminance",
        _ => &layer.name,
    }
}

fn unit(aov: Aov, gamut: Option<Gamut>) -> Option<&'static str> {
    match aov {
        Aov::Luminance => Some("cd/m2"),
        Aov::Illuminance => Some("lx"),
        Aov::Depth | Aov::P => Some("m"),
        Aov::Cost => Some("s"),
        Aov::Color | Aov::LightGroup(_) | Aov::LightPaths(..) | Aov::LightExpression(_) if gamut.is_some() => {
            Some("linear, of the header's chromaticities, luminance in cd/m2 times exposure")
        }
        Aov::Color | Aov::LightGroup(_) | Aov::LightPaths(..) | Aov::LightExpression(_) => {
            Some("linear Rec.709, luminance in cd/m2 times exposure")
        }
        _ => None,
    }
}

/// The name of a pass's channel in files.
pub(super) fn full_name(layer: &Layer, channel: &str) -> String {
    let single = channel_names(layer.aov).len() == 1;
    match layer.aov {
        Aov::Color => channel.to_owned(),
        aov if single && aov != Aov::Depth => name(layer).to_owned(),
        _ => format!("{}.{channel}", name(layer)),
    }
}

fn channels_of(layer: &Layer, half: bool) -> Vec<AnyChannel<FlatSamples>> {
    let names = channel_names(layer.aov);
    let columns = columns(&layer.values, layer.channels);
    let channel = |(name, values): (&&str, Vec<f32>)| AnyChannel::new(Text::from(full_name(layer, name).as_str()), samples(values, half));
    names.iter().zip(columns).map(channel).collect()
}

fn samples(values: Vec<f32>, half: bool) -> FlatSamples {
    if half {
        // Beyond half's range the largest half is nearer than infinity.
        FlatSamples::F16(values.into_iter().map(|v| f16::from_f32(v.clamp(-65504.0, 65504.0))).collect())
    } else {
        FlatSamples::F32(values)
    }
}

/// The columns of a table of pixels in rows of `channels` values.
fn columns(values: &[f32], channels: usize) -> Vec<Vec<f32>> {
    // Strides that the compiler knows are several times as fast, which who interrupts a large render waits for.
    let column = |channel| match channels {
        1 => values.to_vec(),
        3 => column::<3>(values, channel),
        4 => column::<4>(values, channel),
        _ => values.chunks_exact(channels).map(|pixel| pixel[channel]).collect(),
    };
    (0..channels).map(column).collect()
}

fn column<const CHANNELS: usize>(values: &[f32], channel: usize) -> Vec<f32> {
    let (pixels, _) = values.as_chunks::<CHANNELS>();
    pixels.iter().map(|pixel| pixel[channel]).collect()
}

/// The attributes of a file's first part.
fn attributes(path: &Path) -> Result<LayerAttributes> {
    let failed = |error: exr::error::Error| Error::Format { path: path.to_owned(), line: None, problem: error.to_string() };
    open_file(path).map_err(|error| Error::io(path, error))?;
    let meta = exr::meta::MetaData::read_from_file(path, false).map_err(failed)?;
    Ok(meta.headers.into_iter().next().map(|header| header.own_attributes).unwrap_or_default())
}

/// Whether a file says that its colours have other primaries than Rec.709's.
pub fn has_other_primaries(path: &Path) -> Result<bool> {
    let failed = |error: exr::error::Error| Error::Format { path: path.to_owned(), line: None, problem: error.to_string() };
    open_file(path).map_err(|error| Error::io(path, error))?;
    let meta = exr::meta::MetaData::read_from_file(path, false).map_err(failed)?;
    let stated = meta.headers.first().and_then(|header| header.shared_attributes.chromaticities);
    let near = |found: Vec2<f32>, [x, y]: [f32; 2]| (found.0 - x).abs() < 1e-3 && (found.1 - y).abs() < 1e-3;
    let is_rec709 = |c: Chromaticities| near(c.red, [0.64, 0.33]) && near(c.green, [0.3, 0.6]) && near(c.blue, [0.15, 0.06]);
    Ok(stated.is_some_and(|stated| !is_rec709(stated)))
}

/// How a file's picture was taken, as [`write_exr`] notes it; none where nothing is noted.
pub fn view_of_exr(path: &Path) -> Result<Option<PictureView>> {
    let texts = texts_of_exr(path)?;
    Ok(PictureView::from_notes(|name| texts.get(name).map(String::as_str)))
}

/// The texts of a file's header by name.
pub(super) fn texts_of_exr(path: &Path) -> Result<HashMap<String, String>> {
    let text = |(name, value): (Text, AttributeValue)| match value {
        AttributeValue::Text(text) => Some((name.to_string(), text.to_string())),
        _ => None,
    };
    Ok(attributes(path)?.other.into_iter().filter_map(text).collect())
}

/// The exposure that a file's colour was multiplied by, as [`write_exr`] notes it; 1 where nothing is noted.
pub fn exposure_of_exr(path: &Path) -> Result<f32> {
    Ok(white_luminance_of_exr(path)?.map_or(1.0, f32::recip))
}

/// What white of 1 in a file's colour amounts to in cd/m², as [`write_exr`] notes it; none where nothing is noted.
pub fn white_luminance_of_exr(path: &Path) -> Result<Option<f32>> {
    Ok(attributes(path)?.white_luminance.filter(|white| *white > 0.0 && white.is_finite()))
}

/// Values of channels by name.
pub type Channels = Vec<(String, Vec<f32>)>;

/// Channels of an EXR file by name, with width and height; for comparing.
pub fn read_exr(path: &Path) -> Result<(Channels, [usize; 2])> {
    let failed = |error: exr::error::Error| Error::Format { path: path.to_owned(), line: None, problem: error.to_string() };
    open_file(path).map_err(|error| Error::io(path, error))?;
    let image = exr::prelude::read_all_flat_layers_from_file(path).map_err(failed)?;
    let mut channels = Vec::new();
    let mut size = [0, 0];
    for layer in image.layer_data {
        size = [layer.size.width(), layer.size.height()];
        let prefix = layer.attributes.layer_name.as_ref().map(|name| format!("{name}.")).unwrap_or_default();
        for channel in layer.channel_data.list {
            let values = channel.sample_data.values_as_f32().collect();
            channels.push((format!("{prefix}{}", channel.name), values));
        }
    }
    Ok((channels, size))
}
