//! A worker's way to tiles: those it used last it holds itself, so that most lookups take no lock.

use super::memory::{TextureMemory, Tile};
use super::pages::PagedTexels;
use std::sync::Arc;

/// Texels of one lookup.
const CORNERS: usize = 4;
/// The widest registers.
const MOST_LANES: usize = 16;
/// Words of the largest texel.
const MOST_WORDS: usize = 4;
/// Room behind the last texel, for pairs read at it.
const PADDING: usize = 8;

/// Lookups that a worker counts for itself.
const FEW_LOOKUPS: u64 = 4096;

/// The key of no tile: no texture has as many.
const NO_KEY: u64 = u64::MAX;

#[derive(Clone, Debug)]
struct OwnTile {
    key: u64,
    tile: Option<Arc<Tile>>,
}

/// What a worker needs to look into textures that are paged.
#[derive(Debug)]
pub struct TileReader {
    /// The memory that the tiles belong to.
    memory: u64,
    /// By a hash of the key.
    own: Vec<OwnTile>,
    /// The four texels of each lane's lookup, one after the other.
    pub(crate) texels: Box<[f32; CORNERS * MOST_LANES * MOST_WORDS + PADDING]>,
    /// Lookups since they were last added to the memory's.
    lookups: u64,
}

impl Default for TileReader {
    fn default() -> Self {
        Self { memory: 0, own: Vec::new(), texels: Box::new([0.0; CORNERS * MOST_LANES * MOST_WORDS + PADDING]), lookups: 0 }
    }
}

impl TileReader {
    /// Readies the reader for lookups in textures of a memory; tiles of another are let go.
    pub(crate) fn attach(&mut self, memory: &TextureMemory) {
        if self.memory != memory.number() {
            self.memory = memory.number();
            self.own = vec![OwnTile { key: NO_KEY, tile: None }; memory.own_tiles()];
        }
    }

    /// Gets the texels at the corners of a rectangle between `low` and `high` for every lane of `wanted` (a bit each): those of the row
    /// `low[1]` first.
    pub(crate) fn fetch(&mut self, texels: &Arc<PagedTexels>, wanted: u64, level: &[u32; 16], low: [&[u32; 16]; 2], high: [&[u32; 16]; 2]) {
        // So that a texel is copied by a move and not by a call.
        match texels.layout.words() {
            1 => self.fetch_words::<1>(texels, wanted, level, low, high),
            2 => self.fetch_words::<2>(texels, wanted, level, low, high),
            _ => self.fetch_words::<MOST_WORDS>(texels, wanted, level, low, high),
        }
    }

    fn fetch_words<const WORDS: usize>(
        &mut self,
        texels: &Arc<PagedTexels>,
        wanted: u64,
        level: &[u32; 16],
        low: [&[u32; 16]; 2],
        high: [&[u32; 16]; 2],
    ) {
        let mut remaining = wanted & 0xffff;
        while remaining != 0 {
            let lane = remaining.trailing_zeros() as usize;
            remaining &= remaining - 1;
            let ([x, y], [right, below]) = (low.map(|column| column[lane]), high.map(|column| column[lane]));
            let corner = lane * CORNERS;
            // Nearly always all four lie in one tile.
            if let Some((number, places)) = texels.layout.quad(level[lane], [x, right], [y, below]) {
                self.copy::<WORDS, CORNERS>(texels, number, places, corner);
                continue;
            }
            for (next, (x, y)) in [(x, y), (right, y), (x, below), (right, below)].into_iter().enumerate() {
                let (number, place) = texels.layout.place(level[lane], x, y);
                self.copy::<WORDS, 1>(texels, number, [place], corner + next);
            }
        }
    }

    /// Copies texels of one tile to the corners from `corner` on.
    #[inline(always)]
    fn copy<const WORDS: usize, const COUNT: usize>(
        &mut self,
        texels: &Arc<PagedTexels>,
        number: u32,
        places: [usize; COUNT],
        corner: usize,
    ) {
        let slot = self.slot(texels, number);
        let Some(tile) = &self.own[slot].tile else { return };
        for (next, place) in places.into_iter().enumerate() {
            let (to, from) = ((corner + next) * WORDS, place * WORDS);
            self.texels[to..to + WORDS].copy_from_slice(&tile.words[from..from + WORDS]);
        }
    }

    /// Where among its own a tile now stands.
    #[inline]
    fn slot(&mut self, texels: &Arc<PagedTexels>, number: u32) -> usize {
        let key = texels.key(number);
        // Fibonacci hashing: the product's upper bits depend on all of the key.
        let slot = (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as usize & (self.own.len() - 1);
        self.lookups += 1;
        if self.lookups >= FEW_LOOKUPS {
            self.count(texels);
        }
        match &self.own[slot] {
            OwnTile { key: own, tile: Some(tile) } if *own == key => tile.touch(),
            _ => self.replace(slot, texels, number),
        }
        slot
    }

    /// Gets a tile from the memory, or from disk.
    #[cold]
    #[inline(never)]
    fn replace(&mut self, slot: usize, texels: &Arc<PagedTexels>, number: u32) {
        self.count(texels);
        // Let go first, so that a worker never holds one tile more.
        self.own[slot] = OwnTile { key: NO_KEY, tile: None };
        self.own[slot] = OwnTile { key: texels.key(number), tile: Some(texels.tile(number)) };
    }

    /// Adds the lookups to the memory's count, which all workers share.
    #[cold]
    #[inline(never)]
    fn count(&mut self, texels: &Arc<PagedTexels>) {
        texels.memory().count_lookups(std::mem::take(&mut self.lookups));
    }
}
