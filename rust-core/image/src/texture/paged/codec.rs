//! Tiles in fewer bytes, without loss: each channel as differences from its neighbours, which need few bits where a picture is smooth.
//!
//! The neighbours are PNG's (ISO/IEC 15948, 9): the texel above, the one to the left, or both less the one between. Red and blue may be
//! kept as what they differ from green by, as in lossless WebP. Differences are packed rather than entropy coded: a sixth more bytes on
//! photographs, for a tile that is read in the time that its checksum and its copy take several times over.

use super::neighbour::{Neighbour, TRIED, add, differences, restore};
use super::pack::{MARGIN, pack, packed_bytes, unpack};
use crate::texture::texel::TexelFormat;
use std::borrow::Cow;

/// Texels of the largest tile.
const MOST_TEXELS: usize = 64 * 64;
/// A tile that is one texel again and again.
const CONSTANT: u8 = 0;
/// A tile of packed channels.
const PACKED: u8 = 1;
/// A tile as it lies in memory.
const PLAIN: u8 = 2;
/// Of a channel that is kept as its difference from green.
const LESS_GREEN: u8 = 0x80;

/// What of the words of a tile is which channel.
#[derive(Clone, Copy, Debug)]
struct Channels {
    count: usize,
    /// Bits a channel.
    bits: u32,
    words: usize,
}

impl Channels {
    fn of(format: TexelFormat) -> Self {
        let (count, bits) = match format {
            TexelFormat::Byte => (4, 8),
            TexelFormat::Grey => (1, 32),
            TexelFormat::Half => (4, 16),
            TexelFormat::Float => (4, 32),
        };
        Self { count, bits, words: format.words() }
    }

    /// Green first, from which red and blue may be told.
    fn order(self) -> &'static [usize] {
        if self.count == 1 { &[0] } else { &[1, 0, 2, 3] }
    }

    /// The word of a texel that holds a channel, and where in it.
    fn place(self, channel: usize) -> (usize, u32) {
        let each = (u32::BITS / self.bits) as usize;
        (channel / each, self.bits * (channel % each) as u32)
    }

    fn mask(self) -> u32 {
        u32::MAX >> (u32::BITS - self.bits)
    }

    fn take(self, words: &[u32], channel: usize) -> Vec<u32> {
        let ((word, shift), mask) = (self.place(channel), self.mask());
        words.iter().skip(word).step_by(self.words).map(|word| word >> shift & mask).collect()
    }

    fn put(self, plane: &[u32], channel: usize, words: &mut [u32]) {
        let ((word, shift), mask) = (self.place(channel), self.mask());
        if self.words == 1 {
            words.iter_mut().zip(plane).for_each(|(word, value)| *word |= (value & mask) << shift);
        } else {
            words.iter_mut().skip(word).step_by(self.words).zip(plane).for_each(|(word, value)| *word |= (value & mask) << shift);
        }
    }
}

/// The words of a tile whose rows have `width` texels, in fewer bytes if that can be.
pub(super) fn encode(words: &[f32], format: TexelFormat, width: usize) -> Vec<u8> {
    let words: &[u32] = bytemuck::cast_slice(words);
    let channels = Channels::of(format);
    let texel = &words[..channels.words];
    if words.chunks_exact(channels.words).all(|other| other == texel) {
        return with_kind(CONSTANT, bytemuck::cast_slice(texel));
    }
    let plain: &[u8] = bytemuck::cast_slice(words);
    let mut bytes = Vec::with_capacity(1 + plain.len());
    bytes.push(PACKED);
    let green = (channels.count > 1).then(|| channels.take(words, 1));
    for &channel in channels.order() {
        let plane = channels.take(words, channel);
        let reference = green.as_deref().filter(|_| channel == 0 || channel == 2);
        encode_channel(channels, &plane, reference, width, &mut bytes);
    }
    if bytes.len() > plain.len() { with_kind(PLAIN, plain) } else { bytes }
}

fn with_kind(kind: u8, rest: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(1 + rest.len());
    bytes.push(kind);
    bytes.extend_from_slice(rest);
    bytes
}

