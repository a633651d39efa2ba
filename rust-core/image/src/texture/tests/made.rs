//! Images made for tests.

use crate::colour::ColourSpace;
use crate::texture::{Image, MipMap, Texels};
use image::{ExtendedColorType, ImageEncoder};
use std::sync::atomic::AtomicBool;

/// SplitMix64 (Steele, Lea and Flood 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub(super) fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }
    pub(super) fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1_u64 << 24) as f32
    }
}

pub(super) fn bytes(width: u32, height: u32, channels: u32, seed: u64) -> Image {
    let mut random = Random(seed);
    let values = (0..width * height * channels).map(|_| random.next() as u8).collect();
    Image { width, height, channels, texels: Texels::Byte(values), primaries: None }
}

pub(super) fn floats(width: u32, height: u32, channels: u32, seed: u64) -> Image {
    let mut random = Random(seed);
    let values = (0..width * height * channels).map(|_| random.unit()).collect();
    Image { width, height, channels, texels: Texels::Float(values), primaries: None }
}

pub(super) fn halves(width: u32, height: u32, channels: u32, seed: u64) -> Image {
    let mut random = Random(seed);
    let values = (0..width * height * channels).map(|_| half::f16::from_f32(random.unit())).collect();
    Image { width, height, channels, texels: Texels::Half(values), primaries: None }
}

pub(super) fn build(image: &Image, space: ColourSpace) -> MipMap {
    MipMap::build(image, space, None, &AtomicBool::new(false)).unwrap()
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
