//! Volume grids: a reader of OpenVDB's and NanoVDB's files, a writer of OpenVDB's, and what both give.
//!
//! A [`Grid`] is sparse: bricks of 8³ voxels, tiles of one value, and a background. Index points are the *centres* of voxels, as in OpenVDB:
//! voxel (i, j, k) is the cube of edge 1 about (i, j, k), and [`Transform`] leads from there to the world. A host whose voxels have their
//! values at the corner of least coordinates adds half a voxel to each index.
//!
//! [`open`] lists the grids of a file without their voxels; [`VolumeFile::read`] reads one. [`Sampler`] looks values up.
//! [`Grid::from_dense`] makes a grid of an array, [`write()`] makes a file of grids.
//!
//! Files are nobody's friends: each count that a file states is checked against its size before anything is allocated, listing takes memory for
//! nothing that the file does not hold, and no bytes make a panic. A grid's memory is known before it is read.

#![forbid(unsafe_code)]

mod blosc;
mod dense;
mod error;
mod file;
mod grid;
mod inflate;
mod info;
mod metadata;
mod nano;
mod sample;
mod stream;
mod transform;
mod value;
mod vdb;

pub use error::{Result, VolumeError};
pub use file::{VolumeFile, from_bytes, is_volume_file, open};
pub use grid::{BRICK_EDGE, BRICK_VOXELS, Brick, Grid, GridClass, Tile};
pub use info::GridInfo;
pub use metadata::{Metadata, MetadataMap};
pub use sample::{BrickRange, Sampler};
pub use transform::Transform;
pub use value::{Storage, Values};
pub use vdb::write::{Packing, to_bytes, write};
