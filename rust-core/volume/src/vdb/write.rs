//! Writes OpenVDB files of version 224, which all programs of the last ten years read.

use super::nodes::{Node, tree};
use super::packing::Compression;
use super::tree::CONFIGURATION;
use super::{HALF_SUFFIX, MAGIC, SEPARATOR};
use crate::grid::BRICK_VOXELS;
use crate::metadata::encode;
use crate::{Brick, Grid, Metadata, Result, Tile, Values, VolumeError};
use miniz_oxide::deflate::compress_to_vec_zlib;
use std::collections::BTreeMap;
use std::path::Path;

/// How voxels are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    /// As they are: read fastest.
    None,
    /// zlib streams of active voxels.
    Zip,
}

/// Writes grids to a file.
///
/// # Errors
///
/// As [`to_bytes`], and if the file cannot be written.
pub fn write(path: impl AsRef<Path>, grids: &[&Grid], packing: Packing) -> Result<()> {
    let path = path.as_ref();
    let name = path.to_string_lossy();
    let bytes = to_bytes(grids, packing).map_err(|error| VolumeError::whole(&name, error.to_string()))?;
    std::fs::write(path, bytes).map_err(|error| VolumeError::whole(&name, format!("cannot be written: {error}")))
}

/// The bytes of a file of grids.
///
/// # Errors
///
/// If a grid's transform is of no use, or two of its bricks and tiles, or these and their places, do not fit.
pub fn to_bytes(grids: &[&Grid], packing: Packing) -> Result<Vec<u8>> {
    let mut file = Writer { bytes: MAGIC.to_vec(), packing };
    // The version of files, and that of the library that introduced it.
    [224u32, 12, 0].iter().for_each(|word| file.word(*word));
    file.bytes.push(1);
    file.bytes.extend(b"00000000-0000-0000-0000-000000000000");
    file.word(0);
    file.word(grids.len() as u32);
    for (index, grid) in grids.iter().enumerate() {
        let same = |other: &&&Grid| other.name == grid.name;
        let earlier = grids[..index].iter().filter(same).count();
        let unique = grid.name.is_empty() || grids.iter().filter(same).count() > 1;
        let name = if unique { format!("{}{SEPARATOR}{earlier}", grid.name) } else { grid.name.clone() };
        file.grid(grid, &name)?;
    }
    Ok(file.bytes)
}

struct Writer {
    bytes: Vec<u8>,
    packing: Packing,
}

