//! The film: sums of samples by pixel, in blocks added in order, so that the same samples always give the same bits.

mod backdrop;
mod blocks;
mod bytes;
mod catcher;
mod channels;
mod deep;
mod deep_picture;
mod develop;
mod edge_aware;
mod filter;
mod matte;
mod noise;
mod picture_view;
mod raw;
mod splat_limits;
mod splats;
mod sums;
mod tile;
mod zones;

pub use backdrop::{Backdrop, Besides};
pub(crate) use blocks::{GROUP, MOST_BLOCK, block, block_at};
pub(crate) use bytes::LEAST_TILE;
pub use channels::{ChannelLayout, channel_names, divisor, is_absolute, is_index};
pub use deep::BEHIND_ALL;
pub use develop::{Frame, Image, Layer};
pub use edge_aware::edge_aware;
pub use filter::tabulate;
pub use gonio_camera::{FilterTable, Placement};
pub(crate) use noise::decides;
pub use picture_view::{PictureProjection, PictureView};
use splats::SplatFilm;
pub(crate) use splats::{SplatBlock, SplatLayout};
pub use tile::{Block, TileFilm, TileState};
pub use zones::{ZONE, ZONES, zone_of};

use crate::{
    camera::sampler::TILE,
    scene::{Crop, Integrator, Manifests, Settings},
};
use std::{
    ops::Range,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};
use tile::Plan;

/// Sums of one image.
#[derive(Debug)]
pub struct Film {
    /// The whole image's width and height.
    pub resolution: [u32; 2],
    /// The part that is rendered; tiles start at its corner.
    pub window: Crop,
    /// How the picture is to be placed, and how it was taken.
    frame: Frame,
    /// Whether a sky is seen behind all surfaces.
    sky: bool,
    /// Which passes are kept, and where.
    pub layout: ChannelLayout,
    /// Names of the passes.
    names: Vec<String>,
    /// Factor on the colour pass.
    exposure: f32,
    plan: Plan,
    tiles: Vec<Mutex<TileFilm>>,
    /// What light paths bring, where some are traced. Locked before a tile.
    splats: Option<Mutex<SplatFilm>>,
    /// Classes of light that they bring.
    brought: u16,
    /// The most of it that a pixel has, straight from lights and otherwise, 0 for any.
    limits: [f32; 2],
    /// The names in its mattes.
    manifests: Arc<Manifests>,
    columns: u32,
}

impl Film {
    /// An empty film of the passes asked for; `window` lies inside the resolution, `exposure` is the factor on the colour pass, and
    /// `besides` tells what the scene wants kept.
    pub fn new(settings: &Settings, window: Crop, exposure: f32, besides: Besides) -> Self {
        let besides = besides.shown(settings.background);
        let across = |axis: usize| (window.max[axis] - window.min[axis]).div_ceil(TILE as u32);
        let layout = ChannelLayout::with_divisors(&settings.aovs).besides(besides);
        let names = layout.aovs.iter().map(|aov| settings.pass_name(*aov)).collect();
        let plan = Plan::new(settings, &layout, across(0) * across(1));
        let frame = Frame { overscan: settings.overscan, pixel_aspect: settings.pixel_aspect, view: None };
        let (resolution, columns) = (settings.resolution, across(0));
        let mut film = Self {
            resolution,
            window,
            frame,
            sky: besides.sky,
            layout,
            names,
            exposure,
            plan,
            tiles: Vec::new(),
            splats: None,
            brought: if settings.integrator == Integrator::Light { splats::SCATTERED } else { splats::INDIRECT },
            limits: [settings.clamp_direct, settings.clamp_indirect],
            manifests: Arc::default(),
            columns,
        };
        let tile = |tile: u32| {
            // Tiles of other parts of the render have no pixels here, so that nobody waits for them.
            let size = if film.plan.tiles.contains(&tile) { film.tile_size(tile as usize) } else { [0; 2] };
            Mutex::new(TileFilm::new(&film.plan, size))
        };
        film.tiles = (0..across(0) * across(1)).map(tile).collect();
        film
    }

    /// Takes how it is seen, which files say.
    pub(crate) fn with_view(mut self, view: Option<PictureView>) -> Self {
        self.frame.view = view;
        self
    }

