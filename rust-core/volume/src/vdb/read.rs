//! The voxels of one grid.

use super::list::{Entry, Listing};
use super::packing::Unpacker;
use super::tree::{self, Visitor, splat};
use crate::grid::BRICK_VOXELS;
use crate::stream::Stream;
use crate::{Brick, Grid, Result, Tile, Transform, Values};

/// Reads a grid that the listing does not refuse.
pub(crate) fn read(stream: &mut Stream, listing: &Listing, entry: &Entry, transform: Transform) -> Result<Grid> {
    let info = &entry.info;
    let (Some(place), Some(storage)) = (entry.tree, entry.tree.and_then(|place| place.value.storage())) else {
        return Err(stream.error("a grid without a tree"));
    };
    stream.seek(place.start)?;
    stream.limit(place.end);
    let mut unpacker = Unpacker::new(place.value, listing.version, place.compression);
    let mut collected =
        Collector { bricks: Vec::with_capacity(info.bricks as usize), tiles: Vec::with_capacity(info.tiles as usize), roots: Vec::new() };
    tree::topology(stream, &mut unpacker, &mut collected)?;
    let mut bricks = collected.in_order();
    let mut values = Values::with_capacity(storage, bricks.len() * BRICK_VOXELS);
    let mut numbers = Vec::new();
    for brick in &mut bricks {
        brick.active = tree::leaf(stream, &mut unpacker, brick.origin, &mut numbers)?;
        values.push(&numbers);
    }
    Ok(Grid {
        name: info.name.clone(),
        class: info.class,
        transform,
        background: splat(unpacker.background, place.value.components),
        bricks,
        values,
        tiles: collected.tiles,
        metadata: info.metadata.clone(),
    })
}

struct Collector {
    bricks: Vec<Brick>,
    tiles: Vec<Tile>,
    /// The children of the root, and their first bricks.
    roots: Vec<([i32; 3], usize)>,
}

impl Collector {
    /// The bricks in the order of their voxels: that of the origins of the root's children, whatever the order of the masks.
    fn in_order(&mut self) -> Vec<Brick> {
        if self.roots.is_sorted() {
            return std::mem::take(&mut self.bricks);
        }
        let ends = self.roots.iter().skip(1).map(|root| root.1).chain([self.bricks.len()]);
        let mut ranges: Vec<_> = self.roots.iter().zip(ends).map(|((origin, start), end)| (*origin, *start..end)).collect();
        ranges.sort_by_key(|range| range.0);
        ranges.into_iter().flat_map(|(_, range)| self.bricks[range].to_vec()).collect()
    }
}

impl Visitor for Collector {
    fn root_child(&mut self, origin: [i32; 3]) {
        self.roots.push((origin, self.bricks.len()));
    }

    fn leaf(&mut self, leaf: Brick) {
        self.bricks.push(leaf);
    }

    fn tile(&mut self, tile: Tile) {
        self.tiles.push(tile);
    }
}
