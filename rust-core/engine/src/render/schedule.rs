//! Which worker does what: all tiles' next blocks before any tile's next but one, so that a whole picture is there early.

use super::Progress;
use crate::{
    film::{TileState, block, decides},
    scene::Settings,
};
use std::{
    cmp::Reverse,
    collections::{BinaryHeap, HashMap},
    ops::Range,
    sync::{Condvar, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// How long a worker waits for another's tile before it looks whether the render was cancelled.
const WAIT: Duration = Duration::from_millis(20);

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
    /// Samples of the whole render, and those that are wanted.
    samples: u32,
    range: Range<u32>,
    /// Samples from which on what comes next may wait for a decision.
    least: Option<u32>,
    queue: Mutex<Queue>,
    decided: Condvar,
    start: Instant,
    limit: Option<Duration>,
    /// Samples that all tiles together had at the start.
    before: u64,
}

#[derive(Debug)]
struct Queue {
    /// Next blocks and their tiles.
    next: BinaryHeap<Reverse<(u32, usize)>>,
    /// Tiles that wait for a decision, and the blocks that would come next.
    held: HashMap<usize, u32>,
    /// The last block that any tile has started with.
    pass: Option<u32>,
    /// Samples that were traced, by tile.
    done: Vec<u32>,
}

impl Schedule {
    /// A schedule for the samples that each tile does not have yet.
    pub(crate) fn new(tiles: impl Iterator<Item = TileState>, settings: &Settings) -> Self {
        let (range, samples, time_limit_s) = (settings.range(), settings.samples, settings.time_limit_s);
        let limit = (time_limit_s > 0.0).then(|| Duration::from_secs_f64(time_limit_s.min(1e9)));
        let mut queue = Queue { next: BinaryHeap::new(), held: HashMap::new(), pass: None, done: Vec::new() };
        for (tile, state) in tiles.enumerate() {
            let start = block(state.next, samples).start;
            if state.zones == 0 || start >= range.end {
                queue.done.push(range.end - range.start);
            } else {
                queue.next.push(Reverse((state.next, tile)));
                queue.done.push(start - range.start);
            }
        }
        let before = queue.total_done();
        let (queue, decided) = (Mutex::new(queue), Condvar::new());
        Self { samples, range, least: settings.least_samples(), queue, decided, start: Instant::now(), limit, before }
    }

    /// The next piece of work; waits while others may yet release some. `None` when there is none, the time is up, or the render cancelled.
    ///
    /// The time limit is only looked at between passes over the picture and after the first, so that the picture is always whole.
    pub(crate) fn take(&self, cancelled: &dyn Fn() -> bool) -> Option<Work> {
        let mut queue = self.queue();
        loop {
            if cancelled() {
                return None;
            }
            if let Some(Reverse((number, tile))) = queue.next.pop() {
                let late = || self.limit.is_some_and(|limit| self.start.elapsed() >= limit);
                if queue.pass.is_some_and(|pass| number > pass) && late() {
                    queue.end();
                    self.decided.notify_all();
                    return None;
                }
                queue.pass = queue.pass.max(Some(number));
                let samples = block(number, self.samples);
                if samples.end >= self.range.end {
                    return Some(Work { tile, block: number, samples });
                }
                if self.least.is_some_and(|least| decides(samples.end, least)) {
                    queue.held.insert(tile, number + 1);
                } else {
                    queue.next.push(Reverse((number + 1, tile)));
                }
                return Some(Work { tile, block: number, samples });
            }
            if queue.held.is_empty() {
                return None;
            }
            queue = self.decided.wait_timeout(queue, WAIT).unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    /// Counts what was traced.
    pub(crate) fn finished(&self, work: &Work) {
        self.queue().done[work.tile] += work.samples.end - work.samples.start;
    }

    /// Goes on with a tile that was waiting, or leaves it, once the film has all blocks before.
    pub(crate) fn decided(&self, tile: usize, state: TileState) {
        let mut queue = self.queue();
        if queue.held.get(&tile) != Some(&state.next) {
            return;
        }
        queue.held.remove(&tile);
        if state.zones == 0 {
            queue.done[tile] = self.range.end - self.range.start;
        } else {
            queue.next.push(Reverse((state.next, tile)));
        }
        drop(queue);
        self.decided.notify_all();
    }

    pub(crate) fn progress(&self, rays: u64) -> Progress {
        let elapsed = self.start.elapsed();
        let (least, done, tiles) = {
            let queue = self.queue();
            (queue.done.iter().min().copied().unwrap_or(0), queue.total_done(), queue.done.len() as u64)
        };
        let wanted = u64::from(self.range.end - self.range.start) * tiles;
        let share = |done: u64, of: u64| if of > 0 { done as f64 / of as f64 } else { 1.0 };
        let by_samples = share(done, wanted);
        // What was there at the start took no time of this run.
        let of_run = share(done - self.before, wanted - self.before);
        let by_time = self.limit.map_or(0.0, |limit| elapsed.as_secs_f64() / limit.as_secs_f64());
        let going = of_run.max(by_time).min(1.0);
        let remaining = (going > 0.0).then(|| Duration::from_secs_f64(elapsed.as_secs_f64() * (1.0 - going) / going));
        let samples = if least > 0 { self.range.start + least } else { 0 };
        Progress { fraction: by_samples.max(by_time).min(1.0), samples, samples_total: self.range.end, elapsed, remaining, rays }
    }

    fn queue(&self) -> MutexGuard<'_, Queue> {
        // Nothing panics while it holds the queue.
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Queue {
    fn total_done(&self) -> u64 {
        self.done.iter().map(|done| u64::from(*done)).sum()
    }
    /// Hands out nothing more.
    fn end(&mut self) {
        self.next.clear();
        self.held.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(schedule: &Schedule) -> Vec<Work> {
        std::iter::from_fn(|| schedule.take(&|| false)).collect()
    }

    fn schedule(next: &[u32], samples: u32, range: Option<[u32; 2]>, noise_threshold: f32) -> Schedule {
        let tiles = next.iter().map(|next| TileState { next: *next, samples: 0, zones: 1 });
        Schedule::new(tiles, &Settings { samples, sample_range: range, noise_threshold, ..Settings::default() })
    }

    #[test]
    fn work_is_handed_out_once_and_in_order() {
        let work = all(&schedule(&[0, 0, 0], 4, None, 0.0));
        assert_eq!(work.len(), 9);
        assert_eq!(work[3], Work { tile: 0, block: 1, samples: 1..2 });
    }

    #[test]
    fn tiles_that_are_behind_come_first() {
        let schedule = schedule(&[3, 1, 4], 8, None, 0.0);
        assert_eq!(schedule.progress(0).fraction, 13.0 / 24.0);
        let order: Vec<_> = all(&schedule).iter().map(|work| (work.block, work.tile)).collect();
        assert_eq!(order, [(1, 1), (2, 1), (3, 0), (3, 1)]);
    }

    #[test]
    fn a_range_starts_and_ends_where_it_is_told() {
        let work = all(&schedule(&[5], 100, Some([16, 48]), 0.0));
        assert_eq!(work.iter().map(|work| work.samples.clone()).collect::<Vec<_>>(), [16..32, 32..48]);
    }

    #[test]
    fn tiles_wait_for_decisions() {
        // Decisions from 32 samples on, which is the end of block 5.
        let schedule = schedule(&[5, 5], 128, None, 0.1);
        let state = |next, zones| TileState { next, samples: 0, zones };
        for _ in 0..2 {
            assert!(schedule.take(&|| false).is_some());
        }
        schedule.decided(0, state(5, 1));
        schedule.decided(1, state(6, 0));
        schedule.decided(0, state(6, 1));
        assert_eq!(schedule.take(&|| false).map(|work| (work.block, work.tile)), Some((6, 0)));
        schedule.decided(0, state(7, 0));
        assert_eq!(schedule.take(&|| false), None);
    }
}
