//! Radiance HDR: RGBE or XYZE texels, as the picture was before anybody brightened it.

mod header;

pub use header::RadianceHeader;

use super::bitmap::from_decoder;
use crate::colour::Stated;
use crate::texture::error::TextureError;
use crate::texture::image::{Image, Texels};
use crate::texture::limits::check_size;
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use std::io::{Cursor, Read};

/// Radiance pictures with either signature and any order of scan lines. Texels are divided by all `EXPOSURE` and `COLORCORR` lines, as
/// Radiance's own `pvalue -o` does; `PRIMARIES` are noted.
pub(crate) fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let header = RadianceHeader::read(bytes)?;
    let [lines, length] = header.scan_lines();
    check_size(u64::from(length), u64::from(lines), 12, bytes.len())?;
    // The decoder knows one order of scan lines and RGBE alone; XYZE is coded as RGBE is and only means something else.
    let plain = format!("FORMAT=32-bit_rle_rgbe\n\n-Y {lines} +X {length}\n");
    let source = Cursor::new(plain.into_bytes()).chain(&bytes[header.length..]);
    let decoder = HdrDecoder::new_nonstrict(source).map_err(from_decoder)?;
    let mut buffer = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut buffer).map_err(from_decoder)?;
    let factors = header.factors().map(|factor| factor as f32);
    let texel = |b: &[u8; 12]| [0, 1, 2].map(|c| f32::from_ne_bytes([b[4 * c], b[4 * c + 1], b[4 * c + 2], b[4 * c + 3]]) * factors[c]);
    let texels: Vec<[f32; 3]> = buffer.as_chunks::<12>().0.iter().map(texel).collect();
    let [width, height] = header.size;
    let stated = header.primaries.map_or(Stated::Nothing, |primaries| Stated::linear(&primaries));
    Ok(Image { width, height, channels: 3, texels: Texels::Float(header.upright(&texels)), stated })
}
