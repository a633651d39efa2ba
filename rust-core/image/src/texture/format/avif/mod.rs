//! AVIF: the still picture of a file, coded in AV1. The decoder is `re_rav1d`, a Rust port of dav1d, without its assembly.

mod colour;
mod container;

use crate::colour::{Stated, from_profile};
use crate::texture::error::{TextureError, TextureErrorKind};
use crate::texture::image::{Image, Texels};
use crate::texture::limits::check_size;
use colour::{Matrix, Samples};
use container::{Meta, Name};
use re_rav1d::pixel::YUVRange;
use re_rav1d::{Decoder, Picture, PixelLayout, PlanarImageComponent, Settings};

/// What an alpha plane calls itself.
const ALPHA: [&[u8]; 2] = [b"urn:mpeg:mpegB:cicp:systems:auxiliary:alpha\0", b"urn:mpeg:hevc:2015:auxid:1\0"];

/// AVIF of 8, 10 or 12 bits, in grey or colours, with or without alpha; of a sequence its still picture.
///
/// Errors: pictures of tiles, turned or cropped ones, alpha of another size or multiplied into the colours.
pub(super) fn decode(file: &[u8]) -> Result<Image, TextureError> {
    let meta = Meta::read(file).ok_or_else(|| malformed("the AVIF boxes are missing or cut short"))?;
    let item = meta.primary;
    refuse_what_is_unknown(&meta, item)?;
    let picture = picture(&meta, file, item)?;
    let alpha = meta.referrers(*b"auxl", item).find(|item| is_alpha(&meta, *item));
    let alpha = alpha.map(|item| self::picture(&meta, file, item)).transpose()?;
    let colours = Colours::of(&meta, item, &picture);
    if let Some(alpha) = &alpha
        && (alpha.width(), alpha.height()) != (picture.width(), picture.height())
    {
        return Err(unsupported("alpha of another size than the colours'"));
    }
    assemble(&picture, alpha.as_ref(), &colours)
}

fn malformed(what: &str) -> TextureError {
    TextureError::malformed(what)
}

fn unsupported(what: &str) -> TextureError {
    TextureError::new(TextureErrorKind::Unsupported, format!("the AVIF file has {what}, which is not supported"))
}

fn refuse_what_is_unknown(meta: &Meta<'_>, item: u32) -> Result<(), TextureError> {
    match meta.kind(item).as_ref() {
        Some(b"av01") => {}
        Some(b"grid") => return Err(unsupported("a picture of tiles")),
        _ => return Err(malformed("the AVIF file has no picture coded in AV1")),
    }
    let has = |name: Name| meta.properties(item, name).next();
    if has(*b"irot").is_some_and(|data| data.first().is_some_and(|turns| turns & 3 != 0)) || has(*b"imir").is_some() {
        return Err(unsupported("a picture that is turned or mirrored"));
    }
    if has(*b"clap").is_some() {
        return Err(unsupported("a picture that is cropped"));
    }
    if meta.refers(*b"prem", item) {
        return Err(unsupported("alpha that is multiplied into the colours"));
    }
    Ok(())
}

fn is_alpha(meta: &Meta<'_>, item: u32) -> bool {
    meta.properties(item, *b"auxC").any(|data| data.get(4..).is_some_and(|name| ALPHA.iter().any(|alpha| name.starts_with(alpha))))
}

/// Decodes an item. Its stated size is checked first, and the decoder refuses what is larger.
fn picture(meta: &Meta<'_>, file: &[u8], item: u32) -> Result<Picture, TextureError> {
    let extent = meta.properties(item, *b"ispe").find_map(|data| {
        let number = |at: usize| data.get(at..)?.first_chunk().map(|bytes| u32::from_be_bytes(*bytes));
        Some((number(4)?, number(8)?))
    });
    let (width, height) = extent.ok_or_else(|| malformed("the AVIF file does not state its size"))?;
    // Three planes of the decoder, and the texels.
    check_size(u64::from(width), u64::from(height), 16, file.len())?;
    let data = meta.data(file, item).ok_or_else(|| malformed("the AVIF data ends early: the file is cut short"))?;
    if data.is_empty() {
        return Err(malformed("the AVIF file has no data"));
    }
    let mut settings = Settings::new();
    // One file is one task: images are decoded in parallel already.
    settings.set_n_threads(1);
    settings.set_max_frame_delay(1);
    settings.set_frame_size_limit(width.saturating_mul(height));
    let failed = |error| malformed(&format!("the AV1 data cannot be decoded: {error}"));
    let mut decoder = Decoder::with_settings(&settings).map_err(failed)?;
    decoder.send_data(data, None, None, None).or_else(|error| if error.is_again() { Ok(()) } else { Err(failed(error)) })?;
    let picture = decoder.get_picture().map_err(failed)?;
    if (picture.width(), picture.height()) != (width, height) {
        return Err(malformed("the AV1 data has another size than the file states"));
    }
    Ok(picture)
}

