//! What is written is read: each format, depth and channel count.

use super::made::{Random, bytes, coded, hdr, jpeg, png};
use crate::colour::{ColourSpace, Gamut, Primaries, Stated};
use crate::texture::{DomeFormat, Image, LatLong, RadianceHeader, TexelFormat, Texels, TextureErrorKind, decode};
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Layer, write::WritableImage};
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, IntegerBounds};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use half::f16;
use image::ImageFormat;
use std::io::Cursor;

#[test]
fn png_of_each_kind() {
    for channels in 1..=4 {
        let image = bytes(7, 5, channels, 1);
        assert_eq!(decode(&png(&image)).unwrap(), image);
        let mut random = Random(2);
        let values = (0..7 * 5 * channels).map(|_| random.next() as u16).collect();
        let image = Image { texels: Texels::Short(values), ..image };
        assert_eq!(decode(&png(&image)).unwrap(), image);
    }
}

#[test]
fn png_with_a_palette_of_two_bits() {
    // 4 × 1 texels, palette red, green, blue, white, half of it transparent; made with Pillow.
    let image = decode(&PALETTE_PNG).unwrap();
    assert_eq!((image.width, image.height, image.channels), (4, 1, 3));
    assert_eq!(image.texels, Texels::Byte(vec![255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255]));
}

#[test]
fn jpeg_grey_and_colour() {
    for channels in [1, 3] {
        let values =
            (0..32 * 16).flat_map(|i| [(i % 32) * 8, (i / 32) * 16, 128].into_iter().take(channels as usize)).map(|v| v as u8).collect();
        let image = Image { width: 32, height: 16, channels, texels: Texels::Byte(values), stated: Stated::Nothing };
        let found = decode(&jpeg(&image)).unwrap();
        assert_eq!((found.width, found.height, found.channels), (32, 16, channels));
        for i in 0..image.texels.len() {
            assert!((found.texels.value(i) - image.texels.value(i)).abs() < 12.0 / 255.0, "value {i}");
        }
    }
}

#[test]
fn jpeg_in_cmyk() {
    // 8 × 8 texels of cyan 20 %, magenta 60 %, yellow 80 %, key 10 %, inverted as Adobe writes them.
    let image = decode(&CMYK_JPEG).unwrap();
    assert_eq!((image.width, image.height, image.channels), (8, 8, 3));
    for (channel, ink) in [0.2, 0.6, 0.8].into_iter().enumerate() {
        let expected = (1.0 - ink) * 0.9;
        assert!((image.texels.value(channel) - expected).abs() < 3.0 / 255.0, "{channel}: {}", image.texels.value(channel));
    }
}

#[test]
fn webp_tga_bmp_and_gif() {
    let Texels::Byte(values) = bytes(24, 20, 3, 4).texels else { unreachable!() };
    for format in [ImageFormat::WebP, ImageFormat::Tga, ImageFormat::Bmp] {
        let image = decode(&coded(format)).unwrap();
        assert_eq!((image.width, image.height, image.channels), (24, 20, 3), "{format:?}");
        assert_eq!(image.texels, Texels::Byte(values.clone()), "{format:?}");
    }
    // A palette of 256 colours is enough for four.
    let colours = [[255, 0, 0], [0, 128, 0], [10, 20, 200], [255, 255, 255]];
    let picture = image::RgbImage::from_fn(24, 20, |x, y| image::Rgb(colours[((x / 5 + y / 7) % 4) as usize]));
    let mut file = Cursor::new(Vec::new());
    picture.write_to(&mut file, ImageFormat::Gif).unwrap();
    let gif = decode(file.get_ref()).unwrap();
    assert_eq!((gif.width, gif.height, gif.channels), (24, 20, 4));
    let expected = picture.pixels().flat_map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2], 255]).collect();
    assert_eq!(gif.texels, Texels::Byte(expected));
}

