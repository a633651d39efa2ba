//! The page table of a texture: which of its tiles are in memory, and where the others are read from.

use super::file::TileFile;
use super::layout::TileLayout;
use super::memory::{Eviction, HoldsTiles, TextureMemory, Tile, lock};
use std::fmt;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock, Weak};

/// Where tiles come from.
#[derive(Debug)]
pub(crate) enum TileSource {
    /// A file of the cache.
    File(TileFile),
    /// A pyramid in memory, where no file could be written.
    Whole(Vec<f32>),
    /// Nowhere: tiles are zero.
    Lost,
}

/// Makes a texture's tiles anew once they were found damaged, or says why that cannot be.
pub(crate) type Remake = dyn Fn() -> Result<TileSource, String> + Send + Sync;

/// The texels of a pyramid, read tile by tile.
pub(crate) struct PagedTexels {
    number: u32,
    pub(crate) layout: TileLayout,
    pages: Box<[Mutex<Option<Arc<Tile>>>]>,
    memory: Arc<TextureMemory>,
    /// The source, and how often it was made anew.
    source: RwLock<(TileSource, u32)>,
    remake: Box<Remake>,
}

impl fmt::Debug for PagedTexels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PagedTexels").field("number", &self.number).finish_non_exhaustive()
    }
}

impl Drop for PagedTexels {
    fn drop(&mut self) {
        self.memory.remove_total(self.layout.bytes());
    }
}

impl HoldsTiles for PagedTexels {
    fn evict(&self, tile: u32) -> Eviction {
        // Who holds the page is about to use its tile.
        let Ok(mut page) = self.pages[tile as usize].try_lock() else { return Eviction::Kept };
        if page.as_ref().is_some_and(|tile| tile.was_recent()) {
            return Eviction::Kept;
        }
        *page = None;
        Eviction::Gone
    }
}

impl PagedTexels {
    pub(crate) fn new(layout: TileLayout, source: TileSource, memory: Arc<TextureMemory>, remake: Box<Remake>) -> Arc<Self> {
        static NUMBERS: AtomicU32 = AtomicU32::new(0);
        let pages = (0..layout.tiles()).map(|_| Mutex::new(None)).collect();
        memory.add_total(layout.bytes());
        let number = NUMBERS.fetch_add(1, Ordering::Relaxed);
        Arc::new(Self { number, layout, pages, memory, source: RwLock::new((source, 0)), remake })
    }

    /// The memory that its tiles are in.
    pub(crate) fn memory(&self) -> &Arc<TextureMemory> {
        &self.memory
    }

    /// Tells a tile apart from all others of the process.
    #[inline]
    pub(crate) fn key(&self, tile: u32) -> u64 {
        (u64::from(self.number) << 32) | u64::from(tile)
    }

    /// A tile, read if it is not in memory. Who comes second waits for the one who reads.
    pub(crate) fn tile(self: &Arc<Self>, number: u32) -> Arc<Tile> {
        let mut page = lock(&self.pages[number as usize]);
        if let Some(tile) = &*page {
            tile.touch();
            return tile.clone();
        }
        let (words, bytes_read) = self.read_counted(number);
        let tile = self.memory.tile(words, bytes_read);
        *page = Some(tile.clone());
        drop(page);
        let holder: Weak<Self> = Arc::downgrade(self);
        self.memory.admit(holder, number, tile.words.len() * 4);
        tile
    }

    /// The words of a tile, past all memory.
    pub(crate) fn read(&self, number: u32) -> Vec<f32> {
        self.read_counted(number).0
    }

    /// The words of a tile, and how many bytes were read for it.
    fn read_counted(&self, number: u32) -> (Vec<f32>, usize) {
        let source = self.source.read().unwrap_or_else(PoisonError::into_inner);
        let seen = source.1;
        if let Some(read) = self.read_from(&source.0, number) {
            return read;
        }
        drop(source);
        self.make_anew(seen);
        let source = self.source.read().unwrap_or_else(PoisonError::into_inner);
        self.read_from(&source.0, number).unwrap_or_else(|| (self.zeros(number), 0))
    }

    fn read_from(&self, source: &TileSource, number: u32) -> Option<(Vec<f32>, usize)> {
        match source {
            TileSource::File(file) => file.read(&self.layout, number).ok(),
            TileSource::Whole(pyramid) => {
                let mut words = Vec::new();
                self.layout.cut(pyramid, number, &mut words);
                Some((words, 0))
            }
            TileSource::Lost => Some((self.zeros(number), 0)),
        }
    }

    fn zeros(&self, number: u32) -> Vec<f32> {
        let span = self.layout.span(number);
        vec![0.0; span.width * span.height * self.layout.words()]
    }

    /// Replaces a source that was damaged when it had been made anew `seen` times.
    fn make_anew(&self, seen: u32) {
        let mut source = self.source.write().unwrap_or_else(PoisonError::into_inner);
        if source.1 != seen {
            return;
        }
        let made = (self.remake)().unwrap_or_else(|problem| {
            self.memory.note(problem);
            TileSource::Lost
        });
        *source = (made, seen + 1);
    }
}
