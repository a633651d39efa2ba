//! Trees of OpenVDB: a root of any extent, nodes of 32³ and 16³ children, leaves of 8³ voxels.
//!
//! A tree comes in two parts: first the masks of all nodes, then the voxels of all leaves.

use super::packing::Unpacker;
use crate::grid::BRICK_VOXELS;
use crate::stream::Stream;
use crate::value::{COMPONENTS, Number};
use crate::{Brick, Result, Tile};
use std::collections::BTreeSet;

/// The configuration that is read; files with others are very rare.
pub(crate) const CONFIGURATION: &str = "_5_4_3";

/// What is told of a tree while its masks are read.
pub(crate) trait Visitor {
    /// A child of the root begins, whose voxels come in this order of their origins.
    fn root_child(&mut self, origin: [i32; 3]);
    fn leaf(&mut self, leaf: Brick);
    fn tile(&mut self, tile: Tile);
}

/// A level of nodes: `1 << log2` children along an edge, each of `1 << child` voxels.
#[derive(Clone, Copy)]
struct Level {
    log2: u8,
    child: u8,
}

const UPPER: Level = Level { log2: 5, child: 7 };
const LOWER: Level = Level { log2: 4, child: 3 };

/// Reads the masks and tiles of a tree.
pub(crate) fn topology(stream: &mut Stream, unpacker: &mut Unpacker, visitor: &mut dyn Visitor) -> Result<()> {
    let buffers = stream.i32()?;
    if buffers != 1 {
        return Err(stream.error(format!("a tree with {buffers} buffers, expected 1")));
    }
    unpacker.background = unpacker.one(stream)?;
    let (tiles, children) = (stream.u32()?, stream.u32()?);
    stream.expect(u64::from(tiles) * (13 + unpacker.value.size() as u64), "the tiles of the root")?;
    stream.expect(u64::from(children) * (12 + 2 * 4096), "the children of the root")?;
    let mut taken = BTreeSet::new();
    for _ in 0..tiles {
        let origin = root_origin(stream, &mut taken)?;
        let value = unpacker.one(stream)?;
        let active = stream.u8()? != 0;
        tell_tile(unpacker, Tile { origin, log2_edge: 12, active, value: splat(value, unpacker.value.components) }, visitor);
    }
    for _ in 0..children {
        let origin = root_origin(stream, &mut taken)?;
        visitor.root_child(origin);
        upper(stream, unpacker, origin, visitor)?;
    }
    Ok(())
}

fn root_origin(stream: &mut Stream, taken: &mut BTreeSet<[i32; 3]>) -> Result<[i32; 3]> {
    let start = stream.position();
    let origin = stream.coordinate()?;
    if origin.iter().any(|x| x & 4095 != 0) {
        return Err(stream.error_at(start, format!("a node at {origin:?}, which are not multiples of 4096")));
    }
    if !taken.insert(origin) {
        return Err(stream.error_at(start, format!("two nodes at {origin:?}")));
    }
    Ok(origin)
}

fn upper(stream: &mut Stream, unpacker: &mut Unpacker, origin: [i32; 3], visitor: &mut dyn Visitor) -> Result<()> {
    let children: [u64; 512] = stream.mask()?;
    let active: [u64; 512] = stream.mask()?;
    node(stream, unpacker, UPPER, origin, (&children, &active), visitor)?;
    for child in bits(&children) {
        lower(stream, unpacker, UPPER.place(origin, child), visitor)?;
    }
    Ok(())
}

fn lower(stream: &mut Stream, unpacker: &mut Unpacker, origin: [i32; 3], visitor: &mut dyn Visitor) -> Result<()> {
    let children: [u64; 64] = stream.mask()?;
    let active: [u64; 64] = stream.mask()?;
    node(stream, unpacker, LOWER, origin, (&children, &active), visitor)?;
    for child in bits(&children) {
        visitor.leaf(Brick { origin: LOWER.place(origin, child), active: stream.mask()? });
    }
    Ok(())
}

