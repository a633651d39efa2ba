//! A sparse grid in memory.

use crate::{MetadataMap, Storage, Transform, Values};

/// Voxels along a brick's edge.
pub const BRICK_EDGE: i32 = 8;

/// Voxels of a brick.
pub const BRICK_VOXELS: usize = 512;

/// What a grid stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GridClass {
    /// Nothing is said of it.
    Unknown,
    /// Signed distances to a surface, in world units.
    LevelSet,
    /// Densities and the like.
    FogVolume,
    /// Vectors whose components stand on the faces of voxels.
    Staggered,
    /// Another class of NanoVDB's: topology, indices, points and the like.
    Other,
}

impl GridClass {
    pub(crate) fn named(name: &str) -> Self {
        match name {
            "level set" => Self::LevelSet,
            "fog volume" => Self::FogVolume,
            "staggered" => Self::Staggered,
            _ => Self::Unknown,
        }
    }

    /// OpenVDB's word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::LevelSet => "level set",
            Self::FogVolume => "fog volume",
            Self::Staggered => "staggered",
            Self::Other => "other",
        }
    }
}

/// A cube of 8³ voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Brick {
    /// The voxel of the least coordinates, multiples of 8.
    pub origin: [i32; 3],
    /// Which voxels are active: word x, bit `8 y + z`.
    pub active: [u64; 8],
}

/// A cube of voxels of one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// The voxel of the least coordinates, multiples of the edge.
    pub origin: [i32; 3],
    /// The edge in voxels as a power of two: 3 (8), 7 (128) or 12 (4096).
    pub log2_edge: u8,
    /// Whether its voxels are active.
    pub active: bool,
    /// The value; a scalar stands in all three places.
    pub value: [f32; 3],
}

/// A sparse grid: bricks, tiles and, everywhere else, the background.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Its name, such as `density`.
    pub name: String,
    /// What it stands for.
    pub class: GridClass,
    /// From index space to the world.
    pub transform: Transform,
    /// The value where there is neither brick nor tile; a scalar stands in all three places.
    pub background: [f32; 3],
    /// The bricks, in the order of the file's tree.
    pub bricks: Vec<Brick>,
    /// 512 voxels for each brick. Inactive voxels have values, too: inside and outside of a level set are told by their sign.
    pub values: Values,
    /// Tiles, except inactive ones of the background's value.
    pub tiles: Vec<Tile>,
    /// What the file says of the grid.
    pub metadata: MetadataMap,
}

/// Bytes of a grid of so many bricks and tiles.
pub(crate) fn bytes(bricks: u64, tiles: u64, storage: Storage) -> u64 {
    bricks * (size_of::<Brick>() as u64 + BRICK_VOXELS as u64 * storage.bytes()) + tiles * size_of::<Tile>() as u64
}

impl Grid {
    /// Bytes of its bricks, voxels and tiles.
    pub fn memory(&self) -> u64 {
        bytes(self.bricks.len() as u64, self.tiles.len() as u64, self.values.storage())
    }

    /// How many voxels are active.
    pub fn active_voxels(&self) -> u64 {
        self.extent().active
    }

    /// The least and the greatest index of active voxels, both within; nothing if none is active.
    pub fn bounds(&self) -> Option<[[i32; 3]; 2]> {
        self.extent().bounds()
    }

    /// Voxels that are not finite numbers, tiles counted as one each.
    pub fn not_finite(&self) -> u64 {
        let voxels = match &self.values {
            Values::Float(values) => values.iter().filter(|x| !x.is_finite()).count(),
            Values::Half(values) => values.iter().filter(|x| !x.is_finite()).count(),
            Values::Vector(values) => values.iter().filter(|v| !v.iter().all(|x| x.is_finite())).count(),
        };
        let tiles = self.tiles.iter().filter(|tile| !tile.value.iter().all(|x| x.is_finite())).count();
        voxels as u64 + tiles as u64
    }

    fn extent(&self) -> Extent {
        let mut extent = Extent::default();
        self.bricks.iter().for_each(|brick| extent.add_brick(brick));
        self.tiles.iter().for_each(|tile| extent.add_tile(tile));
        extent
    }
}

/// The active voxels' number and bounds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) active: u64,
    min: [i32; 3],
    max: [i32; 3],
}

impl Default for Extent {
    fn default() -> Self {
        Self { active: 0, min: [i32::MAX; 3], max: [i32::MIN; 3] }
    }
}

impl Extent {
    pub(crate) fn bounds(&self) -> Option<[[i32; 3]; 2]> {
        (self.active > 0).then_some([self.min, self.max])
    }

    pub(crate) fn add_brick(&mut self, brick: &Brick) {
        self.active += brick.active.iter().map(|word| u64::from(word.count_ones())).sum::<u64>();
        let planes = brick.active.iter().enumerate().fold(0u8, |bits, (x, word)| bits | (u8::from(*word != 0) << x));
        let merged = brick.active.iter().fold(0, |bits, word| bits | word).to_le_bytes();
        let rows = merged.iter().enumerate().fold(0u8, |bits, (y, row)| bits | (u8::from(*row != 0) << y));
        let columns = merged.iter().fold(0, |bits, row| bits | row);
        if planes == 0 {
            return;
        }
        let bits = [planes, rows, columns];
        let min = std::array::from_fn(|axis| brick.origin[axis] + bits[axis].trailing_zeros() as i32);
        let max = std::array::from_fn(|axis| brick.origin[axis] + 7 - bits[axis].leading_zeros() as i32);
        self.add_box(min, max);
    }

    pub(crate) fn add_tile(&mut self, tile: &Tile) {
        if tile.active {
            self.active = self.active.saturating_add(1 << (3 * tile.log2_edge));
            self.add_box(tile.origin, tile.origin.map(|x| x + ((1 << tile.log2_edge) - 1)));
        }
    }

    fn add_box(&mut self, min: [i32; 3], max: [i32; 3]) {
        for axis in 0..3 {
            self.min[axis] = self.min[axis].min(min[axis]);
            self.max[axis] = self.max[axis].max(max[axis]);
        }
    }
}
