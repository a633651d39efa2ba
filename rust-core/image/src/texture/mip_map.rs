//! A texture ready for lookups: its levels, finest first, in one buffer.

use super::encoder::Encoder;
use super::error::{TextureError, TextureErrorKind};
use super::image::{Image, Texels};
use super::limits::check_room;
use super::paged::{PagedTexels, TextureFacts};
use super::product::times_alpha;
use super::pyramid::{half_size, shrink};
use super::resolve::Conversion;
use super::texel::{TexelFormat, pack_bytes, pack_halves, unpack_halves};
use crate::colour::{ColourSpace, Stated, Transfer};
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Sizes and places of the levels in tables that lanes look up; places behind the last level repeat it.
#[derive(Clone, Debug)]
pub(crate) struct Levels {
    pub(crate) count: usize,
    pub(crate) widths: [f32; 32],
    pub(crate) heights: [f32; 32],
    /// The first texel of each level, as the bits of an integer.
    pub(crate) offsets: [f32; 32],
    texels: usize,
}

impl Levels {
    fn new(width: usize, height: usize) -> Self {
        let mut levels = Self { count: 0, widths: [1.0; 32], heights: [1.0; 32], offsets: [0.0; 32], texels: 0 };
        let mut size = [width, height];
        loop {
            let k = levels.count;
            // The last level is one texel: places behind it read that texel.
            levels.offsets[k..].fill(f32::from_bits(levels.texels as u32));
            (levels.widths[k], levels.heights[k]) = (size[0] as f32, size[1] as f32);
            levels.count += 1;
            levels.texels += size[0] * size[1];
            if size == [1, 1] {
                return levels;
            }
            size = size.map(half_size);
        }
    }
}

/// A texture with all its levels, as linear Rec.709 (or raw numbers) once read.
#[derive(Clone, Debug)]
pub struct MipMap {
    pub(crate) format: TexelFormat,
    /// How 8-bit colour codes are decoded after the fetch.
    pub(crate) transfer: Transfer,
    /// The linear values of 8-bit colour codes.
    pub(crate) table: Box<[f32; 256]>,
    pub(crate) levels: Levels,
    /// Empty where the texels are paged.
    pub(crate) words: Vec<f32>,
    /// The texels of a texture that is read tile by tile.
    pub(crate) paged: Option<Arc<PagedTexels>>,
    note: Option<String>,
}

/// Texels that one task packs.
const TOGETHER: usize = 1 << 12;

/// More words than hardware gathers can index.
const MAX_WORDS: usize = i32::MAX as usize;

impl MipMap {
    /// Builds the pyramid of an image whose numbers mean `space`.
    ///
    /// Errors: the image's values do not match its size, the pyramid is too large to index, or `cancel` was raised.
    pub fn build(image: &Image, space: ColourSpace, cancel: &AtomicBool) -> Result<Self, TextureError> {
        let multiplied = match space {
            ColourSpace::SrgbTimesAlpha(product) => Some(times_alpha(image, product)),
            _ => None,
        };
        let image = multiplied.as_ref().unwrap_or(image);
        let conversion = Conversion::resolve(space, image);
        check(image)?;
        let format = choose_format(image, &conversion);
        let levels = Levels::new(image.width as usize, image.height as usize);
        // One texel of padding: a pair read at the last texel stays in bounds unclamped.
        let words = (levels.texels + 1) * format.words();
        if words > MAX_WORDS {
            return Err(TextureError::new(
                TextureErrorKind::TooLarge,
                format!("the pyramid takes {words} words, the limit is {MAX_WORDS}"),
            )
            .hint("split the image into UDIM tiles"));
        }
        check_room(4 * words as u64, u64::from(image.width), u64::from(image.height))?;
        let transfer = conversion.transfer().filter(|_| format == TexelFormat::Byte).unwrap_or(Transfer::Linear);
        let note = match &image.stated {
            Stated::Unusable(what) if space == ColourSpace::Auto => Some(what.clone()),
            _ => None,
        };
        let mut map = Self { format, transfer, table: Box::new(transfer.table()), levels, words: vec![0.0; words], paged: None, note };
        map.fill_finest(image, &conversion);
        map.fill_coarser(cancel)?;
        Ok(map)
    }