/// Appends a channel in the way that takes the fewest bytes.
fn encode_channel(channels: Channels, plane: &[u32], green: Option<&[u32]>, width: usize, bytes: &mut Vec<u8>) {
    let mut ways = vec![(0, Cow::Borrowed(plane))];
    if let Some(green) = green {
        let less: Vec<u32> = plane.iter().zip(green).map(|(value, green)| value.wrapping_sub(*green) & channels.mask()).collect();
        ways.push((LESS_GREEN, Cow::Owned(less)));
    }
    if let Some((flag, plane)) = ways.iter().find(|(_, plane)| plane.iter().all(|value| *value == plane[0])) {
        bytes.push(flag | Neighbour::Constant as u8);
        bytes.extend_from_slice(&plane[0].to_le_bytes());
        return;
    }
    let mut best: Option<(usize, u8, Vec<u32>)> = None;
    for (flag, plane) in &ways {
        for neighbour in TRIED {
            let told = differences(plane, width, neighbour, channels.bits);
            let size = packed_bytes(&told, channels.bits);
            if best.as_ref().is_none_or(|(least, ..)| size < *least) {
                best = Some((size, flag | neighbour as u8, told));
            }
        }
    }
    if let Some((_, kind, told)) = best {
        bytes.push(kind);
        pack(&told, channels.bits, bytes);
    }
}

/// Fills the words of a tile, which are zero, from bytes that [`encode`] wrote, with [`PADDING`] bytes behind; `None` where they cannot be such.
pub(super) fn decode(bytes: &[u8], format: TexelFormat, width: usize, words: &mut [f32]) -> Option<()> {
    let words: &mut [u32] = bytemuck::cast_slice_mut(words);
    let channels = Channels::of(format);
    let (kind, mut bytes) = bytes.split_first()?;
    match *kind {
        CONSTANT => {
            let texel = bytes.get(..4 * channels.words)?;
            words.chunks_exact_mut(channels.words).for_each(|to| bytemuck::cast_slice_mut(to).copy_from_slice(texel));
        }
        PLAIN => {
            let to: &mut [u8] = bytemuck::cast_slice_mut(words);
            to.copy_from_slice(bytes.get(..to.len())?);
        }
        PACKED => {
            let texels = words.len() / channels.words;
            let (mut green, mut plane) = ([0; MOST_TEXELS], [0; MOST_TEXELS]);
            let plane = plane.get_mut(..texels)?;
            for &channel in channels.order() {
                bytes = decode_channel(bytes, channels.bits, width, &green, plane)?;
                channels.put(plane, channel, words);
                if channel == 1 {
                    green[..texels].copy_from_slice(plane);
                }
            }
        }
        _ => return None,
    }
    Some(())
}

/// Bytes that [`decode`] wants behind those of a tile.
pub(super) const PADDING: usize = MARGIN;

