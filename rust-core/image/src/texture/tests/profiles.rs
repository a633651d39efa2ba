//! What files say of their colours: PNG's chunks, ICC profiles, code points.

use super::made::{build, bytes, png};
use crate::colour::{ColourSpace, Curve, Encoding, Gamut, Stated, Transfer, apply};
use crate::texture::{DomeFormat, Image, LatLong, TexelFormat, Texels, decode};
use image::{ExtendedColorType, ImageEncoder};

/// Colorants under D50 of Rec.709 and of Display P3, as profiles of HP and Apple have them.
const SRGB: [[f64; 3]; 3] = [[0.436_07, 0.222_49, 0.013_92], [0.385_15, 0.716_87, 0.097_08], [0.143_07, 0.060_61, 0.714_10]];
const DISPLAY_P3: [[f64; 3]; 3] = [[0.515_12, 0.241_20, -0.001_05], [0.291_98, 0.692_25, 0.041_89], [0.157_10, 0.066_57, 0.784_07]];

fn fixed(x: f64) -> [u8; 4] {
    ((x * 65536.0).round() as i32).to_be_bytes()
}

/// The parametric curve of sRGB.
fn srgb_curve() -> Vec<u8> {
    let mut tag = b"para\0\0\0\0\0\x03\0\0".to_vec();
    tag.extend([2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045].into_iter().flat_map(fixed));
    tag
}

/// A curve of values, of an exponent (in 256ths), or none.
fn table_curve(values: &[u16]) -> Vec<u8> {
    let mut tag = b"curv\0\0\0\0".to_vec();
    tag.extend((values.len() as u32).to_be_bytes());
    tag.extend(values.iter().flat_map(|value| value.to_be_bytes()));
    tag
}

/// A display's profile (ICC.1:2022, 7.2 and 7.3): the signature of its colours, and tags.
fn profile(colours: &[u8; 4], tags: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut header = vec![0; 128];
    header[8..12].copy_from_slice(&[4, 0x30, 0, 0]);
    header[12..16].copy_from_slice(b"mntr");
    header[16..20].copy_from_slice(colours);
    header[20..24].copy_from_slice(b"XYZ ");
    header[24..36].copy_from_slice(&[7, 230, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0]);
    header[36..40].copy_from_slice(b"acsp");
    header[68..80].copy_from_slice(&[fixed(0.9642), fixed(1.0), fixed(0.8249)].concat());
    let (mut table, mut data) = ((tags.len() as u32).to_be_bytes().to_vec(), Vec::new());
    let start = 132 + 12 * tags.len();
    for (name, tag) in tags {
        table.extend(**name);
        table.extend(((start + data.len()) as u32).to_be_bytes());
        table.extend((tag.len() as u32).to_be_bytes());
        data.extend(tag);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    let size = (start + data.len()) as u32;
    header[0..4].copy_from_slice(&size.to_be_bytes());
    [header, table, data].concat()
}

fn rgb_profile(colorants: [[f64; 3]; 3], curve: &[u8]) -> Vec<u8> {
    let xyz = |c: [f64; 3]| [b"XYZ \0\0\0\0".to_vec(), c.into_iter().flat_map(fixed).collect()].concat();
    let [r, g, b] = colorants.map(xyz);
    let curve = || curve.to_vec();
    profile(b"RGB ", &[(b"rXYZ", r), (b"gXYZ", g), (b"bXYZ", b), (b"rTRC", curve()), (b"gTRC", curve()), (b"bTRC", curve())])
}

fn with_profile<'a>(mut encoder: impl ImageEncoder + 'a, profile: Vec<u8>, image: &Image) {
    let colour = if image.channels == 1 { ExtendedColorType::L8 } else { ExtendedColorType::Rgb8 };
    let Texels::Byte(values) = &image.texels else { panic!("bytes are wanted") };
    encoder.set_icc_profile(profile).unwrap();
    encoder.write_image(values, image.width, image.height, colour).unwrap();
}

fn flat(rgb: [u8; 3]) -> Image {
    Image { texels: Texels::Byte(rgb.repeat(64)), ..bytes(8, 8, 3, 1) }
}

fn assert_near(found: [f32; 4], expected: [f64; 3], tolerance: f64) {
    for (a, b) in found.iter().zip(expected) {
        assert!((f64::from(*a) - b).abs() < tolerance, "{found:?} is not {expected:?}");
    }
}

