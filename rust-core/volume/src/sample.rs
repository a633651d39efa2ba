//! Looking values up: in scalar code, to check others by.

use crate::grid::{BRICK_EDGE, BRICK_VOXELS};
use crate::{Brick, Grid, Tile};
use std::collections::{BTreeSet, HashMap};

/// The powers of two of tiles' edges, the finest first.
const TILE_LEVELS: [u8; 3] = [3, 7, 12];

/// Bounds of a brick's trilinear interpolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrickRange {
    /// The brick's voxel of least coordinates, multiples of 8.
    pub origin: [i32; 3],
    /// The least value of each component.
    pub min: [f32; 3],
    /// The greatest value of each component.
    pub max: [f32; 3],
}

/// Finds the bricks and tiles of a grid.
#[derive(Clone, Debug)]
pub struct Sampler<'a> {
    grid: &'a Grid,
    bricks: HashMap<[i32; 3], usize>,
    tiles: [HashMap<[i32; 3], usize>; 3],
}

#[derive(Clone, Copy)]
enum Block<'a> {
    Constant([f32; 3], bool),
    Brick(usize, &'a Brick),
}

impl<'a> Sampler<'a> {
    /// Makes the tables of places: about 32 bytes for each brick and tile.
    pub fn new(grid: &'a Grid) -> Self {
        let bricks = grid.bricks.iter().enumerate().map(|(n, brick)| (cell(brick.origin, 3), n)).collect();
        let tiles = TILE_LEVELS.map(|level| {
            let of_level = grid.tiles.iter().enumerate().filter(|(_, tile): &(usize, &Tile)| tile.log2_edge == level);
            of_level.map(|(n, tile)| (cell(tile.origin, level), n)).collect()
        });
        Self { grid, bricks, tiles }
    }

    fn block(&self, voxel: [i32; 3]) -> Block<'a> {
        let grid = self.grid;
        if let Some(n) = self.bricks.get(&cell(voxel, 3)) {
            return Block::Brick(*n, &grid.bricks[*n]);
        }
        let found = TILE_LEVELS.iter().zip(&self.tiles).find_map(|(level, tiles)| tiles.get(&cell(voxel, *level)));
        found.map_or(Block::Constant(grid.background, false), |n| Block::Constant(grid.tiles[*n].value, grid.tiles[*n].active))
    }

    /// The value of a voxel; a scalar stands in all three places.
    pub fn value(&self, voxel: [i32; 3]) -> [f32; 3] {
        match self.block(voxel) {
            Block::Constant(value, _) => value,
            Block::Brick(n, _) => self.grid.values.get(n * BRICK_VOXELS + offset(voxel)),
        }
    }

    /// Whether a voxel is active.
    pub fn is_active(&self, voxel: [i32; 3]) -> bool {
        match self.block(voxel) {
            Block::Constant(_, active) => active,
            Block::Brick(_, brick) => {
                let n = offset(voxel);
                brick.active[n / 64] >> (n % 64) & 1 != 0
            }
        }
    }

    /// The trilinear interpolation at a point of index space, between the eight voxels whose centres are about it.
    /// Points beyond 2³⁰ voxels, and such that are not numbers, have the background's value.
    pub fn trilinear(&self, point: [f64; 3]) -> [f64; 3] {
        const FAR: f64 = (1 << 30) as f64;
        if !point.iter().all(|x| x.abs() < FAR) {
            return self.grid.background.map(f64::from);
        }
        let low = point.map(|x| x.floor() as i32);
        let part: [f64; 3] = std::array::from_fn(|axis| point[axis] - point[axis].floor());
        let mut sum = [0.0; 3];
        for corner in 0..8 {
            let step: [i32; 3] = std::array::from_fn(|axis| corner >> axis & 1);
            let weight: f64 = (0..3).map(|axis| if step[axis] == 1 { part[axis] } else { 1.0 - part[axis] }).product();
            // A voxel that does not count may hold no number.
            if weight > 0.0 {
                let value = self.value(std::array::from_fn(|axis| low[axis] + step[axis]));
                (0..3).for_each(|c| sum[c] += weight * f64::from(value[c]));
            }
        }
        sum
    }

    /// The exact bounds of the trilinear interpolation between the centres of the voxels `origin` and `origin + 8`: of the block's own 8³
    /// voxels and one row of its neighbours on the side of greater coordinates. Voxels that are no numbers do not count; if there are only
    /// such, `min > max`.
    pub fn range(&self, origin: [i32; 3]) -> BrickRange {
        let mut range = BrickRange { origin, min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };
        let mut add = |value: [f32; 3]| {
            for (c, value) in value.into_iter().enumerate() {
                range.min[c] = range.min[c].min(value);
                range.max[c] = range.max[c].max(value);
            }
        };
        for step in 0..8 {
            let ahead: [bool; 3] = std::array::from_fn(|axis| step >> axis & 1 == 1);
            let block: [i32; 3] = std::array::from_fn(|axis| origin[axis].saturating_add(if ahead[axis] { BRICK_EDGE } else { 0 }));
            let count = ahead.map(|ahead| if ahead { 1 } else { BRICK_EDGE as usize });
            match self.block(block) {
                Block::Constant(value, _) => add(value),
                Block::Brick(n, _) => {
                    let row = |x, y| n * BRICK_VOXELS + 64 * x + 8 * y;
                    let rows = (0..count[0]).flat_map(|x| (0..count[1]).map(move |y| row(x, y)));
                    rows.flat_map(|row| row..row + count[2]).for_each(|at| add(self.grid.values.get(at)));
                }
            }
        }
        range
    }

    /// The bounds of all blocks of 8³ voxels whose interpolation may vary: bricks, tiles of that size, and the neighbours of both on the side
    /// of lesser coordinates, whose last cells reach into them. Blocks within wider tiles are constant, but for those at a face of greater
    /// coordinates, and those before a face of lesser ones.
    pub fn ranges(&self) -> Vec<BrickRange> {
        let small = self.grid.tiles.iter().filter(|tile| tile.log2_edge == 3).map(|tile| tile.origin);
        let origins = self.grid.bricks.iter().map(|brick| brick.origin).chain(small);
        let mut blocks = BTreeSet::new();
        for origin in origins {
            for step in 0..8 {
                let block = std::array::from_fn(|axis| origin[axis].saturating_sub(BRICK_EDGE * (step >> axis & 1)));
                blocks.insert(block.map(|x: i32| x & !7));
            }
        }
        blocks.into_iter().map(|origin| self.range(origin)).collect()
    }
}

fn cell(voxel: [i32; 3], log2: u8) -> [i32; 3] {
    voxel.map(|x| x >> log2)
}

/// A voxel's place in its brick.
fn offset(voxel: [i32; 3]) -> usize {
    let [x, y, z] = voxel.map(|x| (x & 7) as usize);
    64 * x + 8 * y + z
}
