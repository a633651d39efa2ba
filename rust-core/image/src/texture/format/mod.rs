//! Image file formats, told apart by their first bytes.

mod bitmap;
mod exr;
mod hdr;

pub use hdr::RadianceHeader;

use super::error::{TextureError, TextureErrorKind};
use super::image::Image;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Decodes PNG, JPEG, Radiance HDR or OpenEXR from memory.
///
/// Errors: another format, damaged or truncated contents, or a size beyond the limits. The error's path is empty.
pub fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let decoder: fn(&[u8]) -> Result<Image, TextureError> = match bytes {
        [0x89, b'P', b'N', b'G', ..] => bitmap::decode_png,
        [0xff, 0xd8, ..] => bitmap::decode_jpeg,
        [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode,
        [b'#', b'?', ..] => hdr::decode,
        _ => return Err(unknown(bytes)),
    };
    // Decoders of damaged files may trip over their own assertions; nothing outlives a failed one.
    catch_unwind(AssertUnwindSafe(|| decoder(bytes)))
        .unwrap_or_else(|_| Err(TextureError::malformed("the file is damaged: its decoder gave up")))
}

fn unknown(bytes: &[u8]) -> TextureError {
    let name = match bytes {
        [] => return TextureError::malformed("the file is empty"),
        [b'I', b'I', 42 | 43, ..] | [b'M', b'M', _, 42 | 43, ..] => "a TIFF file",
        [b'G', b'I', b'F', b'8', ..] => "a GIF file",
        [b'B', b'M', ..] => "a BMP file",
        [b'R', b'I', b'F', b'F', ..] => "a WebP file",
        [b'D', b'D', b'S', b' ', ..] => "a DDS file",
        [0xab, b'K', b'T', b'X', ..] => "a KTX file",
        [b'S', b'D', b'P', b'X', ..] | [b'X', b'P', b'D', b'S', ..] => "a DPX file",
        [b'v', b'e', b'r', b's', b'i', b'o', b'n', b' ', ..] => "a Git LFS pointer, not the image itself",
        _ => "of no known image format",
    };
    TextureError::new(TextureErrorKind::Unsupported, format!("the file is {name}, expected PNG, JPEG, Radiance HDR or OpenEXR"))
        .hint("convert it to one of these")
}