/// How numbers become colours.
struct Colours {
    matrix: Option<Matrix>,
    is_full: bool,
    stated: Stated,
}

impl Colours {
    /// What the file's boxes say counts before what its AV1 data says, and a profile before numbers.
    fn of(meta: &Meta<'_>, item: u32, picture: &Picture) -> Self {
        let is_grey = picture.pixel_layout() == PixelLayout::I400;
        let mut numbers =
            [picture.color_primaries() as u16, picture.transfer_characteristic() as u16, picture.matrix_coefficients() as u16];
        let mut is_full = picture.color_range() == YUVRange::Full;
        let mut profile = None;
        for data in meta.properties(item, *b"colr") {
            match data.split_first_chunk::<4>() {
                Some((b"nclx", [p0, p1, t0, t1, m0, m1, range, ..])) => {
                    numbers = [[*p0, *p1], [*t0, *t1], [*m0, *m1]].map(u16::from_be_bytes);
                    is_full = range & 0x80 != 0;
                }
                Some((b"prof" | b"rICC", data)) => profile = Some(from_profile(data, if is_grey { 1 } else { 3 })),
                _ => {}
            }
        }
        let [primaries, transfer, matrix] = numbers;
        let by_numbers = || match Stated::from_code_points(primaries as u8, transfer as u8) {
            // Pictures that say nothing are sRGB (ISO/IEC 23000-22, section 7.3.6.4), whatever their depth.
            Stated::Nothing if !is_grey => Stated::srgb(),
            stated => stated,
        };
        Self { matrix: Matrix::from_code_point(matrix), is_full, stated: profile.unwrap_or_else(by_numbers) }
    }
}

fn assemble(picture: &Picture, alpha: Option<&Picture>, colours: &Colours) -> Result<Image, TextureError> {
    use PlanarImageComponent::{U, V, Y};
    let is_grey = picture.pixel_layout() == PixelLayout::I400;
    let matrix =
        if is_grey { Matrix::Identity } else { colours.matrix.ok_or_else(|| unsupported("matrix coefficients beyond the usual"))? };
    let is_difference = matrix != Matrix::Identity;
    let plane = |component, is_chroma| Samples::new(picture, component, colours.is_full, is_chroma);
    let luma = plane(Y, false);
    let chroma = (!is_grey).then(|| [plane(U, is_difference), plane(V, is_difference)]);
    let opacity = alpha.map(|alpha| Samples::new(alpha, Y, alpha.color_range() == YUVRange::Full, false));
    let (width, height) = (picture.width(), picture.height());
    let channels = if is_grey { 1 } else { 3 } + u32::from(opacity.is_some());
    let mut values = Vec::with_capacity(width as usize * height as usize * channels as usize);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let first = luma.value(x, y);
        match &chroma {
            None => values.push(first),
            Some([u, v]) => values.extend(matrix.rgb([first, u.value(x, y), v.value(x, y)])),
        }
        values.extend(opacity.as_ref().map(|plane| plane.value(x, y)));
    }
    let texels = if picture.bit_depth() == 8 {
        Texels::Byte(values.iter().map(|x| (x * 255.0).round() as u8).collect())
    } else {
        Texels::Short(values.iter().map(|x| (x * 65_535.0).round() as u16).collect())
    };
    Ok(Image { width, height, channels, texels, stated: colours.stated.clone() })
}
