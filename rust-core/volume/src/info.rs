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

    /// The least and the greatest coordinates in the world of the active voxels' cubes; nothing if none is active or the transform is not affine.
    pub fn world_bounds(&self) -> Option<[[f64; 3]; 2]> {
        let ([min, max], transform) = (self.bounds?, self.transform?);
        let corners = (0..8).map(|corner| {
            let edge = |axis: usize| if corner >> axis & 1 == 1 { f64::from(max[axis]) + 0.5 } else { f64::from(min[axis]) - 0.5 };
            transform.point([edge(0), edge(1), edge(2)])
        });
        let empty = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        Some(corners.fold(empty, |[low, high], point| {
            let pick = |bound: [f64; 3], f: fn(f64, f64) -> f64| std::array::from_fn(|axis| f(bound[axis], point[axis]));
            [pick(low, f64::min), pick(high, f64::max)]
        }))
    }
}
