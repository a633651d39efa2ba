//! JPEG, BMP, TGA, GIF, WebP and DDS: integers of 8 or 16 bits through the crate `image`.

use crate::colour::{Stated, from_profile};
use crate::texture::error::{TextureError, TextureErrorKind};
use crate::texture::image::{Image, Texels};
use crate::texture::limits::{check_size, most_bytes};
use image::codecs::{bmp::BmpDecoder, dds::DdsDecoder, gif::GifDecoder, jpeg::JpegDecoder, tga::TgaDecoder, webp::WebPDecoder};
use image::{ColorType, ImageDecoder, ImageError, Limits};
use std::io::Cursor;

/// JPEG, baseline or progressive: grey, YCbCr, RGB, and CMYK or YCCK with inverted inks as Adobe's programs write them.
pub(super) fn decode_jpeg(bytes: &[u8]) -> Result<Image, TextureError> {
    // The decoder fills what is missing with grey; a texture half of which is missing is an error here.
    if !bytes.windows(2).rev().any(|marker| marker == [0xff, 0xd9]) {
        return Err(TextureError::malformed("the JPEG data ends before its end-of-image marker: the file is cut short"));
    }
    with_profile(JpegDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, bytes.len())
}

/// WebP, lossy or lossless; of an animation the first picture.
pub(super) fn decode_webp(bytes: &[u8]) -> Result<Image, TextureError> {
    with_profile(WebPDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, bytes.len())
}

/// GIF: the first picture.
pub(super) fn decode_gif(bytes: &[u8]) -> Result<Image, TextureError> {
    with_profile(GifDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, bytes.len())
}

/// BMP, with palettes and run lengths.
pub(super) fn decode_bmp(bytes: &[u8]) -> Result<Image, TextureError> {
    read(BmpDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, Stated::Nothing, bytes.len())
}

/// DDS with the block compressions BC1, BC2 and BC3 (DXT1 to DXT5).
pub(super) fn decode_dds(bytes: &[u8]) -> Result<Image, TextureError> {
    read(DdsDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, Stated::Nothing, bytes.len())
}

/// Truevision TGA, with palettes and run lengths.
pub(super) fn decode_tga(bytes: &[u8]) -> Result<Image, TextureError> {
    read(TgaDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, Stated::Nothing, bytes.len())
}

/// Whether the file is a TGA. The format has no signature: its footer tells, or a header in which nothing contradicts (Truevision TGA
/// specification 2.0, 1991).
pub(super) fn is_tga(bytes: &[u8]) -> bool {
    let [_, map_type, kind, _, _, _, _, map_depth, _, _, _, _, w0, w1, h0, h1, depth, descriptor, ..] = *bytes else { return false };
    let has_map = matches!((map_type, map_depth), (1, 15 | 16 | 24 | 32));
    let has_no_map = map_type == 0 && map_depth == 0;
    let is_known = match kind {
        1 | 9 => has_map && matches!(depth, 8 | 16),
        2 | 10 => (has_map || has_no_map) && matches!(depth, 15 | 16 | 24 | 32),
        3 | 11 => (has_map || has_no_map) && matches!(depth, 8 | 16),
        _ => false,
    };
    let has_size = (w0 | w1) != 0 && (h0 | h1) != 0;
    bytes.ends_with(b"TRUEVISION-XFILE.\0") || (is_known && has_size && descriptor & 0xc0 == 0)
}

/// Reads an image whose decoder knows its ICC profile.
fn with_profile(mut decoder: impl ImageDecoder, file_len: usize) -> Result<Image, TextureError> {
    // A profile that cannot be read spoils no picture.
    let profile = decoder.icc_profile().ok().flatten();
    let channels = u32::from(decoder.color_type().channel_count());
    let stated = profile.map_or(Stated::Nothing, |profile| from_profile(&profile, channels));
    read(decoder, stated, file_len)
}

/// The texels of an image of 8 or 16 bits whose header says `stated`.
pub(super) fn read(mut decoder: impl ImageDecoder, stated: Stated, file_len: usize) -> Result<Image, TextureError> {
    let ((width, height), colour) = (decoder.dimensions(), decoder.color_type());
    check_size(u64::from(width), u64::from(height), u64::from(colour.bytes_per_pixel()), file_len)?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(most_bytes());
    decoder.set_limits(limits).map_err(from_decoder)?;
    let mut buffer = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut buffer).map_err(from_decoder)?;
    let texels = match colour {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Texels::Byte(buffer),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            Texels::Short(buffer.chunks_exact(2).map(|pair| u16::from_ne_bytes([pair[0], pair[1]])).collect())
        }
        other => return Err(TextureError::new(TextureErrorKind::Unsupported, format!("texels of type {other:?} are not supported"))),
    };
    Ok(Image { width, height, channels: u32::from(colour.channel_count()), texels, stated })
}

/// The decoders' errors in one line.
pub(super) fn from_decoder(error: ImageError) -> TextureError {
    match error {
        ImageError::Limits(_) => TextureError::new(TextureErrorKind::TooLarge, "the image is larger than the limits allow"),
        ImageError::Unsupported(what) => TextureError::new(TextureErrorKind::Unsupported, what.to_string()),
        other => TextureError::malformed(other),
    }
}
