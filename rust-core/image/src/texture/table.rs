//! All textures of a scene, as kernels see them.

use super::mip_map::MipMap;
use super::paged::{TextureMemory, TextureStatistics, TileReader};
use super::wrap::{Filter, Wrap};
use gonio_simd::{F, Lanes, M, U, Vec2};
use std::sync::Arc;

/// A texture's place in its [`TextureTable`].
pub type TextureId = u32;

/// Textures by number: single images, or sets of UDIM tiles.
#[derive(Clone, Debug, Default)]
pub struct TextureTable {
    textures: Vec<Texture>,
}

#[derive(Clone, Debug)]
enum Texture {
    Image(Arc<MipMap>),
    Tiles(Tiles),
}

/// UDIM tiles: ten to a row, 1001 covering the unit square, 1011 above it.
#[derive(Clone, Debug)]
struct Tiles {
    maps: Vec<Arc<MipMap>>,
    /// For each place of the grid the map's number, or `NO_TILE`; whole rows.
    grid: Vec<u32>,
    rows: f32,
}

const NO_TILE: u32 = u32::MAX;

/// Tiles in a row of the grid.
const COLUMNS: u32 = 10;
/// The number of the first tile.
const FIRST_TILE: u32 = 1001;

impl TextureTable {
    /// A table without textures.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an image.
    pub fn push(&mut self, map: Arc<MipMap>) -> TextureId {
        self.textures.push(Texture::Image(map));
        (self.textures.len() - 1) as TextureId
    }

    /// Adds a set of UDIM tiles, given with their numbers (1001 …); numbers outside 1001 to 9999 are left out.
    pub fn push_tiles(&mut self, tiles: impl IntoIterator<Item = (u32, Arc<MipMap>)>) -> TextureId {
        let mut set = Tiles { maps: Vec::new(), grid: vec![NO_TILE; COLUMNS as usize], rows: 0.0 };
        for (number, map) in tiles.into_iter().filter(|(number, _)| (FIRST_TILE..=9999).contains(number)) {
            let place = (number - FIRST_TILE) as usize;
            let whole_rows = (place + 1).next_multiple_of(COLUMNS as usize);
            if set.grid.len() < whole_rows {
                set.grid.resize(whole_rows, NO_TILE);
            }
            set.grid[place] = set.maps.len() as u32;
            set.maps.push(map);
        }
        set.rows = (set.grid.len() / COLUMNS as usize) as f32;
        self.textures.push(Texture::Tiles(set));
        (self.textures.len() - 1) as TextureId
    }

    /// Textures held.
    pub fn len(&self) -> usize {
        self.textures.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.textures.is_empty()
    }

    /// Bytes of the texels of all textures.
    pub fn bytes(&self) -> usize {
        self.maps().map(|map| map.bytes()).sum()
    }

    fn maps(&self) -> impl Iterator<Item = &Arc<MipMap>> {
        self.textures.iter().flat_map(|texture| match texture {
            Texture::Image(map) => std::slice::from_ref(map),
            Texture::Tiles(tiles) => &tiles.maps[..],
        })
    }

    /// Texels of a texture's finest level (the first tile's for a set): width, height. A set without tiles is 1 × 1.
    pub fn resolution(&self, texture: TextureId) -> [u32; 2] {
        match &self.textures[texture as usize] {
            Texture::Image(map) => map.resolution(),
            Texture::Tiles(tiles) => tiles.maps.first().map_or([1, 1], |map| map.resolution()),
        }
    }

