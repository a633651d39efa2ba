//! Ray streams or single rays: which is faster for incoherent rays depends on the scene and on the machine's caches, so both are timed.
//!
//! The first long batches, and a few later ones, are traced in both modes. Each mode takes every other stretch of rays. Hits are the same in either;
//! only time is won.

use fearless_simd::Level;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU32, Ordering::Relaxed};
use std::time::Instant;

/// Rays of a stretch: few, so that both modes meet the same part of the scene.
const STRETCH: usize = 64;

/// Fewer rays tell nothing about a mode.
const FEWEST_TRIED: usize = 512;

/// At first batches are compared until this many nanoseconds or so many batches went into it. Older measurements decay at this rate.
const REMEMBERED: f64 = 8e6;
const FIRST: u32 = 64;

/// Later one batch in so many is compared: rays of another kind may come.
const SELDOM: u32 = 256;

/// A mode that takes less time by this share of it is clearly faster.
const CLEARLY: f64 = 0.1;

/// By no more than this share counts a mode as faster: a thread may be stopped at any time.
const MOST: f64 = 0.25;

/// The rays of a batch that are traced: all, or every other stretch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    /// Rays are left to others if this is what their numbers have of the bit [`STRETCH`].
    left_out: usize,
}

impl Part {
    pub(crate) const ALL: Part = Part { left_out: 1 };
    const HALVES: [Part; 2] = [Part { left_out: STRETCH }, Part { left_out: 0 }];

    /// The numbers of the part's rays among `n`.
    #[inline(always)]
    pub(crate) fn of(self, n: usize) -> Numbers {
        Numbers { part: self, next: 0, n }
    }
}

/// Numbers of rays, in order.
pub(crate) struct Numbers {
    part: Part,
    next: usize,
    n: usize,
}

impl Iterator for Numbers {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.next & STRETCH == self.part.left_out {
            self.next = (self.next | (STRETCH - 1)) + 1;
        }
        let number = self.next;
        self.next += 1;
        (number < self.n).then_some(number)
    }
}

/// How to trace a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    /// Many rays under way at once.
    Stream,
    /// One ray after the other.
    Single,
    /// One half in each mode, and compared; the number of the comparison.
    Both(u32),
}

/// Measures whether streams are faster.
#[derive(Debug, Default)]
struct StreamTuner {
    batches: AtomicU32,
    comparisons: AtomicU32,
    /// Nanoseconds that comparing took, up to [`REMEMBERED`].
    spent: AtomicI64,
    /// Nanoseconds that streams gained.
    gained: AtomicI64,
    /// Whether the last comparison spoke clearly against those before, so that the next batch is compared as well.
    doubted: AtomicBool,
}

impl StreamTuner {
    /// Whether streams are faster as far as known; `guess` while nothing is.
    fn streams(&self, guess: bool) -> bool {
        let gained = self.gained.load(Relaxed);
        gained > 0 || (gained == 0 && guess)
    }

    fn mode(&self, n: usize, guess: bool) -> Mode {
        if n >= FEWEST_TRIED {
            let turn = self.batches.fetch_add(1, Relaxed) % SELDOM;
            let new = self.spent.load(Relaxed) < REMEMBERED as i64 && self.comparisons.load(Relaxed) < FIRST;
            if new || turn == SELDOM - 1 || self.doubted.load(Relaxed) {
                return Mode::Both(self.comparisons.fetch_add(1, Relaxed));
            }
        }
        if self.streams(guess) { Mode::Stream } else { Mode::Single }
    }

    /// Adds a measurement: the nanoseconds that a batch takes, or would take, in either mode.
    ///
    /// Batches weigh by their time: those that see the sky alone take no time, and tell nothing of others. None weighs more than half of
    /// what is remembered.
    fn note(&self, stream: f64, single: f64) {
        let (time, before) = (stream.min(single), self.gained.load(Relaxed) as f64);
        let weight = (0.5 * REMEMBERED).min(time) / time.max(1.0);
        let gain = weight * (single - stream).clamp(-MOST * time, MOST * time);
        self.gained.store((before * (1.0 - weight * time / REMEMBERED) + gain) as i64, Relaxed);
        self.doubted.store(before * gain < 0.0 && gain.abs() > CLEARLY * weight * time, Relaxed);
        self.spent.store((self.spent.load(Relaxed) as f64 + weight * time).min(REMEMBERED) as i64, Relaxed);
    }
}

impl Clone for StreamTuner {
    fn clone(&self) -> Self {
        StreamTuner {
            batches: self.batches.load(Relaxed).into(),
            comparisons: self.comparisons.load(Relaxed).into(),
            spent: self.spent.load(Relaxed).into(),
            gained: self.gained.load(Relaxed).into(),
            doubted: self.doubted.load(Relaxed).into(),
        }
    }
}

/// One tuner a level that has streams, for rays that look for their nearest hit and for those that look for any.
#[derive(Clone, Debug, Default)]
pub(crate) struct StreamTuners([StreamTuner; 4]);

impl StreamTuners {
    fn of(&self, level: Level, ordered: bool) -> &StreamTuner {
        #[cfg(target_arch = "x86_64")]
        let widest = matches!(level, Level::Avx512(_));
        #[cfg(not(target_arch = "x86_64"))]
        let (widest, _) = (false, level);
        &self.0[2 * usize::from(widest) + usize::from(ordered)]
    }

