//! Where a grid's block has what, by the type of its values. Structures are laid out as C++ does, and begin at multiples of 32 bytes.

use crate::grid::BRICK_VOXELS;
use crate::value::{Number, Storage};

/// The voxels of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Voxels {
    /// As numbers.
    Plain,
    /// As so many bits each, of a range of the leaf's own.
    Quantised(u32),
    /// As bits whose number the leaf tells.
    Variable,
    /// As a mask of values.
    Bits,
    /// None: the active mask is all there is.
    Mask,
}

/// The type of a grid's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) number: Number,
    pub(crate) components: usize,
    pub(crate) voxels: Voxels,
}

/// The types' names by their numbers in files.
const NAMES: [&str; 27] = [
    "unknown",
    "float",
    "double",
    "int16",
    "int32",
    "int64",
    "Vec3f",
    "Vec3d",
    "mask",
    "half",
    "uint32",
    "bool",
    "RGBA8",
    "Fp4",
    "Fp8",
    "Fp16",
    "FpN",
    "Vec4f",
    "Vec4d",
    "Index",
    "OnIndex",
    "IndexMask",
    "OnIndexMask",
    "PointIndex",
    "Vec3u8",
    "Vec3u16",
    "uint8",
];

/// Before masks and statistics: the box and flags of inner nodes; that of leaves is half as long.
const NODE_HEADER: usize = 32;
const LEAF_HEADER: usize = 16;

pub(crate) fn name(kind: u32) -> String {
    NAMES.get(kind as usize).map_or_else(|| format!("type {kind}"), |name| (*name).into())
}

impl Layout {
    pub(crate) fn of_type(kind: u32) -> Option<Self> {
        let (number, components, voxels) = match kind {
            1 => (Number::Float, 1, Voxels::Plain),
            2 => (Number::Double, 1, Voxels::Plain),
            3 => (Number::Int16, 1, Voxels::Plain),
            4 => (Number::Int32, 1, Voxels::Plain),
            5 => (Number::Int64, 1, Voxels::Plain),
            6 => (Number::Float, 3, Voxels::Plain),
            7 => (Number::Double, 3, Voxels::Plain),
            8 => (Number::Mask, 1, Voxels::Mask),
            10 => (Number::Uint32, 1, Voxels::Plain),
            11 => (Number::Bool, 1, Voxels::Bits),
            13 => (Number::Float, 1, Voxels::Quantised(4)),
            14 => (Number::Float, 1, Voxels::Quantised(8)),
            15 => (Number::Float, 1, Voxels::Quantised(16)),
            16 => (Number::Float, 1, Voxels::Variable),
            26 => (Number::Uint8, 1, Voxels::Plain),
            _ => return None,
        };
        Some(Self { number, components, voxels })
    }

    pub(crate) fn storage(self) -> Storage {
        if self.components == 3 { Storage::Vector } else { Storage::Float }
    }

    pub(crate) fn value_size(self) -> usize {
        self.number.size() * self.components
    }

    /// The size of means and deviations: of bytes for yes and no.
    fn statistic(self) -> usize {
        match self.number {
            Number::Bool | Number::Mask => 1,
            number => number.size().max(4),
        }
    }

    /// Where so many values and two statistics from `start` on end, and the next structure begins.
    fn after(self, start: usize, values: usize) -> usize {
        let values_end = start.next_multiple_of(self.number.size()) + values * self.value_size();
        (values_end.next_multiple_of(self.statistic()) + 2 * self.statistic()).next_multiple_of(32)
    }

    pub(crate) fn root_background(self) -> usize {
        28usize.next_multiple_of(self.number.size())
    }

    pub(crate) fn root_table(self) -> usize {
        self.after(28, 3)
    }

    /// The value in an entry of the root's table, after its key, child and state.
    pub(crate) fn root_tile_value(self) -> usize {
        20usize.next_multiple_of(self.number.size())
    }

    pub(crate) fn root_tile(self) -> usize {
        (self.root_tile_value() + self.value_size()).next_multiple_of(32)
    }

    /// The table of an inner node of so many places.
    pub(crate) fn table(self, places: usize) -> usize {
        self.after(NODE_HEADER + 2 * places / 8, 2)
    }

    /// An entry of that table: a value or the distance of a child.
    pub(crate) fn entry(self) -> usize {
        self.value_size().max(8).next_multiple_of(8)
    }

    /// The voxels of a leaf; those of quantised ones follow the least value, the step and four small statistics.
    pub(crate) fn leaf_voxels(self) -> usize {
        let start = LEAF_HEADER + BRICK_VOXELS / 8;
        match self.voxels {
            Voxels::Plain => self.after(start, 2),
            Voxels::Quantised(_) | Voxels::Variable => 96,
            Voxels::Bits | Voxels::Mask => start,
        }
    }

    /// The size of a leaf whose voxels have so many bits.
    pub(crate) fn leaf(self, bits: u32) -> usize {
        let voxels = match self.voxels {
            Voxels::Plain => BRICK_VOXELS * self.value_size(),
            Voxels::Quantised(_) | Voxels::Variable => BRICK_VOXELS / 8 * bits as usize,
            // A mask of values and 16 bytes, or these alone.
            Voxels::Bits => 64 + 16,
            Voxels::Mask => 16,
        };
        self.leaf_voxels() + voxels
    }
}
