//! One quantity of an EXR file or a Radiance picture.

use super::{file, radiance, wavelengths::derived};
use gonio::{
    Error, Result,
    colour::luminance_of_pixel,
    film::{Image, Layer, PictureView},
    output::{Channels, has_other_primaries, read_exr, view_of_exr, white_luminance_of_exr},
    scene::Aov,
};
use std::path::Path;

/// The longest Radiance picture in bytes: 65,536 pixels to each side, not compressed.
const LONGEST: u64 = 16 << 30;

/// How a file says it was taken, or why what it says is of no use.
type View = std::result::Result<Option<PictureView>, String>;

/// The channels of a file, with width and height, and the place of the one that was asked for.
pub(super) struct Picture {
    pub(super) channels: Channels,
    pub(super) size: [usize; 2],
    pub(super) view: View,
    chosen: usize,
}

/// A picture of red, green, blue and coverage, rows from the top.
pub(super) fn picture_of(values: Vec<f32>, size: [usize; 2]) -> Image {
    Image { layers: vec![Layer { aov: Aov::Color, name: "color".into(), values, channels: 4 }], ..empty_picture(size) }
}

/// A picture without layers.
pub(super) fn empty_picture(size: [usize; 2]) -> Image {
    Image { samples: 1, mean_samples: 1.0, ..Image::empty(size) }
}

/// Red, green and blue among a file's channels, also under the names that Blender gives them; `wanted` says who asks.
pub(super) fn colour_of<'a>(path: &Path, channels: &'a Channels, wanted: &str) -> Result<[&'a [f32]; 3]> {
    let channel = |name: &str| {
        let found = channels.iter().find(|(known, _)| known == name || known.ends_with(&format!("Combined.{name}")));
        let problem = || format!("{wanted}; there is no {name}");
        found.map(|(_, values)| values.as_slice()).ok_or_else(|| Error::Format { path: path.to_owned(), line: None, problem: problem() })
    };
    Ok([channel("R")?, channel("G")?, channel("B")?])
}

impl Picture {
    /// Reads a file. A channel is found by its whole name, or by a part of it between points that no other has: Blender's files call it
    /// `ViewLayer.Luminance.X`.
    pub(super) fn read(path: &Path, quantity: &str) -> Result<Self> {
        let (mut channels, size, view) = channels_of(path)?;
        if channels.iter().all(|(name, _)| name != quantity)
            && let Some(values) = derived(path, (&channels, size), quantity)?
        {
            channels.push((quantity.to_owned(), values));
        }
        let is_part = |name: &str| name.split('.').any(|part| part.eq_ignore_ascii_case(quantity));
        if quantity.eq_ignore_ascii_case("luminance")
            && !channels.iter().any(|(name, _)| is_part(name))
            && let Some(values) = luminances(path, &channels)?
        {
            channels.push((quantity.to_owned(), values));
        }
        let by_name = channels.iter().position(|(name, _)| name == quantity);
        let has_part = |index: &usize| is_part(&channels[*index].0);
        let by_part: Vec<usize> = (0..channels.len()).filter(has_part).collect();
        let names = |of: &[usize]| of.iter().map(|index| channels[*index].0.as_str()).collect::<Vec<_>>().join(", ");
        let chosen = match (by_name, &by_part[..]) {
            (Some(whole), _) => whole,
            (None, [part]) => *part,
            (None, []) => {
                let known = names(&(0..channels.len()).collect::<Vec<_>>());
                let problem =
                    format!("there is no channel '{quantity}' (gonio render writes it with --aov {quantity} to EXR); the file has {known}");
                return Err(Error::Format { path: path.to_owned(), line: None, problem });
            }
            (None, several) => {
                let problem = format!("'{quantity}' names several channels, expected one of {}", names(several));
                return Err(Error::setting("quantity", problem));
            }
        };
        Ok(Self { channels, size, view, chosen })
    }

    /// The channel that was asked for.
    pub(super) fn values(&self) -> &[f32] {
        &self.channels[self.chosen].1
    }

    /// The unit of a quantity as a legend shows it; empty where none is known.
    pub(super) fn unit(quantity: &str) -> &'static str {
        match quantity.to_ascii_lowercase().as_str() {
            "luminance" => "cd/m²",
            "illuminance" | "melanopic-edi" => "lx",
            "cct" => "K",
            "melanopic" => "cd/m²",
            _ => "",
        }
    }
}

/// Luminances in cd/m² by the colour of a file that says what its white amounts to.
fn luminances(path: &Path, channels: &Channels) -> Result<Option<Vec<f32>>> {
    let (Some(white), Ok([red, green, blue])) = (white_luminance_of_exr(path)?, colour_of(path, channels, "luminance")) else {
        return Ok(None);
    };
    if has_other_primaries(path)? {
        return Ok(None);
    }
    let of_pixel = |((r, g), b): ((&f32, &f32), &f32)| white * luminance_of_pixel([*r, *g, *b]);
    Ok(Some(red.iter().zip(green).zip(blue).map(of_pixel).collect()))
}

/// A file's channels, width and height, and view.
fn channels_of(path: &Path) -> Result<(Channels, [usize; 2], View)> {
    if radiance::is_radiance(&file::start(path, 2)?) {
        let (channels, size, words) = radiance::read(path, file::read(path, LONGEST, "picture")?)?;
        return Ok((channels, size, words.map(|words| radiance::view(&words)).transpose()));
    }
    let (channels, size) = read_exr(path)?;
    Ok((channels, size, Ok(view_of_exr(path)?)))
}