    /// Whether streams are faster as far as known; `guess` while nothing is.
    pub(crate) fn streams(&self, level: Level, ordered: bool, guess: bool) -> bool {
        self.of(level, ordered).streams(guess)
    }

    /// How to trace a batch of `n` rays.
    pub(crate) fn mode(&self, level: Level, ordered: bool, n: usize, guess: bool) -> Mode {
        self.of(level, ordered).mode(n, guess)
    }

    /// Has `trace` trace both halves of `n` rays, one of them as a stream (true), and notes the times.
    pub(crate) fn compare(&self, level: Level, ordered: bool, turn: u32, n: usize, mut trace: impl FnMut(bool, Part)) {
        // What goes first finds colder caches, and halves may differ: each mode takes each place in turn.
        let first = turn & 1 == 0;
        let [one, other] = if turn & 2 == 0 { Part::HALVES } else { [Part::HALVES[1], Part::HALVES[0]] };
        let mut timed = |as_stream, part: Part| time(|| trace(as_stream, part)) * n as f64 / part.of(n).count().max(1) as f64;
        let (before, after) = (timed(first, one), timed(!first, other));
        let (stream, single) = if first { (before, after) } else { (after, before) };
        self.of(level, ordered).note(stream, single);
    }

    /// As if both modes had been measured.
    #[cfg(test)]
    pub(crate) fn settle(&self, streams: bool) {
        for tuner in &self.0 {
            tuner.spent.store(REMEMBERED as i64, Relaxed);
            tuner.gained.store(REMEMBERED as i64 * if streams { 1 } else { -1 }, Relaxed);
        }
    }
}

/// Nanoseconds that something takes.
fn time(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_share_the_rays() {
        for n in [0, 1, 63, 64, 65, 128, 700] {
            let mut both: Vec<usize> = Part::HALVES.iter().flat_map(|part| part.of(n)).collect();
            both.sort_unstable();
            assert_eq!(both, (0..n).collect::<Vec<_>>());
            assert_eq!(Part::ALL.of(n).count(), n);
        }
    }

    #[test]
    fn each_mode_traces_each_half_first_and_second() {
        let (level, tuners) = (Level::new(), StreamTuners::default());
        let mut turns = Vec::new();
        for turn in 0..4 {
            tuners.compare(level, true, turn, 1000, |as_stream, part| turns.push((as_stream, part.of(1000).next() == Some(0))));
        }
        assert_eq!(turns.len(), 8);
        for mode in [(true, true), (true, false), (false, true), (false, false)] {
            assert_eq!(turns.iter().step_by(2).filter(|first| **first == mode).count(), 1);
        }
    }

    /// A batch that takes so many nanoseconds as a stream, and so many with single rays; its mode.
    fn batch(tuner: &StreamTuner, stream: f64, single: f64) -> Mode {
        let mode = tuner.mode(1000, true);
        if matches!(mode, Mode::Both(_)) {
            tuner.note(stream, single);
        }
        mode
    }

    #[test]
    fn what_is_ahead_is_kept_until_the_other_is() {
        let tuner = StreamTuner::default();
        assert_eq!([tuner.mode(100, true), tuner.mode(100, false)], [Mode::Stream, Mode::Single]);
        let first = (0..SELDOM - 1).filter(|_| batch(&tuner, 1.2e6, 1e6) != Mode::Single).count();
        assert_eq!(first, (REMEMBERED / 1e6) as usize);
        assert_eq!(tuner.mode(100, true), Mode::Single);
        let later = (0..20 * SELDOM).find(|_| batch(&tuner, 1e6, 1.2e6) == Mode::Stream).expect("it changes sides");
        assert!(later < 2 * SELDOM, "{later} batches later");
        let both = (0..10 * SELDOM).filter(|_| matches!(batch(&tuner, 1e6, 1.2e6), Mode::Both(_))).count();
        assert_eq!(both, 10);
    }

    #[test]
    fn batches_of_sky_tell_nothing_of_others() {
        let tuner = StreamTuner::default();
        for number in 0..640 {
            if number % 4 == 0 {
                batch(&tuner, 1e6, 1.2e6)
            } else {
                batch(&tuner, 1e5, 0.7e5)
            };
        }
        assert_eq!(tuner.mode(100, false), Mode::Stream);
    }

    #[test]
    fn a_thread_that_was_stopped_is_forgotten() {
        let tuner = StreamTuner::default();
        batch(&tuner, 1e9, 1e6);
        (0..8).for_each(|_| _ = batch(&tuner, 1e6, 1.2e6));
        assert_eq!(tuner.mode(100, false), Mode::Stream);
    }

    #[test]
    fn modes_that_are_alike_are_seldom_compared() {
        let tuner = StreamTuner::default();
        (0..8).for_each(|_| _ = batch(&tuner, 1e6, 1e6));
        assert_eq!([tuner.mode(100, true), tuner.mode(100, false)], [Mode::Stream, Mode::Single]);
        let both = (0..10 * SELDOM).filter(|_| matches!(batch(&tuner, 1e6, 1e6), Mode::Both(_))).count();
        assert!((10..=11).contains(&both), "{both}");
    }
}
