//! Image file formats, told apart by their first bytes.

mod avif;
mod bitmap;
mod exr;
mod hdr;
mod png;
mod tiff;

pub use hdr::RadianceHeader;

use super::error::{TextureError, TextureErrorKind};
use super::image::Image;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What `decode` reads, for messages.
const KNOWN: &str = "PNG, JPEG, TIFF, OpenEXR, Radiance HDR, WebP, AVIF, TGA, BMP, GIF or DDS";

/// Decodes an image of a known format from memory.
///
/// Errors: another format, damaged or truncated contents, or a size beyond the limits. The error's path is empty.
pub fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let decoder: fn(&[u8]) -> Result<Image, TextureError> = match bytes {
        [0x89, b'P', b'N', b'G', ..] => png::decode,
        [0xff, 0xd8, ..] => bitmap::decode_jpeg,
        [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode,
        [b'#', b'?', ..] => hdr::decode,
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => tiff::decode,
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => bitmap::decode_webp,
        [b'G', b'I', b'F', b'8', ..] => bitmap::decode_gif,
        [b'B', b'M', ..] => bitmap::decode_bmp,
        [b'D', b'D', b'S', b' ', ..] => bitmap::decode_dds,
        [_, _, _, _, b'f', b't', b'y', b'p', b'a', b'v', b'i', b'f' | b's', ..] => avif::decode,
        _ if bitmap::is_tga(bytes) => bitmap::decode_tga,
        _ => return Err(unknown(bytes)),
    };
    // Decoders of damaged files may trip over their own assertions; nothing outlives a failed one.
    catch_unwind(AssertUnwindSafe(|| decoder(bytes)))
        .unwrap_or_else(|_| Err(TextureError::malformed("the file is damaged: its decoder gave up")))
}

fn unknown(bytes: &[u8]) -> TextureError {
    let name = match bytes {
        [] => return TextureError::malformed("the file is empty"),
        [0xab, b'K', b'T', b'X', ..] => "a KTX file",
        [b'8', b'B', b'P', b'S', ..] => "a Photoshop file",
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => "a HEIF or movie file",
        [b'S', b'D', b'P', b'X', ..] | [b'X', b'P', b'D', b'S', ..] => "a DPX file",
        [b'v', b'e', b'r', b's', b'i', b'o', b'n', b' ', ..] => "a Git LFS pointer, not the image itself",
        _ => "of no known image format",
    };
    TextureError::new(TextureErrorKind::Unsupported, format!("the file is {name}, expected {KNOWN}")).hint("convert it to one of these")
}
