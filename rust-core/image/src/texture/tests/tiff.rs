//! TIFF in its many layouts, and `.tx`.

use super::made::Random;
use crate::colour::ColourSpace;
use crate::texture::{Image, Texels, decode};
use half::f16;
use std::io::Cursor;
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, colortype};

/// A file of one directory with the tags of `entries`, little endian, `blocks` of data first.
pub(super) fn tiff(entries: &[(u16, Vec<u32>)], blocks: &[Vec<u8>], places: u16, sizes: u16) -> Vec<u8> {
    let mut file = b"II*\0\0\0\0\0".to_vec();
    let mut entries = entries.to_vec();
    let starts: Vec<u32> = blocks
        .iter()
        .map(|block| {
            let start = file.len() as u32;
            file.extend(block);
            start
        })
        .collect();
    entries.push((places, starts));
    entries.push((sizes, blocks.iter().map(|block| block.len() as u32).collect()));
    entries.sort();
    let mut directory = (entries.len() as u16).to_le_bytes().to_vec();
    for (tag, values) in &entries {
        directory.extend(tag.to_le_bytes());
        // SHORT for the kind of further samples, LONG for all else.
        directory.extend(if *tag == 338 { 3_u16 } else { 4 }.to_le_bytes());
        directory.extend((values.len() as u32).to_le_bytes());
        if let [value] = values[..] {
            directory.extend(value.to_le_bytes());
        } else {
            directory.extend((file.len() as u32).to_le_bytes());
            file.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        }
    }
    directory.extend([0; 4]);
    let at = (file.len() as u32).to_le_bytes();
    file[4..8].copy_from_slice(&at);
    file.extend(directory);
    file
}

/// Tags of an image: width, height, bits a sample, photometric interpretation, samples, planar configuration, sample format.
fn tags(size: [u32; 2], bits: u32, photometric: u32, samples: u32, planes: u32, format: u32) -> Vec<(u16, Vec<u32>)> {
    let each = |value: u32| vec![value; samples as usize];
    vec![
        (256, vec![size[0]]),
        (257, vec![size[1]]),
        (258, each(bits)),
        (259, vec![1]),
        (262, vec![photometric]),
        (277, vec![samples]),
        (284, vec![planes]),
        (339, each(format)),
    ]
}

fn value(x: u32, y: u32, channel: u32) -> u8 {
    (x * 11 + y * 17 + channel * 60) as u8
}

#[test]
fn tiles_of_half_floats_as_in_tx_files() {
    // 20 × 18 texels in tiles of 16 × 16: the last ones hang over.
    let number = |x: u32, y: u32, channel: u32| f16::from_f32(f32::from(value(x, y, channel)) / 16.0 - 2.0);
    let tile = |tx: u32, ty: u32| -> Vec<u8> {
        let texels = (0..16).flat_map(|y| (0..16).map(move |x| (tx * 16 + x, ty * 16 + y)));
        texels.flat_map(|(x, y)| (0..3).flat_map(move |channel| number(x, y, channel).to_le_bytes())).collect()
    };
    let mut entries = tags([20, 18], 16, 2, 3, 1, 3);
    entries.extend([(322, vec![16]), (323, vec![16])]);
    let image = decode(&tiff(&entries, &[tile(0, 0), tile(1, 0), tile(0, 1), tile(1, 1)], 324, 325)).unwrap();
    assert_eq!((image.width, image.height, image.channels), (20, 18, 3));
    assert!(matches!(image.texels, Texels::Half(_)));
    for (x, y) in [(0, 0), (19, 0), (0, 17), (19, 17), (15, 16)] {
        let expected = [0, 1, 2].map(|channel| number(x, y, channel).to_f32());
        assert_eq!(image.rgba((y * 20 + x) as usize)[..3], expected, "{x} {y}");
    }
}