impl Writer {
    fn word(&mut self, word: u32) {
        self.bytes.extend(word.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.word(text.len() as u32);
        self.bytes.extend(text.as_bytes());
    }

    fn reals(&mut self, reals: &[f64]) {
        reals.iter().for_each(|real| self.bytes.extend(real.to_le_bytes()));
    }

    fn coordinate(&mut self, coordinate: [i32; 3]) {
        coordinate.iter().for_each(|x| self.bytes.extend(x.to_le_bytes()));
    }

    fn mask(&mut self, words: &[u64]) {
        words.iter().for_each(|word| self.bytes.extend(word.to_le_bytes()));
    }

    fn compression(&self) -> Compression {
        let zip = self.packing == Packing::Zip;
        Compression { zip, active_mask: zip, blosc: false }
    }

    fn grid(&mut self, grid: &Grid, unique: &str) -> Result<()> {
        let wrong = |problem| VolumeError::whole(&format!("grid '{}'", grid.name), problem);
        if let Some(problem) = grid.transform.problem() {
            return Err(wrong(problem));
        }
        let root = tree(grid).map_err(wrong)?;
        self.text(unique);
        let (kind, half) = match &grid.values {
            Values::Float(_) => ("float", ""),
            Values::Half(_) => ("float", HALF_SUFFIX),
            Values::Vector(_) => ("vec3s", ""),
        };
        self.text(&format!("Tree_{kind}{CONFIGURATION}{half}"));
        self.text("");
        let places = self.bytes.len();
        self.reals(&[0.0; 3]);
        let start = self.bytes.len();
        self.word(self.compression().flags());
        self.metadata(grid);
        self.text("AffineMap");
        grid.transform.0.iter().for_each(|row| self.reals(row));
        self.topology(grid, &root);
        let voxels = self.bytes.len();
        self.voxels(grid, &root);
        for (n, place) in [start, voxels, self.bytes.len()].into_iter().enumerate() {
            self.bytes[places + 8 * n..][..8].copy_from_slice(&(place as u64).to_le_bytes());
        }
        Ok(())
    }

    /// The grid's own entries, but those that follow from it.
    fn metadata(&mut self, grid: &Grid) {
        let follows = |name: &str| name.starts_with("file_") || matches!(name, "name" | "class" | "is_saved_as_half_float");
        let mut entries: Vec<(&str, Metadata)> = vec![("name", Metadata::Text(grid.name.clone()))];
        if grid.class.name() != "other" {
            entries.push(("class", Metadata::Text(grid.class.name().into())));
        }
        if matches!(grid.values, Values::Half(_)) {
            entries.push(("is_saved_as_half_float", Metadata::Flag(true)));
        }
        entries.push(("file_voxel_count", Metadata::Integer(grid.active_voxels() as i64)));
        if let Some([min, max]) = grid.bounds() {
            entries.push(("file_bbox_min", Metadata::Integers(min.into())));
            entries.push(("file_bbox_max", Metadata::Integers(max.into())));
        }
        let own = grid.metadata.iter().filter(|(name, value)| !follows(name) && !matches!(value, Metadata::Other(..)));
        entries.extend(own.map(|(name, value)| (name.as_str(), value.clone())));
        self.word(entries.len() as u32);
        for (name, value) in entries {
            self.text(name);
            let (kind, bytes) = encode(&value);
            self.text(kind);
            self.word(bytes.len() as u32);
            self.bytes.extend(bytes);
        }
    }

    fn topology(&mut self, grid: &Grid, root: &BTreeMap<[i32; 3], Node>) {
        // The number of buffers.
        self.word(1);
        self.value(grid, grid.background);
        let tiles = root.values().filter_map(|node| if let Node::Tile(tile) = node { Some(*tile) } else { None });
        let tiles: Vec<&Tile> = tiles.collect();
        self.word(tiles.len() as u32);
        self.word((root.len() - tiles.len()) as u32);
        for tile in tiles {
            self.coordinate(tile.origin);
            self.value(grid, tile.value);
            self.bytes.push(tile.active.into());
        }
        for (origin, node) in root {
            if let Node::Upper(children) = node {
                self.coordinate(*origin);
                self.node(grid, children, 1 << 15);
            }
        }
    }

    /// A node's masks and tiles, then its children.
    fn node(&mut self, grid: &Grid, children: &BTreeMap<usize, Node>, places: usize) {
        let (mut below, mut active) = (vec![0u64; places / 64], vec![0u64; places / 64]);
        let mut values = vec![grid.background; places];
        for (n, child) in children {
            match child {
                Node::Tile(tile) => {
                    values[*n] = tile.value;
                    active[n / 64] |= u64::from(tile.active) << (n % 64);
                }
                _ => below[n / 64] |= 1 << (n % 64),
            }
        }
        self.mask(&below);
        self.mask(&active);
        // All values are stored, whether active or not.
        self.bytes.push(6);
        let mut bytes = Vec::new();
        values.iter().for_each(|value| encode_value(&grid.values, *value, &mut bytes));
        self.array(&bytes);
        for child in children.values() {
            match child {
                Node::Lower(children) | Node::Upper(children) => self.node(grid, children, 1 << 12),
                Node::Brick(_, brick) => self.mask(&brick.active),
                Node::Tile(_) => {}
            }
        }
    }

    fn voxels(&mut self, grid: &Grid, nodes: &BTreeMap<impl Ord, Node>) {
        for node in nodes.values() {
            match node {
                Node::Upper(children) | Node::Lower(children) => self.voxels(grid, children),
                Node::Brick(n, brick) => self.brick(grid, *n, brick),
                Node::Tile(_) => {}
            }
        }
    }

    fn brick(&mut self, grid: &Grid, n: usize, brick: &Brick) {
        let is_active = |n: &usize| brick.active[n / 64] >> (n % 64) & 1 != 0;
        let value = |place: usize| grid.values.get(n * BRICK_VOXELS + place);
        let plain = (0..BRICK_VOXELS).filter(|n| !is_active(n)).all(|n| value(n).map(f32::to_bits) == grid.background.map(f32::to_bits));
        let all = !self.compression().active_mask || !plain;
        self.mask(&brick.active);
        // Inactive voxels are the background, or everything is stored.
        self.bytes.push(if all { 6 } else { 0 });
        let mut bytes = Vec::new();
        (0..BRICK_VOXELS).filter(|n| all || is_active(n)).for_each(|n| encode_value(&grid.values, value(n), &mut bytes));
        if !bytes.is_empty() || matches!(grid.values, Values::Float(_) | Values::Vector(_)) {
            self.array(&bytes);
        }
    }

    /// An array of a node, packed if that makes it shorter.
    fn array(&mut self, bytes: &[u8]) {
        if self.packing == Packing::Zip {
            let packed = compress_to_vec_zlib(bytes, 6);
            let shorter = packed.len() < bytes.len();
            let size = if shorter { packed.len() as i64 } else { -(bytes.len() as i64) };
            self.bytes.extend(size.to_le_bytes());
            self.bytes.extend(if shorter { &packed } else { bytes });
        } else {
            self.bytes.extend(bytes);
        }
    }

    /// A value in full, whatever the voxels are stored as.
    fn value(&mut self, grid: &Grid, value: [f32; 3]) {
        let components = if matches!(grid.values, Values::Vector(_)) { 3 } else { 1 };
        value[..components].iter().for_each(|x| self.bytes.extend(x.to_le_bytes()));
    }
}

fn encode_value(values: &Values, value: [f32; 3], to: &mut Vec<u8>) {
    match values {
        Values::Float(_) => to.extend(value[0].to_le_bytes()),
        Values::Half(_) => to.extend(half::f16::from_f32(value[0]).to_le_bytes()),
        Values::Vector(_) => value.iter().for_each(|x| to.extend(x.to_le_bytes())),
    }
}