/// Fills a channel; what follows its bytes.
fn decode_channel<'a>(bytes: &'a [u8], bits: u32, width: usize, green: &[u32], plane: &mut [u32]) -> Option<&'a [u8]> {
    let (kind, mut bytes) = bytes.split_first()?;
    let neighbour = TRIED.into_iter().find(|neighbour| *neighbour as u8 == kind & !LESS_GREEN);
    if let Some(neighbour) = neighbour {
        let used = unpack(bytes, bits, plane)?;
        bytes = bytes.get(used..)?;
        restore(plane, width, neighbour);
    } else if kind & !LESS_GREEN == Neighbour::Constant as u8 {
        let (value, rest) = bytes.split_first_chunk()?;
        plane.fill(u32::from_le_bytes(*value));
        bytes = rest;
    } else {
        return None;
    }
    if kind & LESS_GREEN != 0 {
        add(plane, green);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::tests::made::Random;

    const FORMATS: [TexelFormat; 4] = [TexelFormat::Byte, TexelFormat::Grey, TexelFormat::Half, TexelFormat::Float];

    /// Words whose bits are those of `number`, so that every kind of float is among them.
    fn words(count: usize, mut number: impl FnMut(usize) -> u32) -> Vec<f32> {
        (0..count).map(|place| f32::from_bits(number(place))).collect()
    }

    fn again(bytes: &[u8], format: TexelFormat, width: usize, count: usize) -> Option<Vec<f32>> {
        let mut padded = bytes.to_vec();
        padded.resize(bytes.len() + PADDING, 0xa5);
        let mut words = vec![0.0; count];
        decode(&padded, format, width, &mut words)?;
        Some(words)
    }

    /// A tile comes back bit by bit; the bytes that it takes.
    #[track_caller]
    fn assert_kept(words: &[f32], format: TexelFormat, width: usize) -> usize {
        let bytes = encode(words, format, width);
        let found = again(&bytes, format, width, words.len()).unwrap();
        assert!(found.iter().zip(words).all(|(a, b)| a.to_bits() == b.to_bits()), "{format:?} {width}");
        assert!(bytes.len() <= 4 * words.len() + 1);
        bytes.len()
    }

    #[test]
    fn tiles_of_every_format_and_shape_come_back_bit_by_bit() {
        let mut random = Random(5);
        for format in FORMATS {
            let side = if format == TexelFormat::Float { 32 } else { 64 };
            for (width, height) in [(1, 1), (1, side), (side, 1), (2, 2), (17, 5), (side, side)] {
                let count = width * height * format.words();
                let noise = words(count, |_| random.next() as u32);
                let size = assert_kept(&noise, format, width);
                assert!(size == 4 * count + 1 || count < 64, "noise is kept as it is");
                assert_kept(&words(count, |place| (place as u32).wrapping_mul(0x0101_0203)), format, width);
                assert_kept(&words(count, |place| (0.01 * place as f32).sin().to_bits()), format, width);
                assert_kept(&words(count, |place| u32::from(place == count / 2) * 0xff00), format, width);
            }
        }
    }

    #[test]
    fn a_tile_of_one_texel_takes_no_more_than_that() {
        for format in FORMATS {
            let texel = words(format.words(), |place| 0x3f40_3c00 + place as u32);
            assert_eq!(assert_kept(&texel.repeat(1024), format, 32), 1 + 4 * format.words());
        }
    }

    #[test]
    fn smooth_colours_with_grain_take_half_and_greys_less() {
        let mut random = Random(5);
        let mut grain = || (random.unit() * 8.0) as u32;
        let (mut colours, mut greys) = (Vec::new(), Vec::new());
        for place in 0..4096 {
            let value = 60 + (place % 64) + (place / 64);
            let [red, green, blue] = [value + grain(), value + grain() + 9, value + grain()];
            colours.push(f32::from_bits(red | green << 8 | blue << 16 | 0xff00_0000));
            greys.push(f32::from_bits((green * 0x01_0101) | 0xff00_0000));
        }
        let sizes = [&colours, &greys].map(|words| assert_kept(words, TexelFormat::Byte, 64));
        assert!(sizes[0] < 8192 && sizes[1] < 3000, "{sizes:?} of 16384");
    }

    #[test]
    fn damaged_bytes_give_any_texels_or_none() {
        let mut random = Random(5);
        for format in FORMATS {
            let tile = words(32 * 32 * format.words(), |place| ((place as f32 * 0.03).sin() * 90.0) as i32 as u32 & 0x00ff_00ff);
            let bytes = encode(&tile, format, 32);
            for _ in 0..300 {
                let mut spoilt = bytes[..1 + (random.unit() * (bytes.len() - 1) as f32) as usize].to_vec();
                for _ in 0..3 {
                    let place = (random.unit() * spoilt.len() as f32) as usize % spoilt.len();
                    spoilt[place] = random.next() as u8;
                }
                again(&spoilt, format, 32, tile.len());
            }
        }
    }

    /// `cargo test --profile quick -p gonio-image -- --ignored --nocapture costs`
    #[test]
    #[ignore = "it measures"]
    fn what_a_tile_costs() {
        let mut random = Random(5);
        let mut grain = || (random.unit() * 8.0) as u32;
        let tile = words(4096, |place| {
            let value = 60 + (place as u32 % 64) + (place as u32 / 64);
            (value + grain()) | ((value + grain()) << 8) | ((value + grain()) << 16) | 0xff00_0000
        });
        let mut bytes = encode(&tile, TexelFormat::Byte, 64);
        let size = bytes.len();
        let of = |work: &mut dyn FnMut()| {
            let start = std::time::Instant::now();
            (0..2000).for_each(|_| work());
            start.elapsed().as_secs_f64() / 2000.0 * 1e6
        };
        let encoding = of(&mut || drop(std::hint::black_box(encode(&tile, TexelFormat::Byte, 64))));
        bytes.resize(size + PADDING, 0);
        let decoding = of(&mut || {
            let mut words = vec![0.0; 4096];
            decode(&bytes, TexelFormat::Byte, 64, &mut words);
            std::hint::black_box(words);
        });
        let sum = of(&mut || {
            std::hint::black_box(crc32fast::hash(&bytes));
        });
        eprintln!("{size} bytes of 16384: {encoding:.1} µs to make, {decoding:.1} µs to read, {sum:.1} µs for the checksum");
    }
}
