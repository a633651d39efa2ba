//! Images made for tests.

use crate::colour::{ColourSpace, Stated};
use crate::texture::{Image, MipMap, Texels};
use image::{ExtendedColorType, ImageEncoder};
use std::sync::atomic::AtomicBool;

/// SplitMix64 (Steele, Lea and Flood 2014).
pub(in crate::texture) struct Random(pub(in crate::texture) u64);

impl Random {
    pub(in crate::texture) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub(in crate::texture) fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }
    pub(in crate::texture) fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1_u64 << 24) as f32
    }
}

pub(super) fn bytes(width: u32, height: u32, channels: u32, seed: u64) -> Image {
    let mut random = Random(seed);
    let values = (0..width * height * channels).map(|_| random.next() as u8).collect();
    Image { width, height, channels, texels: Texels::Byte(values), stated: Stated::Nothing }
}

pub(super) fn floats(width: u32, height: u32, channels: u32, seed: u64) -> Image {
    let mut random = Random(seed);
    let values = (0..width * height * channels).map(|_| random.unit()).collect();
    Image { width, height, channels, texels: Texels::Float(values), stated: Stated::Nothing }
}

pub(super) fn halves(width: u32, height: u32, channels: u32, seed: u64) -> Image {
    let mut random = Random(seed);
    let values = (0..width * height * channels).map(|_| half::f16::from_f32(random.unit())).collect();
    Image { width, height, channels, texels: Texels::Half(values), stated: Stated::Nothing }
}

pub(super) fn build(image: &Image, space: ColourSpace) -> MipMap {
    MipMap::build(image, space, &AtomicBool::new(false)).unwrap()
}

pub(super) fn png(image: &Image) -> Vec<u8> {
    let mut file = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut file);
    let (values, colour) = match &image.texels {
        Texels::Byte(values) => (
            values.clone(),
            [ExtendedColorType::L8, ExtendedColorType::La8, ExtendedColorType::Rgb8, ExtendedColorType::Rgba8][image.channels as usize - 1],
        ),
        Texels::Short(values) => {
            let colours = [ExtendedColorType::L16, ExtendedColorType::La16, ExtendedColorType::Rgb16, ExtendedColorType::Rgba16];
            (values.iter().flat_map(|value| value.to_ne_bytes()).collect(), colours[image.channels as usize - 1])
        }
        _ => panic!("PNG holds integers"),
    };
    encoder.write_image(&values, image.width, image.height, colour).unwrap();
    file
}

pub(super) fn jpeg(image: &Image) -> Vec<u8> {
    let Texels::Byte(values) = &image.texels else { panic!("JPEG holds bytes") };
    let mut file = Vec::new();
    let colour = if image.channels == 1 { ExtendedColorType::L8 } else { ExtendedColorType::Rgb8 };
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, 100).write_image(values, image.width, image.height, colour).unwrap();
    file
}

pub(super) fn hdr(width: usize, height: usize, texels: &[[f32; 3]]) -> Vec<u8> {
    let texels: Vec<_> = texels.iter().map(|texel| image::Rgb(*texel)).collect();
    let mut file = Vec::new();
    image::codecs::hdr::HdrEncoder::new(&mut file).encode(&texels, width, height).unwrap();
    file
}

/// 24 × 20 texels of RGB in a format of the crate `image`.
pub(super) fn coded(format: image::ImageFormat) -> Vec<u8> {
    let Texels::Byte(values) = bytes(24, 20, 3, 4).texels else { panic!("bytes are wanted") };
    let image = image::RgbImage::from_raw(24, 20, values).unwrap();
    let mut file = std::io::Cursor::new(Vec::new());
    image.write_to(&mut file, format).unwrap();
    file.into_inner()
}

/// RGB in strips, compressed with LZW.
pub(super) fn tiff_of(image: &Image) -> Vec<u8> {
    let Texels::Byte(values) = &image.texels else { panic!("bytes are wanted") };
    let mut file = std::io::Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut file).unwrap().with_compression(tiff::encoder::Compression::Lzw);
    encoder.write_image::<tiff::encoder::colortype::RGB8>(image.width, image.height, values).unwrap();
    file.into_inner()
}
