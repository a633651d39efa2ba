//! Trees of NanoVDB: nodes point to their children by distances in bytes.

use super::layout::{Layout, Voxels};
use super::list::{GRID_HEADER, Listing, TREE_HEADER, block};
use crate::grid::BRICK_VOXELS;
use crate::stream::Stream;
use crate::{Brick, Grid, MetadataMap, Result, Tile, Transform, Values};

/// What is told of a tree.
pub(super) trait Visitor {
    /// A leaf, its bytes, and the bits of each of its voxels if it is quantised.
    fn leaf(&mut self, leaf: Brick, bytes: &[u8], bits: u32);
    fn tile(&mut self, tile: Tile);
}

/// Reads a grid that the listing does not refuse.
pub(crate) fn read(stream: &mut Stream, listing: &Listing, index: usize, transform: Transform) -> Result<Grid> {
    let entry = &listing.entries[index];
    let info = &entry.info;
    let Some(layout) = entry.layout else {
        return Err(stream.error("a grid of an unknown type"));
    };
    let bytes = block(stream, entry)?;
    let (bricks, tiles) = (info.bricks as usize, info.tiles as usize);
    let mut collector = Collector {
        layout,
        bricks: Vec::with_capacity(bricks),
        values: Values::with_capacity(layout.storage(), bricks * BRICK_VOXELS),
        tiles: Vec::with_capacity(tiles),
        numbers: Vec::new(),
    };
    let background = walk(&bytes, layout, &mut collector).map_err(|problem| stream.error(problem))?;
    Ok(Grid {
        name: info.name.clone(),
        class: info.class,
        transform,
        background,
        bricks: collector.bricks,
        values: collector.values,
        tiles: collector.tiles,
        metadata: MetadataMap::new(),
    })
}

/// A tree that is gone through.
struct Walk<'a> {
    block: &'a [u8],
    layout: Layout,
    background: [f32; 3],
    /// Bytes of nodes that may still be met: nodes that share bytes would make more of a grid than its block holds.
    left: usize,
}

type Told<T> = std::result::Result<T, String>;

/// Goes through a tree; gives the background.
pub(super) fn walk(block: &[u8], layout: Layout, visitor: &mut dyn Visitor) -> Told<[f32; 3]> {
    let mut walk = Walk { block, layout, background: [0.0; 3], left: block.len() };
    let root = walk.child(GRID_HEADER, GRID_HEADER + 24)?;
    if root < GRID_HEADER + TREE_HEADER {
        return Err("a root within the grid's header".into());
    }
    walk.background = walk.value(root + layout.root_background())?;
    let count = u32::from_le_bytes(walk.bytes(root + 24)?) as usize;
    let table = root + layout.root_table();
    if count > block.len().saturating_sub(table) / layout.root_tile() {
        return Err(format!("a root of {count} entries, which the grid has no room for"));
    }
    for n in 0..count {
        let at = table + n * layout.root_tile();
        let key = u64::from_le_bytes(walk.bytes(at)?);
        let origin = [42, 21, 0].map(|shift| ((key >> shift & 0x1f_ffff) << 12) as i32);
        if i64::from_le_bytes(walk.bytes(at + 8)?) != 0 {
            let child = walk.child(root, at + 8)?;
            walk.inner(child, origin, 5, 7, visitor)?;
        } else {
            let active = u32::from_le_bytes(walk.bytes(at + 16)?) != 0;
            let tile = Tile { origin, log2_edge: 12, active, value: walk.value(at + layout.root_tile_value())? };
            walk.tell(tile, visitor);
        }
    }
    Ok(walk.background)
}

