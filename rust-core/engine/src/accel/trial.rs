//! Together or one by one: which of the two is faster for incoherent rays depends on the scene and on the machine's caches, so it is tried out.
//!
//! The first long batches, and a few later ones, are walked by both, each taking every other stretch of rays, and timed. Hits are the same either
//! way; only time is won.

use fearless_simd::Level;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Rays of a stretch: few, so that both ways meet the same part of the scene.
const STRETCH: usize = 64;

/// Fewer rays tell nothing about a way.
const FEWEST_TRIED: usize = 512;

/// A way that is so far ahead is taken: one comparison says little, as a thread may be stopped at any time, but what was before is not for ever.
const DECIDED: i32 = 5;

/// Of the first batches as many as it takes are walked both ways, but no more than these, and then one in [`SELDOM`]: rays of another kind may come.
const FIRST: u32 = 32;
const SELDOM: u32 = 256;

/// The rays of a batch that are walked: all, or every other stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// Rays are left to others if this is what their numbers have of the bit [`STRETCH`].
    left_out: usize,
}

impl Part {
    pub(super) const ALL: Part = Part { left_out: 1 };
    const HALVES: [Part; 2] = [Part { left_out: STRETCH }, Part { left_out: 0 }];

    /// The numbers of the part's rays among `n`.
    #[inline(always)]
    pub(super) fn of(self, n: usize) -> Numbers {
        Numbers { part: self, next: 0, n }
    }
}

/// Numbers of rays, in order.
pub(super) struct Numbers {
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

/// How to walk a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    Together,
    OneByOne,
    /// One half each way, and compared; the number of the comparison.
    Both(u32),
}

/// Whether going together is faster.
#[derive(Debug, Default)]
struct Trial {
    /// Batches so far.
    batches: AtomicU32,
    /// How often it was, less how often it was not.
    lead: AtomicI32,
}

impl Trial {
    /// Whether going together is faster as far as known; `guess` while nothing is.
    fn together(&self, guess: bool) -> bool {
        let lead = self.lead.load(Relaxed);
        lead > 0 || (lead == 0 && guess)
    }

    fn way(&self, n: usize, guess: bool) -> Way {
        if n >= FEWEST_TRIED {
            let turn = self.batches.fetch_add(1, Relaxed);
            if turn < FIRST && self.lead.load(Relaxed).abs() < DECIDED {
                return Way::Both(turn);
            }
            if turn % SELDOM == SELDOM - 1 {
                return Way::Both(turn / SELDOM);
            }
        }
        if self.together(guess) { Way::Together } else { Way::OneByOne }
    }

    fn note(&self, together_won: bool) {
        let moved = self.lead.load(Relaxed) + if together_won { 1 } else { -1 };
        self.lead.store(moved.clamp(-DECIDED, DECIDED), Relaxed);
    }
}

impl Clone for Trial {
    fn clone(&self) -> Self {
        Trial { batches: self.batches.load(Relaxed).into(), lead: self.lead.load(Relaxed).into() }
    }
}

/// One trial a level that has streams, for rays that look for their nearest hit and for those that look for any.
#[derive(Clone, Debug, Default)]
pub(super) struct Trials([Trial; 4]);

impl Trials {
    fn of(&self, level: Level, ordered: bool) -> &Trial {
        #[cfg(target_arch = "x86_64")]
        let widest = matches!(level, Level::Avx512(_));
        #[cfg(not(target_arch = "x86_64"))]
        let (widest, _) = (false, level);
        &self.0[2 * usize::from(widest) + usize::from(ordered)]
    }

    /// Whether going together is faster as far as known; `guess` while nothing is.
    pub(super) fn together(&self, level: Level, ordered: bool, guess: bool) -> bool {
        self.of(level, ordered).together(guess)
    }

    /// How to walk a batch of `n` rays.
    pub(super) fn way(&self, level: Level, ordered: bool, n: usize, guess: bool) -> Way {
        self.of(level, ordered).way(n, guess)
    }

    /// Has `walk` walk both halves of `n` rays, one of them together (true), and keeps in mind which took less time a ray.
    pub(super) fn compare(&self, level: Level, ordered: bool, turn: u32, n: usize, mut walk: impl FnMut(bool, Part)) {
        // What goes first finds colder caches, and halves may differ: each way takes each place in turn.
        let first = turn & 1 == 0;
        let [one, other] = if turn & 2 == 0 { Part::HALVES } else { [Part::HALVES[1], Part::HALVES[0]] };
        let before = time(|| walk(first, one)) * other.of(n).count() as u32;
        let after = time(|| walk(!first, other)) * one.of(n).count() as u32;
        self.of(level, ordered).note(if before < after { first } else { !first });
    }

    /// As if it had been tried.
    #[cfg(test)]
    pub(super) fn settle(&self, together: bool) {
        for trial in &self.0 {
            trial.batches.store(FIRST, Relaxed);
            trial.lead.store(if together { DECIDED } else { -DECIDED }, Relaxed);
        }
    }
}

fn time(work: impl FnOnce()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
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
    fn each_way_walks_each_half_first_and_second() {
        let (level, trials) = (Level::new(), Trials::default());
        let mut turns = Vec::new();
        for turn in 0..4 {
            trials.compare(level, true, turn, 1000, |together, part| turns.push((together, part.of(1000).next() == Some(0))));
        }
        assert_eq!(turns.len(), 8);
        for way in [(true, true), (true, false), (false, true), (false, false)] {
            assert_eq!(turns.iter().step_by(2).filter(|first| **first == way).count(), 1);
        }
    }

    #[test]
    fn what_is_ahead_is_kept_until_the_other_is() {
        let trial = Trial::default();
        assert_eq!([trial.way(100, true), trial.way(100, false)], [Way::Together, Way::OneByOne]);
        for turn in 0..DECIDED as u32 {
            assert_eq!(trial.way(1000, true), Way::Both(turn));
            trial.note(false);
        }
        assert_eq!([trial.way(100, true), trial.way(1000, true)], [Way::OneByOne; 2]);
        (0..2 * DECIDED).for_each(|_| trial.note(true));
        assert_eq!(trial.way(1000, false), Way::Together);
        let both = (0..10 * SELDOM).filter(|_| matches!(trial.way(1000, false), Way::Both(_))).count();
        assert_eq!(both, 10);
    }

    #[test]
    fn ways_that_are_alike_are_compared_only_so_often() {
        let trial = Trial::default();
        for turn in 0..FIRST {
            assert_eq!(trial.way(1000, true), Way::Both(turn));
            trial.note(turn % 2 == 0);
        }
        assert_eq!([trial.way(1000, true), trial.way(1000, false)], [Way::Together, Way::OneByOne]);
    }
}
