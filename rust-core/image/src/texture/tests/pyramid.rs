//! Levels of the pyramid: sizes, means, rounding.

use super::made::{build, bytes, floats, halves};
use crate::colour::{ColourSpace, Stated, Transfer};
use crate::texture::encoder::Encoder;
use crate::texture::{Image, MipMap, TexelFormat, Texels};
use std::sync::atomic::AtomicBool;

fn size(map: &MipMap, level: usize) -> [usize; 2] {
    [map.levels.widths[level] as usize, map.levels.heights[level] as usize]
}

fn mean(map: &MipMap, level: usize) -> [f64; 4] {
    let [width, height] = size(map, level);
    let mut sum = [0.0; 4];
    for y in 0..height {
        for x in 0..width {
            let texel = map.texel(level, x, y).unwrap();
            for (s, v) in sum.iter_mut().zip(texel) {
                *s += f64::from(v) / (width * height) as f64;
            }
        }
    }
    sum
}

const SIZES: [[u32; 2]; 8] = [[1, 1], [2, 2], [1, 9], [13, 1], [16, 16], [15, 17], [37, 22], [129, 65]];

#[test]
fn levels_halve_down_to_one_texel() {
    let map = build(&floats(37, 22, 3, 1), ColourSpace::Raw);
    let sizes: Vec<_> = (0..map.level_count()).map(|level| size(&map, level)).collect();
    assert_eq!(sizes, [[37, 22], [18, 11], [9, 5], [4, 2], [2, 1], [1, 1]]);
    assert!(map.texel(0, 37, 0).is_none() && map.texel(6, 0, 0).is_none());
}

#[test]
fn every_level_keeps_the_mean() {
    for [width, height] in SIZES {
        let map = build(&floats(width, height, 4, 7), ColourSpace::Raw);
        assert_eq!(map.format(), TexelFormat::Float);
        for level in 1..map.level_count() {
            for (a, b) in mean(&map, level).into_iter().zip(mean(&map, 0)) {
                assert!((a - b).abs() < 1e-6, "{width} × {height}, level {level}: {a} {b}");
            }
        }
    }
}

#[test]
fn eight_bit_levels_keep_the_mean_in_linear_light() {
    for [width, height] in SIZES {
        let map = build(&bytes(width, height, 3, 8), ColourSpace::SRGB_TEXTURE);
        assert_eq!((map.format(), map.bytes() % 4), (TexelFormat::Byte, 0));
        for level in 1..map.level_count() {
            let [texels_x, texels_y] = size(&map, level);
            // Rounding errors are uniform over a code (at most 1/112 in linear light): five deviations of their mean.
            let tolerance = 5.0 / 112.0 / (12.0 * (texels_x * texels_y) as f64).sqrt();
            for (a, b) in mean(&map, level).into_iter().zip(mean(&map, 0)) {
                assert!((a - b).abs() < tolerance, "{width} × {height}, level {level}: {a} {b}");
            }
        }
    }
}

#[test]
fn black_and_white_mix_to_half_the_light() {
    let image = Image { width: 2, height: 1, channels: 3, texels: Texels::Byte(vec![0, 0, 0, 255, 255, 255]), stated: Stated::Nothing };
    let half = build(&image, ColourSpace::SRGB_TEXTURE).texel(1, 0, 0).unwrap()[0];
    // 188 is sRGB's code nearest to one half.
    assert_eq!(half, Transfer::Srgb.table()[188]);
}

#[test]
fn encoder_returns_codes_and_rounds() {
    for transfer in [Transfer::Linear, Transfer::Srgb, Transfer::Gamma22, Transfer::Gamma18] {
        let encoder = Encoder::new(transfer);
        for (code, linear) in transfer.table().into_iter().enumerate() {
            assert_eq!(usize::from(encoder.encode(linear)), code, "{transfer:?}");
        }
        for step in 0..=100_000 {
            let linear = step as f32 / 100_000.0;
            let exact = transfer.encode(f64::from(linear)) * 255.0;
            assert!((f64::from(encoder.encode(linear)) - exact).abs() < 0.5 + 1e-4, "{transfer:?} {linear}");
        }
        assert_eq!([f32::NAN, -1.0, 2.0, f32::INFINITY].map(|x| encoder.encode(x)), [0, 0, 255, 255]);
    }
}

#[test]
fn formats_fit_the_contents() {
    let format = |image: &Image, space| build(image, space).format();
    assert_eq!(format(&bytes(4, 4, 1, 1), ColourSpace::Raw), TexelFormat::Byte);
    assert_eq!(format(&bytes(4, 4, 3, 1), ColourSpace::G22), TexelFormat::Byte);
    assert_eq!(format(&bytes(4, 4, 3, 1), ColourSpace::DISPLAY_P3), TexelFormat::Half);
    assert_eq!(format(&halves(4, 4, 3, 1), ColourSpace::Raw), TexelFormat::Half);
    assert_eq!(format(&halves(4, 4, 1, 1), ColourSpace::Raw), TexelFormat::Grey);
    assert_eq!(format(&floats(4, 4, 3, 1), ColourSpace::Raw), TexelFormat::Float);
    assert_eq!(format(&floats(4, 4, 3, 1), ColourSpace::LINEAR_REC709), TexelFormat::Half);
    let bright = Image { texels: Texels::Float(vec![1e6; 48]), ..floats(4, 4, 3, 1) };
    assert_eq!(format(&bright, ColourSpace::LINEAR_REC709), TexelFormat::Float);
}

#[test]
fn what_is_not_finite_does_not_spread() {
    let mut image = floats(8, 8, 3, 3);
    if let Texels::Float(values) = &mut image.texels {
        (values[0], values[10], values[20]) = (f32::NAN, f32::INFINITY, f32::NEG_INFINITY);
    }
    for space in [ColourSpace::Raw, ColourSpace::ACES_CG, ColourSpace::SRGB_TEXTURE] {
        let map = build(&image, space);
        assert!((0..map.level_count()).all(|level| mean(&map, level).iter().all(|x| x.is_finite())), "{space:?}");
    }
}

#[test]
fn inconsistent_images_are_refused() {
    let never = AtomicBool::new(false);
    for image in [
        Image { width: 5, ..floats(4, 4, 3, 1) },
        Image { channels: 5, ..floats(4, 4, 3, 1) },
        Image { channels: 0, ..floats(4, 4, 3, 1) },
        Image { width: 0, texels: Texels::Byte(Vec::new()), ..floats(4, 4, 3, 1) },
    ] {
        assert!(MipMap::build(&image, ColourSpace::Raw, &never).is_err());
    }
}