/// The tiles of a node: its values where it has no child.
fn node(
    stream: &mut Stream,
    unpacker: &mut Unpacker,
    level: Level,
    origin: [i32; 3],
    (children, active): (&[u64], &[u64]),
    visitor: &mut dyn Visitor,
) -> Result<()> {
    let places = 1usize << (3 * level.log2);
    let child_count: usize = children.iter().map(|word| word.count_ones() as usize).sum();
    // Before version 222 the places of children had no values.
    let dense = unpacker.version >= 222;
    let mut values = Vec::new();
    unpacker.values(stream, if dense { places } else { places - child_count }, active, &mut values)?;
    let components = unpacker.value.components;
    let without = children.iter().map(|word| !word).collect::<Vec<u64>>();
    for (rank, n) in bits(&without).enumerate() {
        let at = if dense { n } else { rank } * components;
        let mut value = [0.0; COMPONENTS];
        value[..components].copy_from_slice(&values[at..at + components]);
        let is_active = active[n / 64] >> (n % 64) & 1 != 0;
        let tile = Tile { origin: level.place(origin, n), log2_edge: level.child, active: is_active, value: splat(value, components) };
        tell_tile(unpacker, tile, visitor);
    }
    Ok(())
}

fn tell_tile(unpacker: &Unpacker, tile: Tile, visitor: &mut dyn Visitor) {
    if tile.active || tile.value != splat(unpacker.background, unpacker.value.components) {
        visitor.tile(tile);
    }
}

/// A value as grids have it.
pub(crate) fn splat(value: [f32; COMPONENTS], components: usize) -> [f32; 3] {
    if components == 1 { [value[0]; 3] } else { [value[0], value[1], value[2]] }
}

impl Level {
    /// The origin of the child at a place: x slowest, z fastest.
    fn place(self, origin: [i32; 3], n: usize) -> [i32; 3] {
        let part = |shift: u8| ((n >> (shift * self.log2)) as i32 & ((1 << self.log2) - 1)) << self.child;
        [origin[0] + part(2), origin[1] + part(1), origin[2] + part(0)]
    }
}

/// The places of bits that are set, in order.
fn bits(words: &[u64]) -> impl Iterator<Item = usize> {
    words.iter().enumerate().flat_map(|(index, word)| {
        let mut rest = *word;
        std::iter::from_fn(move || {
            let bit = (rest != 0).then(|| rest.trailing_zeros() as usize)?;
            rest &= rest - 1;
            Some(64 * index + bit)
        })
    })
}

/// The voxels of one leaf, one component after another, in place of what `to` held; its active mask.
pub(crate) fn leaf(stream: &mut Stream, unpacker: &mut Unpacker, origin: [i32; 3], to: &mut Vec<f32>) -> Result<[u64; 8]> {
    let active: [u64; 8] = stream.mask()?;
    let buffers = leaf_header(stream, unpacker, Some(origin))?;
    match unpacker.value.number {
        Number::Bool => {
            let on: [u64; 8] = stream.mask()?;
            unfold(&on, to);
        }
        Number::Mask => unfold(&active, to),
        _ => unpacker.values(stream, BRICK_VOXELS, &active, to)?,
    }
    for _ in 1..buffers {
        unpacker.skip_auxiliary(stream, BRICK_VOXELS)?;
    }
    Ok(active)
}

fn unfold(on: &[u64; 8], to: &mut Vec<f32>) {
    to.clear();
    to.extend((0..BRICK_VOXELS).map(|n| f32::from(on[n / 64] >> (n % 64) & 1 != 0)));
}

/// Goes past one leaf.
pub(crate) fn skip_leaf(stream: &mut Stream, unpacker: &mut Unpacker) -> Result<()> {
    let active: [u64; 8] = stream.mask()?;
    let buffers = leaf_header(stream, unpacker, None)?;
    match unpacker.value.number {
        Number::Bool => stream.skip(64)?,
        Number::Mask => {}
        _ => unpacker.skip(stream, BRICK_VOXELS, &active)?,
    }
    for _ in 1..buffers {
        unpacker.skip_auxiliary(stream, BRICK_VOXELS)?;
    }
    Ok(())
}

/// Leaves of yes and no, and all of files before version 222, tell their origin again; the latter a number of buffers, too.
fn leaf_header(stream: &mut Stream, unpacker: &Unpacker, expected: Option<[i32; 3]>) -> Result<u8> {
    let binary = matches!(unpacker.value.number, Number::Bool | Number::Mask);
    if unpacker.version >= 222 && !binary {
        return Ok(1);
    }
    let start = stream.position();
    let origin = stream.coordinate()?;
    if expected.is_some_and(|expected| expected != origin) {
        return Err(stream.error_at(start, format!("a leaf at {origin:?}, expected {expected:?}")));
    }
    if binary {
        return Ok(1);
    }
    let buffers = stream.u8()?;
    if buffers == 0 || buffers > 127 {
        return Err(stream.error(format!("a leaf with {} buffers", buffers as i8)));
    }
    Ok(buffers)
}
