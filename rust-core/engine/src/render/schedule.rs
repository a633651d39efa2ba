//! Which worker does what: tiles in passes that double in length, so that a whole picture is there early.

use super::Progress;
use std::{
    ops::Range,
    sync::atomic::{AtomicUsize, Ordering},
    time::{Duration, Instant},
};

/// Most samples of a block; sums of so few keep their precision in 32 bits.
const MOST_SAMPLES: u32 = 16;

/// A tile that has new samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileReady {
    /// The tile's number in the film.
    pub tile: usize,
    /// Samples a pixel of it has.
    pub samples: u32,
}

/// A piece of work: some samples of one tile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Work {
    pub(crate) tile: usize,
    /// The block's number within its tile.
    pub(crate) block: u32,
    pub(crate) samples: Range<u32>,
}

/// Hands out work.
#[derive(Debug)]
pub(crate) struct Schedule {
    tiles: usize,
    blocks: Vec<Range<u32>>,
    next: AtomicUsize,
    done: AtomicUsize,
    start: Instant,
    limit: Option<Duration>,
}

impl Schedule {
    pub(crate) fn new(tiles: usize, samples: u32, time_limit_s: f64) -> Self {
        let limit = (time_limit_s > 0.0).then(|| Duration::from_secs_f64(time_limit_s.min(1e9)));
        Self { tiles, blocks: blocks(samples), next: AtomicUsize::new(0), done: AtomicUsize::new(0), start: Instant::now(), limit }
    }

    /// The next piece of work; `None` when all is handed out or the time is up.
    ///
    /// The time limit is only looked at between passes over the picture and after the first, so that the picture is always whole.
    pub(crate) fn take(&self) -> Option<Work> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let (block, tile) = (number / self.tiles.max(1), number % self.tiles.max(1));
        let samples = self.blocks.get(block)?.clone();
        if block > 0 && tile == 0 && self.limit.is_some_and(|limit| self.start.elapsed() >= limit) {
            self.next.store(usize::MAX / 2, Ordering::Relaxed);
            return None;
        }
        Some(Work { tile, block: block as u32, samples })
    }

    pub(crate) fn finished_one(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    pub(crate) fn progress(&self, rays: u64) -> Progress {
        let done = self.done.load(Ordering::Relaxed);
        let share = |block: &Range<u32>| f64::from(block.end - block.start);
        let total = self.blocks.iter().map(share).sum::<f64>() * self.tiles as f64;
        let whole = done / self.tiles.max(1);
        let mut weight = self.blocks[..whole.min(self.blocks.len())].iter().map(share).sum::<f64>() * self.tiles as f64;
        if let Some(block) = self.blocks.get(whole) {
            weight += share(block) * (done % self.tiles.max(1)) as f64;
        }
        let elapsed = self.start.elapsed();
        let by_samples = if total > 0.0 { weight / total } else { 1.0 };
        let fraction = match self.limit {
            Some(limit) => by_samples.max(elapsed.as_secs_f64() / limit.as_secs_f64()).min(1.0),
            None => by_samples,
        };
        let remaining = (fraction > 0.0).then(|| Duration::from_secs_f64(elapsed.as_secs_f64() * (1.0 - fraction) / fraction));
        let samples = whole.checked_sub(1).and_then(|last| self.blocks.get(last)).map_or(0, |block| block.end);
        let samples_total = self.blocks.last().map_or(0, |block| block.end);
        Progress { fraction, samples, samples_total, elapsed, remaining, rays }
    }
}

/// Sample ranges of 1, 1, 2, 4, 8, 16, 16 … up to the total.
fn blocks(samples: u32) -> Vec<Range<u32>> {
    let mut blocks = Vec::new();
    let mut start = 0;
    while start < samples {
        let length = start.clamp(1, MOST_SAMPLES).min(samples - start);
        blocks.push(start..start + length);
        start += length;
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_cover_all_samples_once() {
        for samples in [0, 1, 2, 3, 17, 64, 1000] {
            let blocks = blocks(samples);
            assert_eq!(blocks.iter().map(|b| b.end - b.start).sum::<u32>(), samples);
            assert!(blocks.windows(2).all(|pair| pair[0].end == pair[1].start));
        }
    }

    #[test]
    fn work_is_handed_out_once_and_in_order() {
        let schedule = Schedule::new(3, 4, 0.0);
        let all: Vec<_> = std::iter::from_fn(|| schedule.take()).collect();
        assert_eq!(all.len(), 9);
        assert_eq!(all[3], Work { tile: 0, block: 1, samples: 1..2 });
    }
}
