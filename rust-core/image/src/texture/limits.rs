//! Sizes are checked before anything is allocated by what a header claims.

use super::error::{TextureError, TextureErrorKind};
use crate::memory::{free_memory, room_for};

/// The longest side of an image.
pub(crate) const MAX_SIDE: u64 = 65_536;
/// The most bytes that a decoded image may take, and the largest file read.
pub(crate) const MAX_BYTES: u64 = 4 << 30;
/// No format packs more than this many decoded bytes in one byte of a real image (deflate reaches 1032).
const MAX_EXPANSION: u64 = 4096;
/// Small files may expand freely up to this many bytes.
const FREE_BYTES: u64 = 64 << 20;

/// Checks that an image of `width` × `height` texels of `texel_bytes` each may be decoded from a file of `file_len` bytes.
pub(crate) fn check_size(width: u64, height: u64, texel_bytes: u64, file_len: usize) -> Result<(), TextureError> {
    let too_large = |what| Err(TextureError::new(TextureErrorKind::TooLarge, what));
    if width == 0 || height == 0 {
        return Err(TextureError::malformed(format!("the image is {width} × {height} texels, expected one at least")));
    }
    if width > MAX_SIDE || height > MAX_SIDE {
        return too_large(format!("the image is {width} × {height} texels, the limit is {MAX_SIDE} a side"));
    }
    let bytes = width * height * texel_bytes;
    if bytes > MAX_BYTES {
        return too_large(format!("{width} × {height} texels take {} MiB decoded, the limit is {} MiB", bytes >> 20, MAX_BYTES >> 20));
    }
    if bytes > FREE_BYTES.max(file_len as u64 * MAX_EXPANSION) {
        return Err(TextureError::malformed(format!("the header claims {width} × {height} texels, which {file_len} bytes cannot hold")));
    }
    // The decoder's own, and what is made of it.
    check_room(2 * bytes, width, height)
}

/// The most bytes that a decoder may ask for.
pub(crate) fn most_bytes() -> u64 {
    free_memory().map_or(MAX_BYTES, |free| free.min(MAX_BYTES))
}

/// Checks that there is memory for so many bytes of an image.
pub(crate) fn check_room(bytes: u64, width: u64, height: u64) -> Result<(), TextureError> {
    if bytes <= FREE_BYTES {
        return Ok(());
    }
    room_for(bytes).map_err(|shortage| {
        TextureError::new(TextureErrorKind::TooLarge, format!("the image is {width} × {height} texels: {shortage}"))
            .hint("make it smaller, or read it tile by tile within a texture memory")
    })
}