    /// Texels of the finest level: width, height.
    pub fn resolution(&self) -> [u32; 2] {
        [self.levels.widths[0] as u32, self.levels.heights[0] as u32]
    }

    /// Levels of the pyramid.
    pub fn level_count(&self) -> usize {
        self.levels.count
    }

    /// How the texels are stored.
    pub fn format(&self) -> TexelFormat {
        self.format
    }

    /// What the file's header says of its colours but could not be used: words that follow the file's name.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// Bytes of all texels, whether or not they are in memory.
    pub fn bytes(&self) -> usize {
        self.paged.as_ref().map_or(self.words.len() * 4, |paged| paged.layout.bytes())
    }

    /// Whether its texels are read tile by tile.
    pub fn is_paged(&self) -> bool {
        self.paged.is_some()
    }

    /// What it is, and its words level by level.
    pub(crate) fn into_parts(self) -> (TextureFacts, Vec<f32>) {
        let [width, height] = self.resolution();
        (TextureFacts { format: self.format, transfer: self.transfer, width, height, note: self.note }, self.words)
    }

    /// A texture whose texels are read tile by tile.
    pub(crate) fn paged(facts: &TextureFacts, texels: Arc<PagedTexels>) -> Self {
        Self {
            format: facts.format,
            transfer: facts.transfer,
            table: Box::new(facts.transfer.table()),
            levels: Levels::new(facts.width as usize, facts.height as usize),
            words: Vec::new(),
            paged: Some(texels),
            note: facts.note.clone(),
        }
    }

    /// The same with all texels in memory; `None` where they are already.
    pub(crate) fn held_whole(&self) -> Option<Self> {
        let paged = self.paged.as_ref()?;
        let mut words = vec![0.0; (self.levels.texels + 1) * self.format.words()];
        for tile in 0..paged.layout.tiles() {
            paged.layout.paste(tile, &paged.read(tile), &mut words);
        }
        Some(Self { words, paged: None, ..self.clone() })
    }

    /// One texel of a level as linear RGBA; `y` counts from the image's top. Nothing outside the level.
    pub fn texel(&self, level: usize, x: usize, y: usize) -> Option<[f32; 4]> {
        let (width, height, offset) = self.level(level)?;
        (x < width && y < height).then(|| match &self.paged {
            None => self.read(&self.words, offset + y * width + x),
            Some(paged) => {
                let (tile, texel) = paged.layout.place(level as u32, x as u32, y as u32);
                self.read(&paged.read(tile), texel)
            }
        })
    }

    fn level(&self, level: usize) -> Option<(usize, usize, usize)> {
        let Levels { count, widths, heights, offsets, .. } = &self.levels;
        (level < *count).then(|| (widths[level] as usize, heights[level] as usize, offsets[level].to_bits() as usize))
    }

    fn read(&self, words: &[f32], texel: usize) -> [f32; 4] {
        let at = texel * self.format.words();
        match self.format {
            TexelFormat::Byte => self.decoded(words[at]),
            TexelFormat::Grey => [words[at], words[at], words[at], 1.0],
            TexelFormat::Half => unpack_halves([words[at], words[at + 1]]),
            TexelFormat::Float => [words[at], words[at + 1], words[at + 2], words[at + 3]],
        }
    }

    /// Four codes of a byte each as linear RGBA.
    #[inline]
    fn decoded(&self, word: f32) -> [f32; 4] {
        let [r, g, b, a] = word.to_bits().to_le_bytes();
        let [r, g, b] = [r, g, b].map(|code| self.table[usize::from(code)]);
        [r, g, b, f32::from(a) / 255.0]
    }

    fn fill_finest(&mut self, image: &Image, conversion: &Conversion) {
        let texels = &mut self.words[..image.len() * self.format.words()];
        if let (TexelFormat::Byte, Texels::Byte(values)) = (self.format, &image.texels) {
            let channels = image.channels as usize;
            let parts = texels.par_chunks_mut(TOGETHER).zip(values.par_chunks(TOGETHER * channels));
            parts.for_each(|(words, codes)| match channels {
                1 => pack(words, codes, |[grey]| [grey, grey, grey, 255]),
                2 => pack(words, codes, |[grey, alpha]| [grey, grey, grey, alpha]),
                3 => pack(words, codes, |[r, g, b]| [r, g, b, 255]),
                _ => pack(words, codes, |rgba: [u8; 4]| rgba),
            });
            return;
        }
        let format = self.format;
        texels.par_chunks_exact_mut(format.words()).enumerate().for_each(|(index, words)| {
            store(format, words, conversion.texel(image, index));
        });
    }

