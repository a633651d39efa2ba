//! The nodes of a tree that is written.

use crate::grid::BRICK_VOXELS;
use crate::{Brick, Grid, Tile};
use std::collections::BTreeMap;

/// A place of the tree: nodes below, a tile, or a brick by its number.
pub(super) enum Node<'a> {
    Upper(BTreeMap<usize, Node<'a>>),
    Lower(BTreeMap<usize, Node<'a>>),
    Brick(usize, &'a Brick),
    Tile(&'a Tile),
}

/// The nodes over a grid's bricks and tiles.
pub(super) fn tree(grid: &Grid) -> std::result::Result<BTreeMap<[i32; 3], Node<'_>>, String> {
    let mut root = BTreeMap::new();
    if grid.values.len() != grid.bricks.len() * BRICK_VOXELS {
        return Err(format!("{} voxels in {} bricks of 512", grid.values.len(), grid.bricks.len()));
    }
    for (n, brick) in grid.bricks.iter().enumerate() {
        insert(&mut root, brick.origin, 3, Node::Brick(n, brick))?;
    }
    for tile in &grid.tiles {
        insert(&mut root, tile.origin, tile.log2_edge, Node::Tile(tile))?;
    }
    Ok(root)
}

fn insert<'a>(root: &mut BTreeMap<[i32; 3], Node<'a>>, origin: [i32; 3], log2: u8, node: Node<'a>) -> std::result::Result<(), String> {
    if !matches!(log2, 3 | 7 | 12) || origin.iter().any(|x| x & ((1 << log2) - 1) != 0) {
        return Err(format!("a brick or tile of edge 2^{log2} at {origin:?}; edges are 8, 128 and 4096, places multiples of them"));
    }
    let twice = || format!("two bricks or tiles at {origin:?}");
    let place = |bits: u32, shift: u32| {
        let part = |x: i32| (x >> shift) as usize & ((1 << bits) - 1);
        part(origin[0]) << (2 * bits) | part(origin[1]) << bits | part(origin[2])
    };
    let key = origin.map(|x| x & !4095);
    if log2 == 12 {
        return if root.insert(key, node).is_none() { Ok(()) } else { Err(twice()) };
    }
    let Node::Upper(upper) = root.entry(key).or_insert_with(|| Node::Upper(BTreeMap::new())) else {
        return Err(twice());
    };
    if log2 == 7 {
        return if upper.insert(place(5, 7), node).is_none() { Ok(()) } else { Err(twice()) };
    }
    let Node::Lower(lower) = upper.entry(place(5, 7)).or_insert_with(|| Node::Lower(BTreeMap::new())) else {
        return Err(twice());
    };
    if lower.insert(place(4, 3), node).is_none() { Ok(()) } else { Err(twice()) }
}
