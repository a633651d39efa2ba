//! The tiles that are in memory, of all textures of a scene, and which of them are given up.
//!
//! Tiles stand in a ring. One that was looked up since the ring last came to it gets another round (the clock algorithm, Corbató 1968).

use std::collections::VecDeque;
use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

/// The largest tile, bytes.
const LARGEST_TILE: usize = 32 << 10;
/// Least and most tiles that a worker holds for itself.
const OWN_TILES: [usize; 2] = [16, 4096];

/// A tile in memory.
#[derive(Debug)]
pub(crate) struct Tile {
    pub(crate) words: Box<[f32]>,
    /// Whether it was looked up since the ring last came to it.
    recent: AtomicBool,
    usage: Arc<Usage>,
}

impl Tile {
    /// Says that the tile is in use. Reading first leaves the cache line shared.
    #[inline]
    pub(crate) fn touch(&self) {
        if !self.recent.load(Ordering::Relaxed) {
            self.recent.store(true, Ordering::Relaxed);
        }
    }

    /// Whether it was in use since the last call.
    pub(crate) fn was_recent(&self) -> bool {
        self.recent.swap(false, Ordering::Relaxed)
    }

    fn bytes(&self) -> usize {
        self.words.len() * 4
    }
}

impl Drop for Tile {
    fn drop(&mut self) {
        self.usage.now.fetch_sub(self.bytes(), Ordering::Relaxed);
    }
}

/// Bytes of all tiles that exist, workers' own among them.
#[derive(Debug, Default)]
struct Usage {
    now: AtomicUsize,
    most: AtomicUsize,
}

/// What became of a tile that the ring came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Eviction {
    /// It is no longer held.
    Gone,
    /// It is in use.
    Kept,
}

/// Holds tiles by number.
pub(crate) trait HoldsTiles: Send + Sync {
    /// Gives a tile up unless it is in use.
    fn evict(&self, tile: u32) -> Eviction;
}

struct Entry {
    holder: Weak<dyn HoldsTiles>,
    tile: u32,
    bytes: usize,
}

/// What was looked up and read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureStatistics {
    /// The limit, bytes.
    pub limit: u64,
    /// Bytes of tiles in memory now.
    pub used: u64,
    /// The most that there were at once.
    pub most: u64,
    /// Bytes of all texels of all textures that are paged.
    pub total: u64,
    /// Tiles asked for by lookups.
    pub lookups: u64,
    /// Of them those that were read from disk.
    pub tiles_read: u64,
    /// Bytes read from disk, where tiles are compressed.
    pub bytes_read: u64,
    /// Tiles given up.
    pub evicted: u64,
    /// What went wrong while rendering.
    pub notes: Vec<String>,
}

impl TextureStatistics {
    /// The share of lookups that found their tile in memory.
    pub fn hit_rate(&self) -> f64 {
        if self.lookups == 0 { 1.0 } else { 1.0 - self.tiles_read as f64 / self.lookups as f64 }
    }
}

/// The memory for textures of one scene.
pub struct TextureMemory {
    limit: u64,
    /// Bytes of the tiles that the ring may hold.
    ring_bytes: usize,
    /// Tiles that each worker holds for itself, a power of two.
    own_tiles: usize,
    threads: usize,
    number: u64,
    usage: Arc<Usage>,
    ring: Mutex<Ring>,
    total: AtomicU64,
    lookups: AtomicU64,
    tiles_read: AtomicU64,
    bytes_read: AtomicU64,
    evicted: AtomicU64,
    notes: Mutex<Vec<String>>,
}

#[derive(Default)]
struct Ring {
    entries: VecDeque<Entry>,
    bytes: usize,
}

impl fmt::Debug for TextureMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TextureMemory").field("limit", &self.limit).finish_non_exhaustive()
    }
}