/// A picture of the hosts' tests; another encoder has written them.
macro_rules! avif {
    ($name:literal) => {
        decode(include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/usd/images/", $name))).unwrap()
    };
}

#[test]
fn avif_of_each_kind() {
    let near = |image: &Image, x: usize, expected: [f32; 4]| {
        let found = image.rgba(8 * image.width as usize + x);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.012), "{found:?}, expected {expected:?}");
    };
    // Half the chroma both ways, by the matrix of Rec.601.
    let (image, lossless) = (avif!("picture.avif"), avif!("picture.png"));
    let differences =
        (0..image.len()).flat_map(|k| (0..3).map(move |c| (k, c))).map(|(k, c)| (image.rgba(k)[c] - lossless.rgba(k)[c]).abs());
    let mean = differences.sum::<f32>() / (3 * image.len()) as f32;
    assert!(mean < 0.02 && image.len() == lossless.len(), "{mean}");
    let image = avif!("half_clear.avif");
    assert_eq!((image.width, image.height, image.channels, image.is_byte()), (32, 32, 4, true));
    near(&image, 4, [200.0 / 255.0, 40.0 / 255.0, 20.0 / 255.0, 0.25]);
    near(&image, 28, [20.0 / 255.0, 60.0 / 255.0, 220.0 / 255.0, 1.0]);
    let image = avif!("ten_bits.avif");
    assert_eq!((image.channels, image.is_byte(), &image.stated), (3, false, &Stated::srgb()));
    near(&image, 4, [0.6, 0.2, 0.1, 1.0]);
    near(&image, 28, [0.1, 0.8, 0.3, 1.0]);
}

#[test]
fn avif_that_claims_another_size_is_refused() {
    let mut file = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/usd/images/picture.avif")).to_vec();
    let at = file.windows(4).position(|name| name == b"ispe").unwrap() + 8;
    for (width, kind) in [(32_u32, TextureErrorKind::Malformed), (100_000, TextureErrorKind::TooLarge)] {
        file[at..at + 4].copy_from_slice(&width.to_be_bytes());
        assert_eq!(decode(&file).unwrap_err().kind, kind, "{width}");
    }
}

#[test]
fn dds_with_block_compression() {
    // 8 × 4 texels in two blocks of BC1 between red and blue: all red, all blue.
    let words = |values: &[u32]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
    let header = |four: &[u8; 4]| {
        let sizes = words(&[124, 0x1007, 4, 8, 0, 0, 0]);
        [b"DDS ".to_vec(), sizes, vec![0; 44], words(&[32, 4]), four.to_vec(), vec![0; 20], words(&[0x1000, 0, 0, 0, 0])].concat()
    };
    let block = |indices: u8| [[0x00, 0xf8, 0x1f, 0x00].as_slice(), &[indices; 4]].concat();
    let image = decode(&[header(b"DXT1"), block(0), block(0b0101_0101)].concat()).unwrap();
    assert_eq!((image.width, image.height, image.channels), (8, 4, 3));
    assert_eq!((image.rgba(0), image.rgba(31)), ([1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]));
    assert_eq!(decode(&header(b"ATI2")).unwrap_err().kind, TextureErrorKind::Unsupported);
}

#[test]
fn tga_with_origin_palette_and_runs() {
    // 2 × 2 texels from the bottom left, a palette of blue and red (BGR), one run of three and a single one; no footer.
    let header = [0, 1, 9, 0, 0, 2, 0, 24, 0, 0, 0, 0, 2, 0, 2, 0, 8, 0];
    let file = [&header[..], &[255, 0, 0, 0, 0, 255], &[0x82, 1, 0x00, 0]].concat();
    let image = decode(&file).unwrap();
    let (red, blue) = ([255, 0, 0], [0, 0, 255]);
    assert_eq!((image.channels, image.texels), (3, Texels::Byte([red, blue, red, red].concat())));
    // A text file is none.
    assert!(decode(b"two numbers, and then some more of them").unwrap_err().what.contains("no known"));
}

fn hdr_texels() -> Vec<[f32; 3]> {
    let mut random = Random(3);
    (0..16 * 9).map(|i| [random.unit(), random.unit() * 4.0, random.unit()].map(|x| x * 2_f32.powi(i % 20 - 10))).collect()
}