#[test]
fn planes_apart_come_together() {
    let plane = |channel: u32| (0..4 * 3).map(|i| value(i % 4, i / 4, channel)).collect::<Vec<u8>>();
    let image = decode(&tiff(&tags([4, 3], 8, 2, 3, 2, 1), &[plane(0), plane(1), plane(2)], 273, 279)).unwrap();
    let expected = (0..12).flat_map(|i| (0..3).map(move |channel| value(i % 4, i / 4, channel))).collect();
    assert_eq!((image.channels, image.texels), (3, Texels::Byte(expected)));
}

#[test]
fn samples_behind_the_colours() {
    // Grey and alpha, grey and something else, RGB and a depth.
    let grey = |extra: u32| {
        let mut entries = tags([2, 1], 8, 1, 2, 1, 1);
        entries.push((338, vec![extra]));
        decode(&tiff(&entries, &[vec![10, 20, 30, 40]], 273, 279)).unwrap()
    };
    assert_eq!((grey(2).channels, grey(2).texels), (2, Texels::Byte(vec![10, 20, 30, 40])));
    assert_eq!((grey(0).channels, grey(0).texels), (1, Texels::Byte(vec![10, 30])));
    let mut entries = tags([2, 1], 8, 2, 4, 1, 1);
    entries.push((338, vec![0]));
    let image = decode(&tiff(&entries, &[vec![1, 2, 3, 9, 4, 5, 6, 9]], 273, 279)).unwrap();
    assert_eq!((image.channels, image.texels), (3, Texels::Byte(vec![1, 2, 3, 4, 5, 6])));
}

#[test]
fn few_bits_inks_and_doubles() {
    // Nine texels of one bit a row, black is zero: the row is two bytes.
    let bits = decode(&tiff(&tags([9, 2], 1, 1, 1, 1, 1), &[vec![0b1010_0001, 0x80, 0, 0]], 273, 279)).unwrap();
    assert_eq!(bits.texels, Texels::Byte(vec![255, 0, 255, 0, 0, 0, 0, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0]));
    let inks = decode(&tiff(&tags([1, 1], 8, 5, 4, 1, 1), &[vec![255, 0, 51, 51]], 273, 279)).unwrap();
    assert_eq!((inks.channels, inks.texels), (3, Texels::Byte(vec![0, 204, 163])));
    let doubles: Vec<u8> = [0.25_f64, 7.5].iter().flat_map(|x| x.to_le_bytes()).collect();
    let image = decode(&tiff(&tags([2, 1], 64, 1, 1, 1, 3), &[doubles], 273, 279)).unwrap();
    assert_eq!(image.texels, Texels::Float(vec![0.25, 7.5]));
}

#[test]
fn each_compression() {
    let mut random = Random(9);
    let values: Vec<u16> = (0..40 * 30 * 3).map(|i| (i as u16).wrapping_mul(7) ^ (random.next() as u16 & 3)).collect();
    for compression in [Compression::Uncompressed, Compression::Lzw, Compression::Deflate(DeflateLevel::Balanced), Compression::Packbits] {
        let mut file = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut file).unwrap().with_compression(compression);
        encoder.write_image::<colortype::RGB16>(40, 30, &values).unwrap();
        let image = decode(file.get_ref()).unwrap();
        assert_eq!(
            image,
            Image { width: 40, height: 30, channels: 3, texels: Texels::Short(values.clone()), ..super::made::bytes(1, 1, 1, 0) }
        );
        // 16 bits without a profile are not sRGB.
        let texel = super::made::build(&image, ColourSpace::Auto).texel(0, 0, 0).unwrap();
        assert!((texel[0] - f32::from(values[0]) / 65535.0).abs() < 1e-6);
    }
}

#[test]
fn what_is_not_supported_is_named() {
    let palette = decode(&tiff(&tags([1, 1], 8, 3, 1, 1, 1), &[vec![0]], 273, 279)).unwrap_err();
    assert!(palette.what.contains("Palette"), "{palette}");
    let signed = decode(&tiff(&tags([1, 1], 16, 1, 1, 1, 2), &[vec![0, 0]], 273, 279)).unwrap_err();
    assert!(signed.what.contains("signed"), "{signed}");
}