/// A lock whose holder may have failed; what it guards is whole at any time.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl TextureMemory {
    /// Memory of `limit` bytes for `threads` workers, a quarter of which they hold for themselves; sixteen tiles each at the least.
    pub fn new(limit: u64, threads: usize) -> Arc<Self> {
        static NUMBERS: AtomicU64 = AtomicU64::new(1);
        let (bytes, threads) = (usize::try_from(limit).unwrap_or(usize::MAX), threads.max(1));
        let [least, most] = OWN_TILES;
        let own_tiles = 1 << (bytes / 4 / threads / LARGEST_TILE).clamp(least, most).ilog2();
        Arc::new(Self {
            limit,
            ring_bytes: bytes.saturating_sub(threads.saturating_mul(own_tiles * LARGEST_TILE)),
            own_tiles,
            threads,
            number: NUMBERS.fetch_add(1, Ordering::Relaxed),
            usage: Arc::default(),
            ring: Mutex::default(),
            total: AtomicU64::new(0),
            lookups: AtomicU64::new(0),
            tiles_read: AtomicU64::new(0),
            bytes_read: AtomicU64::new(0),
            evicted: AtomicU64::new(0),
            notes: Mutex::default(),
        })
    }

    /// The limit, bytes.
    pub fn limit(&self) -> u64 {
        self.limit
    }

    /// What the workers hold at the least where the limit is less, in one sentence.
    pub fn shortage(&self) -> Option<String> {
        let (threads, kilobytes) = (self.threads, (self.threads as u64).saturating_mul((self.own_tiles * LARGEST_TILE / 1024) as u64));
        (kilobytes.saturating_mul(1024) > self.limit).then(|| {
            let limit = self.limit;
            format!("{limit} bytes are less than what {threads} worker threads hold at the least; textures may take {kilobytes}K")
        })
    }

    /// What was looked up and read so far.
    pub fn statistics(&self) -> TextureStatistics {
        let read = |number: &AtomicU64| number.load(Ordering::Relaxed);
        TextureStatistics {
            limit: self.limit,
            used: self.usage.now.load(Ordering::Relaxed) as u64,
            most: self.usage.most.load(Ordering::Relaxed) as u64,
            total: read(&self.total),
            lookups: read(&self.lookups),
            tiles_read: read(&self.tiles_read),
            bytes_read: read(&self.bytes_read),
            evicted: read(&self.evicted),
            notes: lock(&self.notes).clone(),
        }
    }

    /// Tells it apart from all others of the process.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// Tiles that a worker holds for itself, a power of two.
    pub(crate) fn own_tiles(&self) -> usize {
        self.own_tiles
    }

    pub(crate) fn count_lookups(&self, count: u64) {
        self.lookups.fetch_add(count, Ordering::Relaxed);
    }

    pub(crate) fn add_total(&self, bytes: usize) {
        self.total.fetch_add(bytes as u64, Ordering::Relaxed);
    }

    pub(crate) fn remove_total(&self, bytes: usize) {
        self.total.fetch_sub(bytes as u64, Ordering::Relaxed);
    }

    /// Keeps what a user should know, once.
    pub(crate) fn note(&self, note: String) {
        let mut notes = lock(&self.notes);
        if !notes.contains(&note) {
            notes.push(note);
        }
    }

    /// A tile out of words, for which so many bytes were read.
    pub(crate) fn tile(&self, words: Vec<f32>, bytes_read: usize) -> Arc<Tile> {
        let tile = Tile { words: words.into(), recent: AtomicBool::new(false), usage: self.usage.clone() };
        let now = self.usage.now.fetch_add(tile.bytes(), Ordering::Relaxed) + tile.bytes();
        self.usage.most.fetch_max(now, Ordering::Relaxed);
        self.tiles_read.fetch_add(1, Ordering::Relaxed);
        self.bytes_read.fetch_add(bytes_read as u64, Ordering::Relaxed);
        Arc::new(tile)
    }

    /// Puts a tile that `holder` took into the ring, and gives others up until the limit is kept.
    pub(crate) fn admit(&self, holder: Weak<dyn HoldsTiles>, tile: u32, bytes: usize) {
        let mut ring = lock(&self.ring);
        ring.entries.push_back(Entry { holder, tile, bytes });
        ring.bytes += bytes;
        // Twice around: the first round may find all in use.
        let mut chances = 2 * ring.entries.len();
        while ring.bytes > self.ring_bytes && chances > 0 {
            chances -= 1;
            let Some(entry) = ring.entries.pop_front() else { break };
            let kept = entry.holder.upgrade().is_some_and(|holder| holder.evict(entry.tile) == Eviction::Kept);
            if kept {
                ring.entries.push_back(entry);
            } else {
                ring.bytes -= entry.bytes;
                self.evicted.fetch_add(1, Ordering::Relaxed);
            }
        }
    }
}