#[test]
fn radiance_hdr_with_either_signature() {
    let texels = hdr_texels();
    let mut file = hdr(16, 9, &texels);
    for signature in ["#?RADIANCE\n", "#?RGBE\n"] {
        let header = file.iter().position(|byte| *byte == b'\n').unwrap() + 1;
        file.splice(..header, signature.bytes());
        let image = decode(&file).unwrap();
        assert_eq!((image.width, image.height, image.channels), (16, 9, 3));
        for (i, texel) in texels.iter().enumerate() {
            let largest = texel.iter().fold(0.0_f32, |a, b| a.max(*b));
            for (channel, value) in texel.iter().enumerate() {
                assert!((image.rgba(i)[channel] - value).abs() <= largest / 128.0);
            }
        }
    }
}

#[test]
fn radiance_xyze_and_primaries() {
    let file = hdr(16, 9, &vec![[1.0; 3]; 16 * 9]);
    let at = file.windows(4).position(|word| word == b"rgbe").unwrap();
    let mut xyze = file.clone();
    xyze[at..at + 4].copy_from_slice(b"xyze");
    assert_eq!(decode(&xyze).unwrap().stated, Stated::linear(&Gamut::XyzE.primaries()));
    let line = file.iter().position(|byte| *byte == b'\n').unwrap() + 1;
    let mut stated = file.clone();
    stated.splice(line..line, b"PRIMARIES= 0.7 0.3 0.2 0.7 0.1 0.1 0.3333 0.3333\n".iter().copied());
    let primaries = Primaries { red: [0.7, 0.3], green: [0.2, 0.7], blue: [0.1, 0.1], white: [0.3333, 0.3333] };
    assert_eq!(decode(&stated).unwrap().stated, Stated::linear(&primaries));
    assert_eq!(decode(&file).unwrap().stated, Stated::Nothing);
}

/// A picture of 3 × 2 texels, each of another value, with lines in its header, in an order of scan lines.
fn radiance(lines: &str, resolution: &str, order: [usize; 6]) -> Vec<u8> {
    let mut file = format!("#?RADIANCE\nSOFTWARE=test\n{lines}FORMAT=32-bit_rle_rgbe\n\n{resolution}\n").into_bytes();
    // 2^(129 − 128) · (16 i + 16) / 256: 0.125, 0.25, …
    order.iter().for_each(|i| file.extend([16 * *i as u8 + 16, 8, 4, 129]));
    file
}

#[test]
fn radiance_pictures_are_as_before_their_exposure() {
    let reds = |lines: &str| {
        let image = decode(&radiance(lines, "-Y 2 +X 3", [0, 1, 2, 3, 4, 5])).unwrap();
        (image.rgba(1)[0], image.rgba(1)[1])
    };
    let plain = reds("");
    assert_eq!(plain, (0.25, 0.0625));
    assert_eq!(reds("EXPOSURE=2\n"), (0.125, 0.03125));
    // Lines count together; those of pictures that this one was made of are indented.
    assert_eq!(reds("EXPOSURE=   4.0e0\nEXPOSURE=0.5\n\tEXPOSURE=100\n EXPOSURE=100\n"), (0.125, 0.03125));
    assert_eq!(reds("COLORCORR= 0.5 2 1\nEXPOSURE=1\n"), (0.5, 0.03125));
    for (lines, words) in [
        ("EXPOSURE=0\n", "line 3: 'EXPOSURE=0'"),
        ("EXPOSURE=bright\n", "line 3: "),
        ("COLORCORR=1 2\n", "line 3: "),
        ("PRIMARIES=1 2 3\n", "line 3: "),
        ("EXPOSURE=1,5\n", "line 3: 'EXPOSURE=1,5'"),
    ] {
        let error = decode(&radiance(lines, "-Y 2 +X 3", [0; 6])).unwrap_err();
        assert!(error.what.starts_with(words), "{lines}: {error}");
    }
}

#[test]
fn radiance_scan_lines_go_any_way() {
    let upright = [0, 1, 2, 3, 4, 5];
    let expected = decode(&radiance("", "-Y 2 +X 3", upright)).unwrap();
    for (resolution, order) in [
        ("+Y 2 +X 3", [3, 4, 5, 0, 1, 2]),
        ("-Y 2 -X 3", [2, 1, 0, 5, 4, 3]),
        ("+Y 2 -X 3", [5, 4, 3, 2, 1, 0]),
        ("+X 3 -Y 2", [0, 3, 1, 4, 2, 5]),
        ("-X 3 +Y 2", [5, 2, 4, 1, 3, 0]),
    ] {
        assert_eq!(decode(&radiance("", resolution, order)).unwrap(), expected, "{resolution}");
    }
    for broken in ["-Y 2", "-Y 2 +Y 3", "-Y 0 +X 3", "-Y x +X 3", ""] {
        assert!(decode(&radiance("", broken, upright)).is_err(), "{broken}");
    }
}

