//! How OpenVDB packs the values of a node.

use crate::inflate::inflate;
use crate::stream::Stream;
use crate::value::{COMPONENTS, Number, ValueType};
use crate::{Result, blosc};

/// The ways in which a grid's values are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Compression {
    /// Values are zlib streams.
    pub zip: bool,
    /// Inactive values are left out where they are of one or two kinds.
    pub active_mask: bool,
    /// Values are Blosc chunks.
    pub blosc: bool,
}

impl Compression {
    pub(crate) const NONE: Self = Self { zip: false, active_mask: false, blosc: false };

    pub(crate) fn from_flags(flags: u32) -> Option<Self> {
        (flags < 8).then_some(Self { zip: flags & 1 != 0, active_mask: flags & 2 != 0, blosc: flags & 4 != 0 })
    }

    pub(crate) fn flags(self) -> u32 {
        u32::from(self.zip) | u32::from(self.active_mask) << 1 | u32::from(self.blosc) << 2
    }

    /// In words, such as `blosc + active values`.
    pub(crate) fn name(self) -> String {
        let parts = [(self.blosc, "blosc"), (self.zip, "zip"), (self.active_mask, "active values")];
        let parts: Vec<&str> = parts.iter().filter(|part| part.0).map(|part| part.1).collect();
        if parts.is_empty() { "none".into() } else { parts.join(" + ") }
    }
}

/// The value of inactive voxels that a node leaves out, after the byte that says how. Source: OpenVDB's `io/Compression.h`.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Mode {
    /// Values of its own that the node tells: none, one or two.
    told: u8,
    /// A mask chooses between two values.
    selects: bool,
    /// All values are stored.
    all: bool,
    /// The first value is the background's negative.
    negative: bool,
}

impl Mode {
    const ALL: Self = Self { told: 0, selects: false, all: true, negative: false };

    fn from_byte(byte: u8) -> Option<Self> {
        let mode = |told, selects, negative| Some(Self { told, selects, all: false, negative });
        match byte {
            0 => mode(0, false, false),
            1 => mode(0, false, true),
            2 => mode(1, false, false),
            3 => mode(0, true, true),
            4 => mode(1, true, false),
            5 => mode(2, true, false),
            6 => Some(Self::ALL),
            _ => None,
        }
    }
}

/// What the nodes of one tree have in common, and room for their bytes.
pub(crate) struct Unpacker {
    pub(crate) value: ValueType,
    pub(crate) version: u32,
    pub(crate) compression: Compression,
    pub(crate) background: [f32; COMPONENTS],
    packed: Vec<u8>,
    plain: Vec<u8>,
    active: Vec<f32>,
}

impl Unpacker {
    pub(crate) fn new(value: ValueType, version: u32, compression: Compression) -> Self {
        Self { value, version, compression, background: [0.0; COMPONENTS], packed: Vec::new(), plain: Vec::new(), active: Vec::new() }
    }

    /// One value in full.
    pub(crate) fn one(&mut self, stream: &mut Stream) -> Result<[f32; COMPONENTS]> {
        stream.fill(&mut self.plain, self.value.size() as u64, "a value")?;
        self.active.clear();
        self.value.number.decode(&self.plain, &mut self.active);
        let mut value = [0.0; COMPONENTS];
        value[..self.active.len()].copy_from_slice(&self.active);
        Ok(value)
    }

    fn mode(&self, stream: &mut Stream) -> Result<Mode> {
        // Before version 222 nodes had no such byte.
        if self.version < 222 {
            return Ok(Mode::ALL);
        }
        let byte = stream.u8()?;
        Mode::from_byte(byte).ok_or_else(|| stream.error(format!("a node with its values packed in way {byte}; there are 0 to 6")))
    }

