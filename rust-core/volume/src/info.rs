//! What is known of a grid before its voxels are read.

use crate::{GridClass, MetadataMap, Storage, Transform};

/// A grid of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct GridInfo {
    /// Its name. Several grids of a file may have the same.
    pub name: String,
    /// The type of its voxels, by OpenVDB's or NanoVDB's word: `float`, `vec3s`, `Fp8`; `float (half)` for numbers saved as halves.
    pub value_type: String,
    /// What it stands for.
    pub class: GridClass,
    /// How [`crate::VolumeFile::read`] holds its voxels.
    pub storage: Storage,
    /// How many voxels are active, those of tiles counted.
    pub active_voxels: u64,
    /// The least and the greatest index of active voxels, both within; nothing if none is active.
    pub bounds: Option<[[i32; 3]; 2]>,
    /// From index space to the world; nothing where it is not affine.
    pub transform: Option<Transform>,
    /// How the voxels are packed, in words.
    pub compression: String,
    /// Bricks of 8³ voxels.
    pub bricks: u64,
    /// Tiles, except inactive ones of the background's value.
    pub tiles: u64,
    /// Bytes that the grid takes in memory.
    pub memory: u64,
    /// The name of the grid of the file whose voxels it shares.
    pub instance_of: Option<String>,
    /// What the file says of it.
    pub metadata: MetadataMap,
    /// Why it cannot be read, if so.
    pub refused: Option<String>,
}

impl GridInfo {
    pub(crate) fn new(name: String, value_type: String) -> Self {
        Self {
            name,
            value_type,
            class: GridClass::Unknown,
            storage: Storage::Float,
            active_voxels: 0,
            bounds: None,
            transform: None,
            compression: String::new(),
            bricks: 0,
            tiles: 0,
            memory: 0,
            instance_of: None,
            metadata: MetadataMap::new(),
            refused: None,
        }
    }
}
