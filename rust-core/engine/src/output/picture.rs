//! PNG and JPEG.

use super::{DisplaySpace, Look, display, display_deep, display_over_black, write_atomically};
use crate::{
    error::{Error, Result},
    film::Image,
};
use gonio_simd::Execution;
use image::{ExtendedColorType, ImageEncoder, ImageResult, codecs::jpeg::JpegEncoder, codecs::png::PngEncoder};
use std::{
    io::{Cursor, Write},
    path::Path,
};

/// Bytes of a PNG file before its second chunk.
const PNG_HEAD: usize = 8 + 25;

/// Writes the tone-mapped colour pass as PNG (with coverage, by which colours are not multiplied; 16 bits where luminance is absolute) or JPEG (sRGB
/// over black), by the name's ending.
pub fn write_picture(path: &Path, image: &Image, look: &Look, execution: Execution) -> Result<()> {
    let size = image.size().map(|side| side as u32);
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let wrong = |problem: String| Error::setting("path", format!("{}: {problem}", path.display()));
    let encoded = match ending.as_str() {
        "jpg" | "jpeg" if look.space == DisplaySpace::Srgb => jpeg(&display_over_black(image, look, execution), size),
        "jpg" | "jpeg" => return Err(wrong("JPEG files are sRGB, other colour spaces go to PNG".into())),
        "png" if look.space == DisplaySpace::Rec2020Pq => {
            let words = display_deep(image, look, execution);
            png(bytemuck::cast_slice(&words), size, ExtendedColorType::Rgba16)
        }
        "png" => png(&display(image, look, execution), size, ExtendedColorType::Rgba8),
        other => return Err(wrong(format!("the ending is '{other}', expected png or jpg"))),
    };
    let mut bytes = encoded.map_err(|error| Error::io(path, std::io::Error::other(error)))?;
    if let Some([primaries, transfer]) = look.space.code_points() {
        // Red, green and blue as they are, all values in use.
        bytes.splice(PNG_HEAD..PNG_HEAD, png_chunk(*b"cICP", &[primaries, transfer, 0, 1]));
    }
    write_atomically(path, true, |file| file.write_all(&bytes))
}

fn jpeg(rgba: &[u8], [width, height]: [u32; 2]) -> ImageResult<Vec<u8>> {
    let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 92).write_image(&rgb, width, height, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

fn png(rgba: &[u8], [width, height]: [u32; 2], kind: ExtendedColorType) -> ImageResult<Vec<u8>> {
    let mut bytes = Vec::new();
    PngEncoder::new(Cursor::new(&mut bytes)).write_image(rgba, width, height, kind)?;
    Ok(bytes)
}

/// 8-bit RGBA, colours not multiplied by their alpha, as a PNG file's bytes.
pub fn encode_png(rgba: &[u8], width: u32, height: u32) -> std::io::Result<Vec<u8>> {
    png(rgba, [width, height], ExtendedColorType::Rgba8).map_err(std::io::Error::other)
}

/// 8-bit RGBA over black, whose alpha is left out, as a JPEG file's bytes.
pub fn encode_jpeg(rgba: &[u8], width: u32, height: u32) -> std::io::Result<Vec<u8>> {
    jpeg(rgba, [width, height]).map_err(std::io::Error::other)
}

/// A chunk of a PNG file (ISO/IEC 15948, 5.3): length, kind, data, check.
fn png_chunk(kind: [u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [&kind, data].concat();
    [&(data.len() as u32).to_be_bytes(), &*body, &crc(&body).to_be_bytes()].concat()
}

/// The cyclic redundancy check of PNG's annex D, bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_is_that_of_the_standard() {
        // The end of every PNG file.
        assert_eq!(png_chunk(*b"IEND", &[]), [0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xae, 0x42, 0x60, 0x82]);
    }
}