#[test]
fn radiance_luminances_by_primaries() {
    let weights = |lines: &str, from: &str, to: &str| {
        let file = String::from_utf8_lossy(&radiance(lines, "-Y 2 +X 3", [0; 6])).replace(from, to).into_bytes();
        RadianceHeader::read(&file).unwrap().luminance_weights()
    };
    // Ward's figures for the usual primaries.
    for (found, expected) in weights("", "", "").iter().zip([0.265, 0.670, 0.065]) {
        assert!((found / 179.0 - expected).abs() < 1e-3, "{found}");
    }
    let rec709 = weights("PRIMARIES= 0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n", "", "");
    for (found, expected) in rec709.iter().zip([0.2126, 0.7152, 0.0722]) {
        assert!((found / 179.0 - expected).abs() < 1e-3, "{found}");
    }
    assert_eq!(weights("", "rle_rgbe", "rle_xyze"), [0.0, 1.0, 0.0]);
}

pub(super) struct Exr {
    pub(super) size: Vec2<usize>,
    pub(super) channels: Vec<(&'static str, FlatSamples)>,
    pub(super) attributes: ImageAttributes,
    pub(super) position: Vec2<i32>,
    pub(super) encoding: Encoding,
}

impl Exr {
    pub(super) fn new(width: usize, height: usize, channels: Vec<(&'static str, FlatSamples)>) -> Self {
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(Vec2(width, height)));
        Self { size: Vec2(width, height), channels, attributes, position: Vec2(0, 0), encoding: Encoding::FAST_LOSSLESS }
    }

    pub(super) fn write(self) -> Vec<u8> {
        let channels = self.channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect();
        let attributes = LayerAttributes { layer_position: self.position, ..LayerAttributes::default() };
        let layer = Layer::new(self.size, attributes, self.encoding, AnyChannels::sort(channels));
        let mut image = exr::image::Image::from_layer(layer);
        image.attributes = self.attributes;
        let mut file = Cursor::new(Vec::new());
        image.write().non_parallel().to_buffered(&mut file).unwrap();
        file.into_inner()
    }
}

pub(super) fn ramp(count: usize, offset: f32) -> FlatSamples {
    FlatSamples::F32((0..count).map(|i| offset + i as f32 / 64.0).collect())
}

fn half_ramp(count: usize, offset: f32) -> FlatSamples {
    FlatSamples::F16((0..count).map(|i| f16::from_f32(offset + i as f32 / 64.0)).collect())
}

#[test]
fn exr_channels_by_name() {
    let value = |offset: f32, i: usize| offset + i as f32 / 64.0;
    type Named = Vec<(&'static str, f32)>;
    let cases: [(Named, Vec<f32>); 7] = [
        (vec![("R", 0.0), ("G", 1.0), ("B", 2.0)], vec![0.0, 1.0, 2.0]),
        (vec![("R", 0.0), ("G", 1.0), ("B", 2.0), ("A", 3.0), ("Z", 9.0)], vec![0.0, 1.0, 2.0, 3.0]),
        (vec![("Y", 5.0)], vec![5.0]),
        (vec![("Y", 5.0), ("A", 1.0)], vec![5.0, 1.0]),
        (vec![("beauty.R", 0.0), ("beauty.G", 1.0), ("beauty.B", 2.0), ("depth.Z", 7.0)], vec![0.0, 1.0, 2.0]),
        (vec![("N.X", 0.0), ("N.Y", 1.0), ("N.Z", 2.0)], vec![0.0, 1.0, 2.0]),
        (vec![("height", 4.0)], vec![4.0]),
    ];
    for (channels, expected) in cases {
        for half in [false, true] {
            let samples = |offset| if half { half_ramp(24, offset) } else { ramp(24, offset) };
            let file = Exr::new(6, 4, channels.iter().map(|(name, offset)| (*name, samples(*offset))).collect()).write();
            let image = decode(&file).unwrap();
            assert_eq!((image.width, image.height, image.channels as usize), (6, 4, expected.len()), "{channels:?}");
            assert_eq!(matches!(image.texels, Texels::Half(_)), half);
            for i in 0..24 {
                for (channel, offset) in expected.iter().enumerate() {
                    assert_eq!(image.texels.value(i * expected.len() + channel), value(*offset, i), "{channels:?}");
                }
            }
        }
    }
}

#[test]
fn exr_in_each_encoding() {
    use exr::compression::Compression;
    use exr::image::Blocks;
    use exr::meta::attribute::LineOrder;
    for compression in [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::ZIP16, Compression::PIZ] {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 8))] {
            let mut exr =
                Exr::new(40, 30, vec![("R", ramp(1200, 0.0)), ("G", half_ramp(1200, 1.0)), ("B", FlatSamples::U32(vec![7; 1200]))]);
            exr.encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            let image = decode(&exr.write()).unwrap();
            assert_eq!(image.rgba(1199)[0], 1199.0 / 64.0, "{compression} {blocks:?}");
            assert_eq!(image.rgba(64), [1.0, 2.0, 7.0, 1.0]);
        }
    }
}

