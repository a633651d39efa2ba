//! Deep pictures as OpenEXR files.

use super::exr::ExrOptions;
use super::write_atomically;
use crate::{
    colour::{Gamut, Primaries, apply, inverse},
    deep::{DeepHeader, DeepPicture, write_deep},
    error::{Error, Result},
    film::Image,
    threads::in_pool,
};
use std::{borrow::Cow, path::Path};

/// Writes the deep picture of an image: RGBA, Z and ZBack as 32-bit floats, whatever the options say of halves.
///
/// # Errors
/// The image has no deep picture, or the file cannot be written.
pub fn write_deep_exr(path: &Path, image: &Image, options: &ExrOptions) -> Result<()> {
    let deep = image.deep.as_ref().ok_or_else(|| Error::setting("deep", "the picture was rendered without the pass 'deep'"))?;
    let deep = in_gamut(deep, options.gamut);
    write_atomically(path, !options.hasty, |file| in_pool(|| write_deep(&deep, &header(image, options), file)))
}

fn header(image: &Image, options: &ExrOptions) -> DeepHeader {
    let signed = |x: u32| i32::try_from(x).unwrap_or(i32::MAX);
    let [left, top, right, bottom] = image.frame.overscan.map(signed);
    let note = |name: &str, text: &str| (name.to_owned(), text.to_owned());
    let mut texts = vec![
        note("software", concat!("gonio ", env!("CARGO_PKG_VERSION"))),
        note("gonio:samples", &image.samples.to_string()),
        note("gonio:unit:Z", "m"),
    ];
    texts.extend(options.attributes.iter().cloned());
    DeepHeader {
        // The picture proper begins at 0; overscan lies outside it.
        display: [(signed(image.resolution[0]) - left - right).max(1), (signed(image.resolution[1]) - top - bottom).max(1)],
        corner: [signed(image.window.min[0]) - left, signed(image.window.min[1]) - top],
        pixel_aspect: image.frame.pixel_aspect as f32,
        white_luminance: 1.0 / if options.exposure > 0.0 { options.exposure } else { 1.0 },
        chromaticities: options.gamut.map(|gamut| {
            let Primaries { red, green, blue, white } = gamut.primaries();
            [red, green, blue, white].map(|place| place.map(|x| x as f32))
        }),
        texts,
    }
}

/// The samples with their colours in a gamut.
fn in_gamut(deep: &DeepPicture, gamut: Option<Gamut>) -> Cow<'_, DeepPicture> {
    let Some(matrix) = gamut.and_then(Gamut::to_rec709).and_then(|matrix| inverse(&matrix)) else { return Cow::Borrowed(deep) };
    let mut deep = deep.clone();
    for sample in &mut deep.samples {
        let [red, green, blue, alpha] = sample.rgba;
        let [red, green, blue] = apply(&matrix, [red, green, blue].map(f64::from)).map(|value| value as f32);
        sample.rgba = [red, green, blue, alpha];
    }
    Cow::Owned(deep)
}
