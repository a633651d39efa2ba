//! PNG and JPEG.

use super::{ToneMap, display, write_atomically};
use crate::{
    error::{Error, Result},
    film::Image,
};
use gonio_simd::Execution;
use image::{ImageEncoder, codecs::jpeg::JpegEncoder, codecs::png::PngEncoder};
use std::{
    io::{Cursor, Write},
    path::Path,
};

/// Writes the tone-mapped colour pass as PNG (with alpha) or JPEG (over black), by the name's ending.
pub fn write_picture(path: &Path, image: &Image, tone_map: ToneMap, stops: f32, execution: Execution) -> Result<()> {
    let rgba = display(image, tone_map, stops, execution);
    let [width, height] = image.size().map(|side| side as u32);
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let encoded = match ending.as_str() {
        "jpg" | "jpeg" => encode_jpeg(&rgba, width, height),
        "png" => {
            let opaque: Vec<u8> = rgba.chunks_exact(4).flat_map(unpremultiplied).collect();
            encode_png(&opaque, width, height)
        }
        other => {
            let problem = format!("{}: the ending is '{other}', expected png or jpg", path.display());
            return Err(Error::Setting { name: "path".into(), problem });
        }
    };
    let bytes = encoded.map_err(|error| Error::io(path, error))?;
    write_atomically(path, true, |file| file.write_all(&bytes))
}

/// A pixel whose colour does not need its alpha: light without coverage (a visible sky) counts as covered.
fn unpremultiplied(pixel: &[u8]) -> [u8; 4] {
    let most = pixel[0].max(pixel[1]).max(pixel[2]);
    [pixel[0], pixel[1], pixel[2], pixel[3].max(most)]
}

/// 8-bit RGBA as a PNG file's bytes.
pub fn encode_png(rgba: &[u8], width: u32, height: u32) -> std::io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let written = PngEncoder::new(&mut bytes).write_image(rgba, width, height, image::ExtendedColorType::Rgba8);
    written.map_err(std::io::Error::other)?;
    Ok(bytes.into_inner())
}

/// 8-bit RGBA, colours times their alpha, over black as a JPEG file's bytes.
pub fn encode_jpeg(rgba: &[u8], width: u32, height: u32) -> std::io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let rgb: Vec<u8> = rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let written = JpegEncoder::new_with_quality(&mut bytes, 92).write_image(&rgb, width, height, image::ExtendedColorType::Rgb8);
    written.map_err(std::io::Error::other)?;
    Ok(bytes.into_inner())
}