/// Inserts a chunk behind the header of a PNG, with its checksum.
fn with_chunk(file: &[u8], name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let named = [&name[..], data].concat();
    let chunk = [&(data.len() as u32).to_be_bytes()[..], &named, &super::damage::crc32(&named).to_be_bytes()].concat();
    [&file[..33], &chunk, &file[33..]].concat()
}

fn sixteen_bits(channels: u32) -> Vec<u8> {
    png(&Image { texels: Texels::Short(vec![0x8080; 64 * channels as usize]), ..bytes(8, 8, channels, 1) })
}

#[test]
fn png_chunks_count_before_depth_and_channels() {
    let srgb = Transfer::Srgb.decode(128.0 / 255.0);
    for channels in [1, 3] {
        let plain = sixteen_bits(channels);
        let cases = [
            (plain.clone(), 128.0 / 255.0),
            (with_chunk(&plain, b"sRGB", &[0]), srgb),
            (with_chunk(&plain, b"gAMA", &45_455_u32.to_be_bytes()), srgb),
            (with_chunk(&plain, b"gAMA", &55_556_u32.to_be_bytes()), (128_f64 / 255.0).powf(1.8)),
            (with_chunk(&plain, b"gAMA", &100_000_u32.to_be_bytes()), 128.0 / 255.0),
            (with_chunk(&with_chunk(&plain, b"gAMA", &100_000_u32.to_be_bytes()), b"sRGB", &[0]), srgb),
            (with_chunk(&with_chunk(&plain, b"sRGB", &[0]), b"cICP", &[1, 8, 0, 1]), 128.0 / 255.0),
        ];
        for (number, (file, expected)) in cases.into_iter().enumerate() {
            let image = decode(&file).unwrap();
            assert_near(build(&image, ColourSpace::Auto).texel(0, 3, 3).unwrap(), [expected; 3], 3e-4);
            // What is said beside the file counts before it.
            let raw = build(&image, ColourSpace::Raw).texel(0, 3, 3).unwrap();
            assert_near(raw, [128.0 / 255.0; 3], 1e-6);
            let stated = build(&image, ColourSpace::SRGB_TEXTURE).texel(0, 3, 3).unwrap();
            assert_near(stated, [srgb; 3], 3e-4);
            let sky = LatLong::from_image(&image, DomeFormat::LatLong, ColourSpace::Auto).unwrap().rgb[9];
            assert!((f64::from(sky[1]) - expected).abs() < 3e-4, "case {number}");
        }
    }
}

#[test]
fn eight_bits_that_are_linear_stay_linear() {
    let file = with_chunk(&png(&flat([10, 128, 200])), b"gAMA", &100_000_u32.to_be_bytes());
    let map = build(&decode(&file).unwrap(), ColourSpace::Auto);
    assert_eq!(map.format(), TexelFormat::Byte);
    assert_near(map.texel(0, 0, 0).unwrap(), [10.0 / 255.0, 128.0 / 255.0, 200.0 / 255.0], 1e-6);
}

#[test]
fn png_primaries_are_converted() {
    let numbers = |xy: [f64; 2]| xy.map(|x| ((x * 1e5_f64).round() as u32).to_be_bytes()).concat();
    let p3 = Gamut::DisplayP3.primaries();
    let chrm = [numbers(p3.white), numbers(p3.red), numbers(p3.green), numbers(p3.blue)].concat();
    let file = with_chunk(&with_chunk(&png(&flat([255, 0, 0])), b"cHRM", &chrm), b"gAMA", &45_455_u32.to_be_bytes());
    let red = apply(&Gamut::DisplayP3.to_rec709().unwrap(), [1.0, 0.0, 0.0]);
    assert_near(build(&decode(&file).unwrap(), ColourSpace::Auto).texel(0, 0, 0).unwrap(), red, 1e-3);
    // Display P3 by code points.
    let file = with_chunk(&png(&flat([255, 0, 0])), b"cICP", &[12, 13, 0, 1]);
    assert_near(build(&decode(&file).unwrap(), ColourSpace::Auto).texel(0, 0, 0).unwrap(), red, 1e-3);
}

