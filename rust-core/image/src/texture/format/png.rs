//! PNG, and what its header says of colours (PNG specification, third edition, sections 11.3.2 and 13.14).

use super::bitmap::{from_decoder, read};
use crate::colour::{Curve, Encoding, Gamut, Primaries, Stated, Transfer, from_profile};
use crate::texture::error::TextureError;
use crate::texture::image::Image;
use crate::texture::limits::most_bytes;
use image::codecs::png::PngDecoder;
use image::{ImageDecoder, Limits};
use std::io::Cursor;

/// PNG of any colour type and depth; palettes and depths below 8 are expanded.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(most_bytes());
    let mut decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(from_decoder)?;
    let profile = decoder.icc_profile().ok().flatten();
    let stated = stated(bytes, profile.as_deref(), u32::from(decoder.color_type().channel_count()));
    read(decoder, stated, bytes.len())
}

/// `cICP` counts before the profile, the profile before `sRGB`, and that before `gAMA` and `cHRM` (section 13.14).
fn stated(file: &[u8], profile: Option<&[u8]>, channels: u32) -> Stated {
    let chunk = |name: &[u8; 4]| chunks(file).find(|(found, _)| *found == name).map(|(_, data)| data);
    if let Some([primaries, transfer, ..]) = chunk(b"cICP") {
        return Stated::from_code_points(*primaries, *transfer);
    }
    if let Some(profile) = profile {
        return from_profile(profile, channels);
    }
    if chunk(b"sRGB").is_some() {
        return Stated::srgb();
    }
    let Some(curve) = chunk(b"gAMA").and_then(curve) else { return Stated::Nothing };
    let primaries = chunk(b"cHRM").and_then(primaries).unwrap_or_else(|| Gamut::Rec709.primaries());
    Encoding::of_primaries(curve, &primaries).map_or(Stated::Nothing, Stated::Encoding)
}

/// The chunks before the pixels: names and contents.
fn chunks(file: &[u8]) -> impl Iterator<Item = (&[u8], &[u8])> {
    let mut rest = file.get(8..).unwrap_or_default();
    std::iter::from_fn(move || {
        let (length, body) = rest.split_first_chunk::<4>()?;
        let (name, data) = body.split_at_checked(4)?;
        let length = u32::from_be_bytes(*length) as usize;
        let data = data.get(..length)?;
        // The checksum follows.
        rest = body.get(length.checked_add(8)?..)?;
        (name != b"IDAT").then_some((name, data))
    })
}

/// The exponent that was used for storing, in hundred thousandths. That of sRGB's usual stand-in means sRGB itself (section 11.3.2.5).
fn curve(data: &[u8]) -> Option<Curve> {
    match u32::from_be_bytes(*data.first_chunk()?) {
        0 => None,
        45_455 => Some(Curve::Named(Transfer::Srgb)),
        exponent => Some(Curve::Power(1e5 / f64::from(exponent))),
    }
}

/// White, red, green and blue in hundred thousandths.
fn primaries(data: &[u8]) -> Option<Primaries> {
    let numbers: Vec<f64> = data.chunks_exact(4).map(|n| f64::from(u32::from_be_bytes([n[0], n[1], n[2], n[3]])) / 1e5).collect();
    let [wx, wy, rx, ry, gx, gy, bx, by] = numbers.try_into().ok()?;
    Some(Primaries { red: [rx, ry], green: [gx, gy], blue: [bx, by], white: [wx, wy] })
}