#[test]
fn exr_of_many_parts_gives_the_first() {
    let part = |name: &str, size: usize, offset: f32| {
        let channels = AnyChannels::sort([AnyChannel::new("Y", ramp(size * size, offset))].into_iter().collect());
        Layer::new(Vec2(size, size), LayerAttributes::named(name), Encoding::FAST_LOSSLESS, channels)
    };
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(Vec2(4, 4)));
    let layers = exr::image::Layers::from_iter([part("first", 4, 1.0), part("second", 4, 9.0)]);
    let mut file = Cursor::new(Vec::new());
    exr::image::Image::from_layers(attributes, layers).write().non_parallel().to_buffered(&mut file).unwrap();
    let image = decode(file.get_ref()).unwrap();
    assert_eq!((image.width, image.channels, image.texels.value(0), image.texels.value(15)), (4, 1, 1.0, 1.0 + 15.0 / 64.0));
}

#[test]
fn exr_data_window_inside_and_outside_the_display_window() {
    let mut exr = Exr::new(4, 4, vec![("Y", ramp(16, 1.0))]);
    exr.attributes = ImageAttributes::new(IntegerBounds::new(Vec2(10, 20), Vec2(4, 4)));
    exr.position = Vec2(12, 19);
    let image = decode(&exr.write()).unwrap();
    assert_eq!((image.width, image.height), (4, 4));
    // The data begin two columns right of and one row above the display window.
    assert_eq!(image.texels.value(0), 0.0);
    assert_eq!(image.texels.value(2), 1.0 + 4.0 / 64.0);
    assert_eq!(image.texels.value(3 * 4 + 2), 0.0);
}

#[test]
fn exr_chromaticities_count_when_auto() {
    let mut exr = Exr::new(
        2,
        2,
        vec![("R", FlatSamples::F32(vec![0.5; 4])), ("G", FlatSamples::F32(vec![0.25; 4])), ("B", FlatSamples::F32(vec![0.125; 4]))],
    );
    let ap1 = Gamut::Ap1.primaries();
    let xy = |[x, y]: [f64; 2]| Vec2(x as f32, y as f32);
    exr.attributes.chromaticities =
        Some(Chromaticities { red: xy(ap1.red), green: xy(ap1.green), blue: xy(ap1.blue), white: xy(ap1.white) });
    let image = decode(&exr.write()).unwrap();
    let expected = crate::colour::apply(&Gamut::Ap1.to_rec709().unwrap(), [0.5, 0.25, 0.125]);
    for (space, expected) in [(ColourSpace::Auto, expected), (ColourSpace::ACES_CG, expected), (ColourSpace::Raw, [0.5, 0.25, 0.125])] {
        let texel = super::made::build(&image, space).texel(0, 1, 1).unwrap();
        let lat_long = LatLong::from_image(&image, DomeFormat::LatLong, space).unwrap().rgb[0];
        for channel in 0..3 {
            assert!((f64::from(texel[channel]) - expected[channel]).abs() < 3e-4, "{space:?}");
            assert!((f64::from(lat_long[channel]) - expected[channel]).abs() < 1e-6, "{space:?}");
        }
    }
}