impl Walk<'_> {
    fn bytes<const N: usize>(&self, at: usize) -> Told<[u8; N]> {
        let found = self.block.get(at..).and_then(|rest| rest.first_chunk::<N>());
        found.copied().ok_or_else(|| format!("a node at byte {at} of a grid of {}", self.block.len()))
    }

    fn slice(&self, at: usize, size: usize) -> Told<&[u8]> {
        let found = self.block.get(at..).and_then(|rest| rest.get(..size));
        found.ok_or_else(|| format!("a node of {size} bytes at byte {at} of a grid of {}", self.block.len()))
    }

    /// The place that a distance at `at` from a node leads to.
    fn child(&self, node: usize, at: usize) -> Told<usize> {
        let distance = i64::from_le_bytes(self.bytes(at)?);
        let place = i64::try_from(node).ok().and_then(|node| node.checked_add(distance));
        let place = place.and_then(|place| usize::try_from(place).ok()).filter(|place| *place < self.block.len());
        place.ok_or_else(|| format!("a child {distance} bytes from byte {node}, outside the grid"))
    }

    fn value(&self, at: usize) -> Told<[f32; 3]> {
        let mut numbers = Vec::with_capacity(3);
        self.layout.number.decode(self.slice(at, self.layout.value_size())?, &mut numbers);
        Ok(if self.layout.components == 3 { [numbers[0], numbers[1], numbers[2]] } else { [numbers[0]; 3] })
    }

    fn tell(&self, tile: Tile, visitor: &mut dyn Visitor) {
        if tile.active || tile.value != self.background {
            visitor.tile(tile);
        }
    }

    fn spend(&mut self, size: usize) -> Told<()> {
        self.left = self.left.checked_sub(size).ok_or("nodes that share their bytes")?;
        Ok(())
    }

    /// A node of `1 << log2` children along an edge, each of `1 << child` voxels.
    fn inner(&mut self, at: usize, origin: [i32; 3], log2: u8, child: u8, visitor: &mut dyn Visitor) -> Told<()> {
        let places = 1usize << (3 * log2);
        let table = self.layout.table(places);
        let size = table + places * self.layout.entry();
        self.spend(size)?;
        self.slice(at, size)?;
        let bit = |walk: &Self, mask: usize, n: usize| Ok::<bool, String>(walk.bytes::<1>(at + mask + n / 8)?[0] >> (n % 8) & 1 != 0);
        for n in 0..places {
            let entry = at + table + n * self.layout.entry();
            let part = |shift: u8| ((n >> (shift * log2)) as i32 & ((1 << log2) - 1)) << child;
            let place = [2, 1, 0].map(part);
            let place = [origin[0] + place[0], origin[1] + place[1], origin[2] + place[2]];
            if !bit(self, 32 + places / 8, n)? {
                let tile = Tile { origin: place, log2_edge: child, active: bit(self, 32, n)?, value: self.value(entry)? };
                self.tell(tile, visitor);
            } else if child == 7 {
                self.inner(self.child(at, entry)?, place, 4, 3, visitor)?;
            } else {
                self.leaf(self.child(at, entry)?, place, visitor)?;
            }
        }
        Ok(())
    }

    fn leaf(&mut self, at: usize, origin: [i32; 3], visitor: &mut dyn Visitor) -> Told<()> {
        let bits = match self.layout.voxels {
            Voxels::Quantised(bits) => bits,
            Voxels::Variable => 1 << (self.bytes::<1>(at + 15)?[0] >> 5),
            _ => 0,
        };
        if bits > 16 {
            return Err(format!("a leaf at byte {at} with voxels of {bits} bits, expected 1 to 16"));
        }
        let size = self.layout.leaf(bits);
        self.spend(size)?;
        let bytes = self.slice(at, size)?;
        let mut active = [0; 8];
        for (n, word) in active.iter_mut().enumerate() {
            *word = u64::from_le_bytes(self.bytes(at + 16 + 8 * n)?);
        }
        visitor.leaf(Brick { origin, active }, bytes, bits);
        Ok(())
    }
}

struct Collector {
    layout: Layout,
    bricks: Vec<Brick>,
    values: Values,
    tiles: Vec<Tile>,
    numbers: Vec<f32>,
}

impl Visitor for Collector {
    fn leaf(&mut self, leaf: Brick, bytes: &[u8], bits: u32) {
        let voxels = &bytes[self.layout.leaf_voxels()..];
        self.numbers.clear();
        match self.layout.voxels {
            Voxels::Plain => self.layout.number.decode(voxels, &mut self.numbers),
            Voxels::Quantised(_) | Voxels::Variable => dequantise(bytes, voxels, bits, &mut self.numbers),
            Voxels::Bits => self.numbers.extend((0..BRICK_VOXELS).map(|n| f32::from(voxels[n / 8] >> (n % 8) & 1))),
            Voxels::Mask => self.numbers.extend((0..BRICK_VOXELS).map(|n| f32::from(leaf.active[n / 64] >> (n % 64) & 1 != 0))),
        }
        self.bricks.push(leaf);
        self.values.push(&self.numbers);
    }

    fn tile(&mut self, tile: Tile) {
        self.tiles.push(tile);
    }
}

/// Codes of 1 to 16 bits, the lowest first, times the leaf's step over its least value.
fn dequantise(leaf: &[u8], codes: &[u8], bits: u32, to: &mut Vec<f32>) {
    let real = |at: usize| f32::from_le_bytes([leaf[at], leaf[at + 1], leaf[at + 2], leaf[at + 3]]);
    let (least, step) = (real(80), real(84));
    let bits = bits as usize;
    to.extend((0..BRICK_VOXELS).map(|n| {
        let code = match bits {
            16 => u16::from_le_bytes([codes[2 * n], codes[2 * n + 1]]),
            _ => u16::from(codes[n * bits / 8]) >> (n * bits % 8) & ((1 << bits) - 1),
        };
        f32::from(code) * step + least
    }));
}