    /// One texture looked up in every lane: linear RGBA, alpha 1 where the image has none.
    ///
    /// `uv` has its origin at the image's bottom left; `width` is the footprint in uv units (0: the finest level). Outside the tiles of a set the
    /// answer is zero, and `wrap` does not count. NaN in any argument is safe.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, texture: TextureId, uv: Vec2<L>, width: F<L>, wrap: [Wrap; 2], filter: Filter) -> [F<L>; 4] {
        let part = self.part(l, texture, uv, wrap);
        let mut texel = [l.f(0.0); 4];
        let (maps, mut remaining) = (part.map.to_array(), part.inside.bits());
        // A batch seldom spans more than one tile, so that one pass does.
        while remaining != 0 {
            let chosen = maps[remaining.trailing_zeros() as usize];
            let here = part.map.eq(chosen) & part.inside;
            remaining &= !here.bits();
            let Some(map) = part.maps.get(chosen as usize) else { continue };
            for (channel, value) in texel.iter_mut().zip(map.sample(l, part.uv, width, part.wrap, filter)) {
                *channel = here.select(value, *channel);
            }
        }
        texel
    }

    /// Whether a texture is a set of UDIM tiles.
    #[inline]
    pub fn is_set(&self, texture: TextureId) -> bool {
        matches!(&self.textures[texture as usize], Texture::Tiles(_))
    }

    /// Lanes whose coordinates a texture has an image for: all, but for sets of UDIM tiles.
    #[inline(always)]
    pub fn covers<L: Lanes>(&self, l: L, texture: TextureId, uv: Vec2<L>) -> M<L> {
        match &self.textures[texture as usize] {
            Texture::Image(_) => l.m(true),
            Texture::Tiles(tiles) => tiles.part(l, uv).inside,
        }
    }

    /// Whether a texture is read tile by tile, by [`Self::sample_tiles`].
    #[inline]
    pub fn is_paged(&self, texture: TextureId) -> bool {
        match &self.textures[texture as usize] {
            Texture::Image(map) => map.is_paged(),
            Texture::Tiles(tiles) => tiles.maps.first().is_some_and(|map| map.is_paged()),
        }
    }

    /// What was looked up and read of textures within a memory limit; `None` where all are held whole.
    pub fn statistics(&self) -> Option<TextureStatistics> {
        self.memory().map(|memory| memory.statistics())
    }

    /// The memory of textures within a limit; `None` where all are held whole.
    pub fn memory(&self) -> Option<&Arc<TextureMemory>> {
        self.maps().find_map(|map| map.paged.as_ref()).map(|paged| paged.memory())
    }

    /// [`Self::sample`] for a texture that is paged, in the first `count` lanes; it waits for tiles that are not in memory.
    #[inline(always)]
    pub fn sample_tiles<L: Lanes>(
        &self,
        l: L,
        (reader, count): (&mut TileReader, usize),
        texture: TextureId,
        uv: Vec2<L>,
        width: F<L>,
        (wrap, filter): ([Wrap; 2], Filter),
    ) -> [F<L>; 4] {
        let part = self.part(l, texture, uv, wrap);
        let inside = part.inside & l.first(count);
        let mut texel = [l.f(0.0); 4];
        let (maps, mut remaining) = (part.map.to_array(), inside.bits());
        while remaining != 0 {
            let chosen = maps[remaining.trailing_zeros() as usize];
            let here = part.map.eq(chosen) & inside;
            remaining &= !here.bits();
            let Some(map) = part.maps.get(chosen as usize) else { continue };
            let values = map.sample_tiles(l, reader, part.uv, width, (part.wrap, filter), here);
            for (channel, value) in texel.iter_mut().zip(values) {
                *channel = here.select(value, *channel);
            }
        }
        texel
    }

    /// Which images of a texture lanes look into.
    #[inline(always)]
    fn part<L: Lanes>(&self, l: L, texture: TextureId, uv: Vec2<L>, wrap: [Wrap; 2]) -> Part<'_, L> {
        match &self.textures[texture as usize] {
            Texture::Image(map) => Part { maps: std::slice::from_ref(map), map: l.u(0), inside: l.m(true), uv, wrap },
            Texture::Tiles(tiles) => tiles.part(l, uv),
        }
    }
}

/// The images that lanes look into, and where.
struct Part<'a, L: Lanes> {
    maps: &'a [Arc<MipMap>],
    /// Each lane's image.
    map: U<L>,
    /// Lanes that have an image.
    inside: M<L>,
    /// The place in the image.
    uv: Vec2<L>,
    wrap: [Wrap; 2],
}

impl Tiles {
    #[inline(always)]
    fn part<L: Lanes>(&self, l: L, uv: Vec2<L>) -> Part<'_, L> {
        let (column, row) = (uv.x.floor(), uv.y.floor());
        let on_grid = column.ge(0.0) & column.lt(COLUMNS as f32) & row.ge(0.0) & row.lt(self.rows);
        let place = row.keep_if(on_grid).mul_add(COLUMNS as f32, column.keep_if(on_grid)).to_i32();
        let map = l.gather_integers(&self.grid, place);
        let inside = on_grid & map.ne(NO_TILE);
        Part { maps: &self.maps, map, inside, uv: Vec2 { x: uv.x - column, y: uv.y - row }, wrap: [Wrap::Clamp; 2] }
    }
}
