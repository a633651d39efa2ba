//! The film: sums of samples by pixel, in blocks added in order, so that the same samples always give the same bits.

mod catcher;
mod channels;
mod develop;
mod filter;
mod tile;

pub use channels::{ChannelLayout, channel_names, divisor, is_absolute, is_index};
pub use develop::{Image, Layer};
pub use filter::FilterTable;
pub use tile::{Block, TileFilm};

use crate::{
    integrator::TILE,
    scene::{Crop, Settings},
};
use std::sync::{Mutex, PoisonError};

/// Sums of one image.
#[derive(Debug)]
pub struct Film {
    /// The whole image's width and height.
    pub resolution: [u32; 2],
    /// The part that is rendered; tiles start at its corner.
    pub window: Crop,
    /// Which passes are kept, and where.
    pub layout: ChannelLayout,
    /// Names of the passes.
    names: Vec<String>,
    /// Factor on the colour pass.
    exposure: f32,
    tiles: Vec<Mutex<TileFilm>>,
    columns: u32,
}

impl Film {
    /// An empty film of the passes asked for; `window` lies inside the resolution, `exposure` is the factor on the colour pass, and
    /// `catchers` tells whether the scene has shadow catchers.
    pub fn new(settings: &Settings, window: Crop, exposure: f32, catchers: bool) -> Self {
        let across = |axis: usize| (window.max[axis] - window.min[axis]).div_ceil(TILE as u32);
        let layout = ChannelLayout::with_divisors(&settings.aovs).with_catchers(catchers);
        let names = layout.aovs.iter().map(|aov| settings.pass_name(*aov)).collect();
        let count = (across(0) * across(1)) as usize;
        let tiles = (0..count).map(|_| Mutex::new(TileFilm::new(&layout))).collect();
        Self { resolution: settings.resolution, window, layout, names, exposure, tiles, columns: across(0) }
    }

    /// Tiles of the window.
    pub fn tile_count(&self) -> usize {
        self.tiles.len()
    }

    /// Pixels of a tile: `[min, max)` in the image.
    pub fn tile_area(&self, tile: usize) -> Crop {
        let tile = tile as u32;
        let place = [tile % self.columns, tile / self.columns];
        let min = [0, 1].map(|axis| self.window.min[axis] + place[axis] * TILE as u32);
        Crop { min, max: [0, 1].map(|axis| (min[axis] + TILE as u32).min(self.window.max[axis])) }
    }

    /// Adds a block to a tile; blocks that come early wait for those before them. `ready` is told the tile's samples when there are more,
    /// in the order in which they came.
    pub fn add(&self, tile: usize, number: u32, block: Block, ready: impl FnOnce(u32)) {
        let mut sums = self.tile(tile);
        let before = sums.samples;
        sums.add(number, block);
        if sums.samples > before {
            ready(sums.samples);
        }
    }

    /// Runs `read` on a tile's sums.
    pub fn read<R>(&self, tile: usize, read: impl FnOnce(&TileFilm) -> R) -> R {
        read(&self.tile(tile))
    }

    fn tile(&self, tile: usize) -> std::sync::MutexGuard<'_, TileFilm> {
        // A worker that panicked has ended the render; what it had added is whole.
        self.tiles[tile].lock().unwrap_or_else(PoisonError::into_inner)
    }
}
