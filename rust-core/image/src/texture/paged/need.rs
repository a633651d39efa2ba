//! How much memory reading a picture takes, by its header, so that many are read at once only where there is room.

use crate::texture::load::Source;
use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Seek};

/// Bytes a texel at the worst: decoded twice (file and interleaved), stored with all levels, and one level of floats at work.
const BYTES_A_TEXEL: u64 = 64;
/// The same for pictures of 8 bits a channel.
const BYTES_A_BYTE_TEXEL: u64 = 16;

/// Bytes that reading and filtering a picture takes; `None` where its header cannot tell.
pub(super) fn need(source: &Source) -> Option<u64> {
    match source {
        Source::Path(path) => {
            let file = File::open(path).ok()?;
            let len = file.metadata().ok()?.len();
            Some(len + of_header(BufReader::new(file))?)
        }
        Source::Bytes { bytes, .. } => of_header(Cursor::new(&bytes[..])),
        Source::Pixels { width, height, .. } => Some(u64::from(*width) * u64::from(*height) * BYTES_A_TEXEL),
    }
}

fn of_header(reader: impl BufRead + Seek) -> Option<u64> {
    use image::ImageFormat::{Bmp, Gif, Jpeg, Png, Tga, WebP};
    let reader = image::ImageReader::new(reader).with_guessed_format().ok()?;
    // PNG may have 16 bits; that is told by a quarter more at the most.
    let bytes = match reader.format()? {
        Bmp | Gif | Jpeg | Tga | WebP => BYTES_A_BYTE_TEXEL,
        Png => 2 * BYTES_A_BYTE_TEXEL,
        _ => BYTES_A_TEXEL,
    };
    let (width, height) = reader.into_dimensions().ok()?;
    Some(u64::from(width) * u64::from(height) * bytes)
}
