//! PNG and JPEG: integers of 8 or 16 bits.

use crate::texture::error::{TextureError, TextureErrorKind};
use crate::texture::image::{Image, Texels};
use crate::texture::limits::{MAX_BYTES, check_size};
use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::{ColorType, ImageDecoder, ImageError, Limits};
use std::io::Cursor;

/// PNG of any colour type and depth; palettes and depths below 8 are expanded.
pub(crate) fn decode_png(bytes: &[u8]) -> Result<Image, TextureError> {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_BYTES);
    read(PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(from_decoder)?, bytes.len())
}

/// JPEG, baseline or progressive: grey, YCbCr, RGB, and CMYK or YCCK with inverted inks as Adobe's programs write them.
pub(crate) fn decode_jpeg(bytes: &[u8]) -> Result<Image, TextureError> {
    // The decoder fills what is missing with grey; a texture half of which is missing is an error here.
    if !bytes.windows(2).rev().any(|marker| marker == [0xff, 0xd9]) {
        return Err(TextureError::malformed("the JPEG data ends before its end-of-image marker: the file is cut short"));
    }
    read(JpegDecoder::new(Cursor::new(bytes)).map_err(from_decoder)?, bytes.len())
}

fn read(decoder: impl ImageDecoder, file_len: usize) -> Result<Image, TextureError> {
    let ((width, height), colour) = (decoder.dimensions(), decoder.color_type());
    check_size(u64::from(width), u64::from(height), u64::from(colour.bytes_per_pixel()), file_len)?;
    let mut buffer = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut buffer).map_err(from_decoder)?;
    let texels = match colour {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Texels::Byte(buffer),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            Texels::Short(buffer.chunks_exact(2).map(|pair| u16::from_ne_bytes([pair[0], pair[1]])).collect())
        }
        other => return Err(TextureError::new(TextureErrorKind::Unsupported, format!("texels of type {other:?} are not supported"))),
    };
    Ok(Image { width, height, channels: u32::from(colour.channel_count()), texels, primaries: None })
}

/// The decoders' errors in one line.
pub(super) fn from_decoder(error: ImageError) -> TextureError {
    match error {
        ImageError::Limits(_) => TextureError::new(TextureErrorKind::TooLarge, "the image is larger than the limits allow"),
        ImageError::Unsupported(what) => TextureError::new(TextureErrorKind::Unsupported, what.to_string()),
        other => TextureError::malformed(other),
    }
}
