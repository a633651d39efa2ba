//! A decoded image, as its file stores it.

use crate::colour::Stated;
use half::f16;

/// An image before any colour conversion.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Texels a row.
    pub width: u32,
    /// Rows, the top one first.
    pub height: u32,
    /// Values a texel: 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha.
    pub channels: u32,
    /// The values, row by row, channels interleaved.
    pub texels: Texels,
    /// What the file's header says of its colours.
    pub stated: Stated,
}

/// The values of an image; integers mean fractions of their largest.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// 8 bits each.
    Byte(Vec<u8>),
    /// 16 bits each.
    Short(Vec<u16>),
    /// Half floats.
    Half(Vec<f16>),
    /// Floats.
    Float(Vec<f32>),
}

impl Texels {
    /// Values held.
    pub fn len(&self) -> usize {
        match self {
            Self::Byte(values) => values.len(),
            Self::Short(values) => values.len(),
            Self::Half(values) => values.len(),
            Self::Float(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The value at `index` as a float, integers as fractions; what is not finite becomes zero or the largest half's magnitude.
    pub fn value(&self, index: usize) -> f32 {
        match self {
            Self::Byte(values) => f32::from(values[index]) / 255.0,
            Self::Short(values) => f32::from(values[index]) / 65535.0,
            Self::Half(values) => finite(values[index].to_f32()),
            Self::Float(values) => finite(values[index]),
        }
    }
}

/// Renderers write infinities and NaN now and then; one such texel would spoil every level of the pyramid.
fn finite(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { if x.is_infinite() { 65504_f32.copysign(x) } else { x } }
}

impl Image {
    /// Texels in all.
    pub fn len(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether the values are integers of 8 bits.
    pub fn is_byte(&self) -> bool {
        matches!(self.texels, Texels::Byte(_))
    }

    /// The texel at `index` (row by row) as RGBA: grey replicated, alpha 1 where absent.
    pub fn rgba(&self, index: usize) -> [f32; 4] {
        let at = index * self.channels as usize;
        let value = |channel| self.texels.value(at + channel);
        match self.channels {
            1 => [value(0), value(0), value(0), 1.0],
            2 => [value(0), value(0), value(0), value(1)],
            3 => [value(0), value(1), value(2), 1.0],
            _ => [value(0), value(1), value(2), value(3)],
        }
    }
}