#[test]
fn profiles_of_each_format_are_followed() {
    let image = flat([230, 60, 20]);
    let linear = [230.0, 60.0, 20.0].map(|code: f64| Transfer::Srgb.decode(code / 255.0));
    let expected = apply(&Gamut::DisplayP3.to_rec709().unwrap(), linear);
    let p3 = || rgb_profile(DISPLAY_P3, &srgb_curve());
    let (mut png, mut jpeg, mut webp) = (Vec::new(), Vec::new(), Vec::new());
    with_profile(image::codecs::png::PngEncoder::new(&mut png), p3(), &image);
    with_profile(image::codecs::jpeg::JpegEncoder::new_with_quality(&mut jpeg, 100), p3(), &image);
    with_profile(image::codecs::webp::WebPEncoder::new_lossless(&mut webp), p3(), &image);
    for (format, file, tolerance) in
        [("png", png, 2e-3), ("jpeg", jpeg, 2e-2), ("webp", webp, 2e-3), ("tiff", tiff_with(&image, p3()), 2e-3)]
    {
        let map = build(&decode(&file).unwrap(), ColourSpace::Auto);
        assert_eq!(map.format(), TexelFormat::Half, "{format}");
        assert_near(map.texel(0, 4, 4).unwrap(), expected, tolerance);
    }
}

fn tiff_with(image: &Image, profile: Vec<u8>) -> Vec<u8> {
    let Texels::Byte(values) = &image.texels else { panic!("bytes are wanted") };
    let mut file = std::io::Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut file).unwrap();
    let mut written = encoder.new_image::<tiff::encoder::colortype::RGB8>(image.width, image.height).unwrap();
    written.encoder().write_tag(tiff::tags::Tag::IccProfile, &profile[..]).unwrap();
    written.write_data(values).unwrap();
    file.into_inner()
}

#[test]
fn profiles_that_mean_srgb_cost_nothing() {
    let table: Vec<u16> = (0..1024).map(|i| (Transfer::Srgb.decode(f64::from(i) / 1023.0) * 65535.0).round() as u16).collect();
    for curve in [srgb_curve(), table_curve(&table)] {
        let stated = crate::colour::from_profile(&rgb_profile(SRGB, &curve), 3);
        assert_eq!(stated, Stated::srgb());
        let map = build(&Image { stated, ..flat([10, 128, 200]) }, ColourSpace::Auto);
        assert_eq!(map.format(), TexelFormat::Byte);
    }
    // An exponent of 2.2 in 256ths, as in Adobe's profiles.
    let Stated::Encoding(encoding) = crate::colour::from_profile(&rgb_profile(SRGB, &table_curve(&[563])), 3) else { panic!("usable") };
    assert!((encoding.curves[0].decode(0.5) - 0.5_f64.powf(563.0 / 256.0)).abs() < 1e-9);
}

#[test]
fn grey_profiles_are_curves_alone() {
    let grey = profile(b"GRAY", &[(b"kTRC", table_curve(&[256]))]);
    assert_eq!(crate::colour::from_profile(&grey, 1), Stated::Encoding(Encoding::in_rec709(Curve::Named(Transfer::Linear))));
    // A grey image has no gamut, whatever its profile says.
    let Stated::Encoding(encoding) = crate::colour::from_profile(&rgb_profile(DISPLAY_P3, &srgb_curve()), 1) else { panic!("usable") };
    assert_eq!((encoding.transfer(), encoding.to_rec709), (Some(Transfer::Srgb), None));
}

#[test]
fn unusable_profiles_are_told_and_left_out() {
    let inks = profile(b"CMYK", &[]);
    let no_curves = profile(b"RGB ", &[]);
    for (bytes, word) in [(inks, "Cmyk"), (no_curves, "curves"), (vec![0; 40], "damaged"), (Vec::new(), "damaged")] {
        let Stated::Unusable(what) = crate::colour::from_profile(&bytes, 3) else { panic!("{word} is unusable") };
        assert!(what.contains(word), "{what}");
        let image = Image { stated: Stated::Unusable(what), ..flat([128, 128, 128]) };
        let map = build(&image, ColourSpace::Auto);
        assert!(map.note().unwrap().contains(word));
        assert_near(map.texel(0, 0, 0).unwrap(), [Transfer::Srgb.decode(128.0 / 255.0); 3], 1e-6);
        assert!(build(&image, ColourSpace::Raw).note().is_none());
    }
    assert!(matches!(Stated::from_code_points(9, 16), Stated::Unusable(what) if what.contains("PQ")));
    assert_eq!(Stated::from_code_points(2, 2), Stated::Nothing);
    assert_eq!(Stated::from_code_points(1, 13), Stated::srgb());
}
