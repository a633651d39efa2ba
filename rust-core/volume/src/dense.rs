//! Grids of arrays.

use crate::grid::BRICK_VOXELS;
use crate::{Brick, Grid, GridClass, MetadataMap, Result, Transform, Values, VolumeError};

impl Grid {
    /// A fog volume of an array of `shape` voxels, x slowest and z fastest, as numpy's arrays of shape `(nx, ny, nz)` lie. The background
    /// is 0, voxels of other values are active, and bricks of zeros are left out. Voxel (0, 0, 0) of the array is that of the grid.
    ///
    /// `transform` leads to the world; [`Transform::uniform`] takes the edge of a voxel and where the *centre* of voxel (0, 0, 0) lies. For
    /// an array whose corner lies at `c` that is `c` and half an edge.
    ///
    /// # Errors
    ///
    /// If the shape is not that of the values, a value is not finite or the transform is of no use.
    pub fn from_dense(name: &str, values: &[f32], shape: [usize; 3], transform: Transform) -> Result<Self> {
        let wrong = |problem: String| Err(VolumeError::whole(&format!("grid '{name}'"), problem));
        let count = shape.iter().try_fold(1usize, |product, n| product.checked_mul(*n));
        if count != Some(values.len()) {
            return wrong(format!("{} values, expected {} × {} × {}", values.len(), shape[0], shape[1], shape[2]));
        }
        if shape.iter().any(|n| *n > 1 << 30) {
            return wrong("more than 2³⁰ voxels along an axis".into());
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            let voxel = [at / (shape[1] * shape[2]), at / shape[2] % shape[1], at % shape[2]];
            return wrong(format!("the value at {voxel:?} is {}, expected a finite number", values[at]));
        }
        if let Some(problem) = transform.problem() {
            return wrong(problem);
        }
        let (bricks, voxels) = bricks(values, shape);
        Ok(Self {
            name: name.into(),
            class: GridClass::FogVolume,
            transform,
            background: [0.0; 3],
            bricks,
            values: Values::Float(voxels),
            tiles: Vec::new(),
            metadata: MetadataMap::new(),
        })
    }
}

fn bricks(values: &[f32], shape: [usize; 3]) -> (Vec<Brick>, Vec<f32>) {
    let (mut bricks, mut voxels) = (Vec::new(), Vec::new());
    let [nx, ny, nz] = shape.map(|n| n.div_ceil(8));
    for n in 0..nx * ny * nz {
        let origin = [n / (ny * nz), n / nz % ny, n % nz].map(|block| block * 8);
        let mut voxel = [0.0; BRICK_VOXELS];
        for (row, values_of_row) in voxel.chunks_exact_mut(8).enumerate() {
            let (x, y, z) = (origin[0] + row / 8, origin[1] + row % 8, origin[2]);
            if x < shape[0] && y < shape[1] {
                let length = (shape[2] - z).min(8);
                let start = (x * shape[1] + y) * shape[2] + z;
                values_of_row[..length].copy_from_slice(&values[start..start + length]);
            }
        }
        let mut active = [0u64; 8];
        voxel.iter().enumerate().filter(|(_, value)| **value != 0.0).for_each(|(n, _)| active[n / 64] |= 1 << (n % 64));
        if active != [0; 8] {
            bricks.push(Brick { origin: origin.map(|x| x as i32), active });
            voxels.extend(voxel);
        }
    }
    (bricks, voxels)
}