#[test]
fn auto_follows_depth_and_channels() {
    let table = crate::colour::Transfer::Srgb.table();
    let colour = bytes(1, 1, 3, 5);
    let Texels::Byte(codes) = &colour.texels else { unreachable!() };
    let map = super::made::build(&colour, ColourSpace::Auto);
    assert_eq!(map.format(), TexelFormat::Byte);
    assert_eq!(map.texel(0, 0, 0).unwrap()[0], table[usize::from(codes[0])]);
    let grey = bytes(1, 1, 1, 5);
    assert_eq!(super::made::build(&grey, ColourSpace::Auto).texel(0, 0, 0).unwrap()[1], f32::from(codes[0]) / 255.0);
    let short = Image { texels: Texels::Short(vec![32_768; 3]), ..colour };
    let map = super::made::build(&short, ColourSpace::Auto);
    assert_eq!((map.format(), map.texel(0, 0, 0).unwrap()[2]), (TexelFormat::Float, 32_768.0 / 65_535.0));
}

/// Made with Pillow, 2 bits a texel.
#[rustfmt::skip]
const PALETTE_PNG: [u8; 91] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 4, 0, 0, 0, 1, 2, 3, 0, 0,
    0, 132, 82, 231, 94, 0, 0, 0, 12, 80, 76, 84, 69, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 251, 0, 96,
    246, 0, 0, 0, 10, 73, 68, 65, 84, 120, 156, 99, 144, 6, 0, 0, 29, 0, 28, 142, 244, 245, 33, 0, 0, 0, 0, 73,
    69, 78, 68, 174, 66, 96, 130,
];

/// Made with Pillow from (51, 153, 204, 26).
#[rustfmt::skip]
const CMYK_JPEG: [u8; 352] = [
    255, 216, 255, 238, 0, 14, 65, 100, 111, 98, 101, 0, 100, 0, 0, 0, 0, 0, 255, 219, 0, 67, 0, 3, 2, 2, 3, 2,
    2, 3, 3, 3, 3, 4, 3, 3, 4, 5, 8, 5, 5, 4, 4, 5, 10, 7, 7, 6, 8, 12, 10, 12, 12, 11, 10, 11,
    11, 13, 14, 18, 16, 13, 14, 17, 14, 11, 11, 16, 22, 16, 17, 19, 20, 21, 21, 21, 12, 15, 23, 24, 22, 20, 24, 18,
    20, 21, 20, 255, 192, 0, 20, 8, 0, 8, 0, 8, 4, 67, 17, 0, 77, 17, 0, 89, 17, 0, 75, 17, 0, 255, 196, 0,
    31, 0, 0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,
    10, 11, 255, 196, 0, 181, 16, 0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 125, 1, 2, 3, 0, 4,
    17, 5, 18, 33, 49, 65, 6, 19, 81, 97, 7, 34, 113, 20, 50, 129, 145, 161, 8, 35, 66, 177, 193, 21, 82, 209, 240, 36,
    51, 98, 114, 130, 9, 10, 22, 23, 24, 25, 26, 37, 38, 39, 40, 41, 42, 52, 53, 54, 55, 56, 57, 58, 67, 68, 69, 70,
    71, 72, 73, 74, 83, 84, 85, 86, 87, 88, 89, 90, 99, 100, 101, 102, 103, 104, 105, 106, 115, 116, 117, 118, 119, 120, 121, 122,
    131, 132, 133, 134, 135, 136, 137, 138, 146, 147, 148, 149, 150, 151, 152, 153, 154, 162, 163, 164, 165, 166, 167, 168, 169, 170, 178, 179,
    180, 181, 182, 183, 184, 185, 186, 194, 195, 196, 197, 198, 199, 200, 201, 202, 210, 211, 212, 213, 214, 215, 216, 217, 218, 225, 226, 227,
    228, 229, 230, 231, 232, 233, 234, 241, 242, 243, 244, 245, 246, 247, 248, 249, 250, 255, 218, 0, 14, 4, 67, 0, 77, 0, 89, 0,
    75, 0, 0, 63, 0, 251, 46, 188, 234, 190, 50, 175, 208, 218, 255, 217,
];
