//! TIFF and OpenImageIO's `.tx`: strips or tiles, planes side by side or apart, integers and floats. Of many directories the first counts, in
//! which `.tx` files keep the finest level.

use crate::colour::{Stated, from_profile};
use crate::texture::error::{TextureError, TextureErrorKind};
use crate::texture::image::{Image, Texels};
use crate::texture::limits::{check_size, most_bytes};
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

/// Grey, RGB, CMYK or YCbCr of 1 to 64 bits; LZW, deflate, PackBits, JPEG and fax.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, TextureError> {
    let mut limits = Limits::default();
    let most = most_bytes() as usize;
    (limits.decoding_buffer_size, limits.intermediate_buffer_size) = (most, most);
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(from_tiff)?.with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(from_tiff)?;
    let colour = decoder.colortype().map_err(from_tiff)?;
    let samples = usize::from(colour.num_samples());
    let texel_bytes = samples as u64 * u64::from(colour.bit_depth().div_ceil(8));
    check_size(u64::from(width), u64::from(height), texel_bytes, bytes.len())?;
    let profile = decoder.get_tag_u8_vec(Tag::IccProfile).ok();
    let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples).ok().flatten().unwrap_or_default();
    let mut values = DecodingResult::U8(Vec::new());
    let layout = decoder.read_image_to_buffer(&mut values).map_err(from_tiff)?;
    let order = Order { texels: width as usize * height as usize, samples, planes: layout.planes };
    let (texels, channels) = texels(values, colour, &order, width as usize, matches!(extra.first(), Some(1 | 2)))?;
    let stated = profile.map_or(Stated::Nothing, |profile| from_profile(&profile, channels));
    Ok(Image { width, height, channels, texels, stated })
}

fn from_tiff(error: TiffError) -> TextureError {
    match error {
        TiffError::UnsupportedError(what) => TextureError::new(TextureErrorKind::Unsupported, format!("TIFF: {what}")),
        TiffError::LimitsExceeded => TextureError::new(TextureErrorKind::TooLarge, "the image is larger than the limits allow"),
        other => TextureError::malformed(format!("TIFF: {other}")),
    }
}

/// How samples follow one another.
struct Order {
    texels: usize,
    /// Samples a texel.
    samples: usize,
    /// More than one: each sample in a plane of its own.
    planes: usize,
}

impl Order {
    /// The first `channels` samples of each texel, side by side; nothing where there are fewer than the size wants.
    fn interleaved<T: Copy>(&self, values: &[T], channels: usize) -> Option<Vec<T>> {
        if values.len() < self.texels * self.samples {
            return None;
        }
        let place = |texel: usize, channel: usize| {
            if self.planes > 1 { channel * self.texels + texel } else { texel * self.samples + channel }
        };
        Some((0..self.texels).flat_map(|texel| (0..channels).map(move |channel| values[place(texel, channel)])).collect())
    }
}

/// The texels of an image, and their channels; `has_alpha` says that the first sample behind the colours is alpha.
fn texels(values: DecodingResult, colour: ColorType, order: &Order, width: usize, has_alpha: bool) -> Result<(Texels, u32), TextureError> {
    let unsupported = |what: String| TextureError::new(TextureErrorKind::Unsupported, format!("TIFF: {what}"));
    let (channels, has_inks) = match colour {
        ColorType::Gray(_) => (1, false),
        ColorType::Multiband { .. } => (if has_alpha { 2 } else { 1 }, false),
        ColorType::RGB(_) | ColorType::YCbCr(8) => (3, false),
        ColorType::RGBA(_) => (4, false),
        ColorType::CMYK(8 | 16) | ColorType::CMYKA(8 | 16) => (4, true),
        other => return Err(unsupported(format!("texels of type {other:?} are not supported"))),
    };
    let all = |texels: Option<Texels>| texels.ok_or_else(|| TextureError::malformed("TIFF: the samples do not fill the image"));
    let texels = match values {
        DecodingResult::U8(values) if colour.bit_depth() < 8 => {
            let row = width * order.samples;
            let unpacked = unpacked(&values, row, colour.bit_depth());
            all(order.interleaved(&unpacked, channels).map(Texels::Byte))?
        }
        DecodingResult::U8(values) => all(order.interleaved(&values, channels).map(Texels::Byte))?,
        DecodingResult::U16(values) => all(order.interleaved(&values, channels).map(Texels::Short))?,
        DecodingResult::F16(values) => all(order.interleaved(&values, channels).map(Texels::Half))?,
        DecodingResult::F32(values) => all(order.interleaved(&values, channels).map(Texels::Float))?,
        DecodingResult::U32(values) => {
            let values: Vec<f32> = values.iter().map(|value| (f64::from(*value) / f64::from(u32::MAX)) as f32).collect();
            all(order.interleaved(&values, channels).map(Texels::Float))?
        }
        DecodingResult::F64(values) => {
            let values: Vec<f32> = values.iter().map(|value| *value as f32).collect();
            all(order.interleaved(&values, channels).map(Texels::Float))?
        }
        _ => return Err(unsupported("signed integers and integers of 64 bits are not supported".to_owned())),
    };
    Ok(match (texels, colour) {
        (Texels::Byte(values), ColorType::YCbCr(_)) => (Texels::Byte(from_ycbcr(&values)), 3),
        (Texels::Byte(values), _) if has_inks => (Texels::Byte(from_inks(&values, 255)), 3),
        (Texels::Short(values), _) if has_inks => (Texels::Short(from_inks(&values, 65535)), 3),
        (texels, _) => (texels, channels as u32),
    })
}

/// Samples of fewer than 8 bits, each row of `row` samples beginning with a byte, spread over 0..255.
fn unpacked(bytes: &[u8], row: usize, bits: u8) -> Vec<u8> {
    let (per_byte, largest) = (usize::from(8 / bits), (1_u16 << bits) - 1);
    let sample = |row: &[u8], at: usize| {
        let code = u16::from(row[at / per_byte] >> (8 - usize::from(bits) * (at % per_byte + 1))) & largest;
        (code * 255 / largest) as u8
    };
    bytes.chunks_exact(row.div_ceil(per_byte)).flat_map(|bytes| (0..row).map(move |at| sample(bytes, at))).collect()
}

/// RGB of inks, without a profile: each ink lets pass what it does not cover.
fn from_inks<T: Copy + Into<u32> + TryFrom<u32> + Default>(values: &[T], largest: u32) -> Vec<T> {
    let left = |ink: T, key: T| T::try_from(((largest - ink.into()) * (largest - key.into()) + largest / 2) / largest).unwrap_or_default();
    values.chunks_exact(4).flat_map(|inks| [left(inks[0], inks[3]), left(inks[1], inks[3]), left(inks[2], inks[3])]).collect()
}

/// RGB of luma and colour differences in full range (JFIF 1.02; TIFF 6.0, section 21, with the usual coefficients of ITU-R BT.601).
fn from_ycbcr(values: &[u8]) -> Vec<u8> {
    let code = |x: f32| (x + 0.5).clamp(0.0, 255.0) as u8;
    values
        .chunks_exact(3)
        .flat_map(|texel| {
            let [y, blue, red] = [f32::from(texel[0]), f32::from(texel[1]) - 128.0, f32::from(texel[2]) - 128.0];
            [code(y + 1.402 * red), code(y - 0.344_136 * blue - 0.714_136 * red), code(y + 1.772 * blue)]
        })
        .collect()
}