    fn fill_coarser(&mut self, cancel: &AtomicBool) -> Result<(), TextureError> {
        let encoder = Encoder::new(self.transfer);
        // Each level is made from the unrounded one above it, so that rounding does not add up.
        let mut above: Option<Vec<[f32; 4]>> = None;
        for level in 1..self.levels.count {
            if cancel.load(Ordering::Relaxed) {
                return Err(TextureError::new(TextureErrorKind::Cancelled, "loading was cancelled"));
            }
            let (width, height, offset) = self.level(level - 1).expect("the level above exists");
            let texels = match (&above, self.format) {
                (Some(texels), _) => shrink([width, height], |x, y| texels[y * width + x]),
                (None, TexelFormat::Byte) => {
                    let words = &self.words[offset..offset + width * height];
                    shrink([width, height], |x, y| self.decoded(words[y * width + x]))
                }
                (None, _) => shrink([width, height], |x, y| self.read(&self.words, offset + y * width + x)),
            };
            let (format, first) = (self.format, (offset + width * height) * self.format.words());
            let words = &mut self.words[first..first + texels.len() * format.words()];
            let parts = words.par_chunks_mut(TOGETHER * format.words()).zip(texels.par_chunks(TOGETHER));
            parts.for_each(|(words, texels)| match format {
                TexelFormat::Byte => {
                    words.iter_mut().zip(texels).for_each(|(word, texel)| *word = pack_bytes(encode(&encoder, *texel)));
                }
                _ => words.chunks_exact_mut(format.words()).zip(texels).for_each(|(words, texel)| store(format, words, *texel)),
            });
            above = Some(texels);
        }
        Ok(())
    }
}

/// Puts texels of N codes each into words.
fn pack<const N: usize>(words: &mut [f32], codes: &[u8], rgba: impl Fn([u8; N]) -> [u8; 4]) {
    words.iter_mut().zip(codes.as_chunks().0).for_each(|(word, codes)| *word = pack_bytes(rgba(*codes)));
}

fn encode(encoder: &Encoder, [r, g, b, a]: [f32; 4]) -> [u8; 4] {
    [encoder.encode(r), encoder.encode(g), encoder.encode(b), (a * 255.0 + 0.5) as u8]
}

/// Writes a linear texel in a float format.
fn store(format: TexelFormat, words: &mut [f32], texel: [f32; 4]) {
    match format {
        TexelFormat::Byte => {}
        TexelFormat::Grey => words[0] = texel[0],
        TexelFormat::Half => words.copy_from_slice(&pack_halves(texel)),
        TexelFormat::Float => words.copy_from_slice(&texel),
    }
}

fn check(image: &Image) -> Result<(), TextureError> {
    let expected = image.len() * image.channels as usize;
    if !(1..=4).contains(&image.channels) || image.is_empty() || image.texels.len() != expected {
        let found = image.texels.len();
        return Err(TextureError::malformed(format!(
            "{} × {} texels of {} channels hold {found} values, expected {expected}",
            image.width, image.height, image.channels
        )));
    }
    Ok(())
}

/// The smallest storage that keeps what the file says: bytes stay bytes, colours become halves, numbers that halves would round stay floats.
fn choose_format(image: &Image, conversion: &Conversion) -> TexelFormat {
    if image.is_byte() && conversion.transfer().is_some() {
        return TexelFormat::Byte;
    }
    if image.channels == 1 {
        return TexelFormat::Grey;
    }
    let halves_are_enough = match &image.texels {
        Texels::Half(_) => true,
        Texels::Byte(_) | Texels::Short(_) => conversion.is_colour,
        Texels::Float(values) if conversion.is_colour => values.par_iter().all(|x| !x.is_finite() || x.abs() <= 65504.0),
        Texels::Float(values) => values.par_iter().all(|x| half::f16::from_f32(*x).to_f32() == *x),
    };
    if halves_are_enough { TexelFormat::Half } else { TexelFormat::Float }
}