    /// The values of a node of `count` places, one component after another, in place of what `to` held.
    pub(crate) fn values(&mut self, stream: &mut Stream, count: usize, mask: &[u64], to: &mut Vec<f32>) -> Result<()> {
        let mode = self.mode(stream)?;
        let mut pair = [self.background; 2];
        if mode.negative {
            pair[0] = self.negative();
        } else if mode.told > 0 {
            pair[0] = self.one(stream)?;
            if mode.told > 1 {
                pair[1] = self.one(stream)?;
            }
        }
        let mut chosen = Vec::new();
        if mode.selects {
            for _ in mask {
                chosen.push(stream.u64()?);
            }
        }
        to.clear();
        let stored = self.stored(mode, count, mask);
        if stored == count {
            return self.unpack(stream, count, to);
        }
        let mut active = std::mem::take(&mut self.active);
        active.clear();
        let read = self.unpack(stream, stored, &mut active);
        self.active = active;
        read?;
        self.spread(count, mask, &chosen, &pair, to);
        Ok(())
    }

    /// Active values to their places, inactive ones between them.
    fn spread(&self, count: usize, mask: &[u64], chosen: &[u64], pair: &[[f32; COMPONENTS]; 2], to: &mut Vec<f32>) {
        let components = self.value.components;
        let mut active = self.active.chunks_exact(components);
        let bit = |words: &[u64], n: usize| words.get(n / 64).is_some_and(|word| word >> (n % 64) & 1 != 0);
        for n in 0..count {
            let inactive = &pair[usize::from(bit(chosen, n))][..components];
            to.extend_from_slice(if bit(mask, n) { active.next().unwrap_or(inactive) } else { inactive });
        }
    }

    /// Goes past the values of a node.
    pub(crate) fn skip(&mut self, stream: &mut Stream, count: usize, mask: &[u64]) -> Result<()> {
        let mode = self.mode(stream)?;
        stream.skip(u64::from(mode.told) * self.value.size() as u64)?;
        stream.skip(if mode.selects { 8 * mask.len() as u64 } else { 0 })?;
        let stored = self.stored(mode, count, mask);
        match self.packed_size(stream, stored, self.compression)? {
            Some((size, _)) => stream.skip(size),
            None => Ok(()),
        }
    }

    /// How many of a node's values are stored.
    fn stored(&self, mode: Mode, count: usize, mask: &[u64]) -> usize {
        if !self.compression.active_mask || mode.all {
            return count;
        }
        mask.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Auxiliary buffers of files before version 222, which nothing uses any more.
    pub(crate) fn skip_auxiliary(&mut self, stream: &mut Stream, count: usize) -> Result<()> {
        match self.packed_size(stream, count, Compression { active_mask: false, ..self.compression })? {
            Some((size, _)) => stream.skip(size),
            None => Ok(()),
        }
    }

    /// The bytes that hold so many values, and whether they are packed.
    fn packed_size(&self, stream: &mut Stream, count: usize, compression: Compression) -> Result<Option<(u64, bool)>> {
        let size = (count * self.value.components * self.value.stored().size()) as u64;
        // Of halves nothing at all is written where there are none.
        if count == 0 && self.value.halved {
            return Ok(None);
        }
        if !compression.blosc && !compression.zip {
            return Ok(Some((size, false)));
        }
        let told = stream.i64()?;
        if told > 0 {
            return Ok(Some((told.unsigned_abs(), true)));
        }
        if told.unsigned_abs() != size {
            return Err(stream.error(format!("an array of {} bytes, expected {size}", told.unsigned_abs())));
        }
        Ok(Some((size, false)))
    }

    /// So many stored values, at the end of `to`.
    fn unpack(&mut self, stream: &mut Stream, count: usize, to: &mut Vec<f32>) -> Result<()> {
        let start = stream.position();
        let Some((size, packed)) = self.packed_size(stream, count, self.compression)? else {
            return Ok(());
        };
        let stored = self.value.stored();
        if packed {
            stream.fill(&mut self.packed, size, "a packed array")?;
            self.plain.clear();
            self.plain.resize(count * self.value.components * stored.size(), 0);
            let unpack = if self.compression.blosc { blosc::unpack } else { inflate };
            unpack(&self.packed, &mut self.plain).map_err(|problem| stream.error_at(start, problem))?;
        } else {
            stream.fill(&mut self.plain, size, "an array of values")?;
        }
        stored.decode(&self.plain, to);
        Ok(())
    }

    fn negative(&self) -> [f32; COMPONENTS] {
        match self.value.number {
            Number::Bool | Number::Mask => self.background.map(|x| 1.0 - x),
            _ => self.background.map(|x| -x),
        }
    }
}
