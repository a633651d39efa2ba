//! Radiance HDR: RGBE or XYZE texels.

use super::bitmap::from_decoder;
use crate::colour::{Gamut, Primaries, Stated};
use crate::texture::error::TextureError;
use crate::texture::image::{Image, Texels};
use crate::texture::limits::check_size;
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use std::borrow::Cow;
use std::io::Cursor;

const XYZE: &[u8] = b"32-bit_rle_xyze";

/// Radiance pictures with either signature. `EXPOSURE` lines are left alone, as other renderers do; `PRIMARIES` are noted.
pub(crate) fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let header = &bytes[..bytes.windows(2).position(|pair| pair == b"\n\n").unwrap_or(0)];
    let is_xyz = header.windows(XYZE.len()).any(|word| word == XYZE);
    // XYZE is coded as RGBE is and only means something else; the decoder knows RGBE alone.
    let renamed = if is_xyz { Cow::Owned(rename_format(bytes, header.len())) } else { Cow::Borrowed(bytes) };
    // The strict reader refuses the signature `#?RGBE`.
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(renamed.as_ref())).map_err(from_decoder)?;
    let (width, height) = decoder.dimensions();
    check_size(u64::from(width), u64::from(height), 12, bytes.len())?;
    let stated =
        decoder.metadata().custom_attributes.iter().rev().find(|(key, _)| key == "PRIMARIES").and_then(|(_, text)| parse_primaries(text));
    let mut buffer = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut buffer).map_err(from_decoder)?;
    let values = buffer.chunks_exact(4).map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect();
    let primaries = if is_xyz { Some(Gamut::XyzE.primaries()) } else { stated };
    let stated = primaries.map_or(Stated::Nothing, |primaries| Stated::linear(&primaries));
    Ok(Image { width, height, channels: 3, texels: Texels::Float(values), stated })
}

fn rename_format(bytes: &[u8], header_len: usize) -> Vec<u8> {
    let mut renamed = bytes.to_vec();
    if let Some(at) = bytes[..header_len].windows(XYZE.len()).position(|word| word == XYZE) {
        renamed[at..at + XYZE.len()].copy_from_slice(b"32-bit_rle_rgbe");
    }
    renamed
}

/// Eight numbers: x and y of red, green, blue and white.
fn parse_primaries(text: &str) -> Option<Primaries> {
    let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let [rx, ry, gx, gy, bx, by, wx, wy] = numbers.try_into().ok()?;
    Some(Primaries { red: [rx, ry], green: [gx, gy], blue: [bx, by], white: [wx, wy] })
}