    /// Takes the names in its mattes, which files say.
    pub(crate) fn with_manifests(self, manifests: Arc<Manifests>) -> Self {
        Self { manifests, ..self }
    }

    /// Makes room for what light paths bring; `power` is that of their lights.
    pub(crate) fn with_splats(mut self, power: Option<f64>) -> Self {
        self.splats = power.map(|power| Mutex::new(SplatFilm::new(&self.layout, self.window, (self.brought, self.limits), power)));
        self
    }

    /// What light paths brought so far.
    pub(crate) fn splats(&self) -> Option<MutexGuard<'_, SplatFilm>> {
        self.splats.as_ref().map(|splats| splats.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Tiles of a window.
    pub(crate) fn tiles_of(window: Crop) -> u64 {
        [0, 1].map(|axis| u64::from((window.max[axis] - window.min[axis]).div_ceil(TILE as u32))).iter().product()
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

    /// Width and height of a tile in pixels.
    fn tile_size(&self, tile: usize) -> [usize; 2] {
        let area = self.tile_area(tile);
        [0, 1].map(|axis| (area.max[axis] - area.min[axis]) as usize)
    }

    /// What of a tile there is.
    pub fn state(&self, tile: usize) -> TileState {
        self.read(tile, TileFilm::state)
    }

    /// Adds a block to a tile, and gives what the tile is then; blocks that come early wait for those before them. `white` is the colour that is
    /// shown as white, by which noise is measured. `ready` is called when the tile has more samples.
    pub(crate) fn add(&self, tile: usize, number: u32, block: Block, white: f32, ready: impl FnOnce()) -> TileState {
        let mut splats = self.splats();
        let mut film = self.tile(tile);
        let before = film.state();
        for brought in film.add(number, block, &self.plan, white) {
            if let Some(splats) = &mut splats {
                splats.add(&brought);
            }
        }
        drop(splats);
        let after = film.state();
        if after.next > before.next {
            ready();
        }
        after
    }

    /// Factor on the colour pass.
    pub(crate) fn exposure(&self) -> f32 {
        self.exposure
    }

    /// Whether pixels may have enough samples before the end.
    pub(crate) fn looks_at_noise(&self) -> bool {
        self.plan.enough.is_some()
    }

    /// Whether all samples of the film's range are there.
    pub fn is_complete(&self) -> bool {
        let last = block_at(self.plan.range.end, self.plan.samples);
        (0..self.tile_count()).map(|tile| self.state(tile)).all(|state| state.zones == 0 || Some(state.next) == last)
    }

    /// The samples that the film is for, of all the samples of its render.
    pub fn range(&self) -> Range<u32> {
        self.plan.range.clone()
    }

    /// The tiles that the film is for, of all the tiles of its window.
    pub fn tiles(&self) -> Range<u32> {
        self.plan.tiles.clone()
    }

    /// Adds a film of the same samples with the tiles that follow; both are complete.
    pub(crate) fn join_tiles(&mut self, mut later: Self) {
        for tile in later.tiles() {
            std::mem::swap(&mut self.tiles[tile as usize], &mut later.tiles[tile as usize]);
        }
        self.join_splats(&later);
        self.plan.tiles.end = later.plan.tiles.end;
    }

    /// Adds a film of the same tiles with the samples that follow; both are complete.
    pub(crate) fn join_samples(&mut self, later: Self) {
        self.join_splats(&later);
        for (tile, later) in self.tiles.iter_mut().zip(later.tiles) {
            let later = later.into_inner().unwrap_or_else(PoisonError::into_inner);
            tile.get_mut().unwrap_or_else(PoisonError::into_inner).join(later, &self.plan);
        }
        self.plan.range.end = later.plan.range.end;
    }

    fn join_splats(&self, later: &Self) {
        if let (Some(mut splats), Some(later)) = (self.splats(), later.splats()) {
            splats.join(&later);
        }
    }

    /// Runs `read` on a tile's sums.
    pub fn read<R>(&self, tile: usize, read: impl FnOnce(&TileFilm) -> R) -> R {
        read(&self.tile(tile))
    }

    fn tile(&self, tile: usize) -> MutexGuard<'_, TileFilm> {
        // A worker that panicked has ended the render; what it had added is whole.
        self.tiles[tile].lock().unwrap_or_else(PoisonError::into_inner)
    }
}
