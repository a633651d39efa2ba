//! Together or one by one: which of the two is faster for incoherent rays depends on the scene and on the machine's caches, so it is tried out.
//!
//! The first long batches are walked by both, each taking every other stretch of rays, and timed. Hits are the same either way; only time is won.

use fearless_simd::Level;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Rays of a stretch: few, so that both ways meet the same part of the scene.
const STRETCH: usize = 64;

/// Fewer rays tell nothing about a way.
pub(super) const FEWEST_TRIED: usize = 512;

/// Comparisons until it is settled: one alone says little, as a thread may be stopped at any time.
const COMPARISONS: u32 = 32;

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

/// Whether going together is faster.
#[derive(Debug, Default)]
struct Trial {
    held: AtomicU32,
    /// How often it was, less how often it was not.
    lead: AtomicI32,
}

impl Trial {
    fn settled(&self) -> Option<bool> {
        (self.held.load(Relaxed) >= COMPARISONS).then(|| self.lead.load(Relaxed) > 0)
    }

    fn note(&self, together_won: bool) {
        self.lead.fetch_add(if together_won { 1 } else { -1 }, Relaxed);
    }
}

impl Clone for Trial {
    fn clone(&self) -> Self {
        Trial { held: self.held.load(Relaxed).into(), lead: self.lead.load(Relaxed).into() }
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

    /// Whether going together is faster, once it is known.
    pub(super) fn settled(&self, level: Level, ordered: bool) -> Option<bool> {
        self.of(level, ordered).settled()
    }

    /// Has `walk` walk both halves of `n` rays, one of them together (true), and keeps in mind which took less time a ray.
    pub(super) fn compare(&self, level: Level, ordered: bool, n: usize, mut walk: impl FnMut(bool, Part)) {
        let trial = self.of(level, ordered);
        let turn = trial.held.fetch_add(1, Relaxed);
        // What goes first finds colder caches, and halves may differ: each way takes each place in turn.
        let first = turn & 1 == 0;
        let [one, other] = if turn & 2 == 0 { Part::HALVES } else { [Part::HALVES[1], Part::HALVES[0]] };
        let before = time(|| walk(first, one)) * other.of(n).count() as u32;
        let after = time(|| walk(!first, other)) * one.of(n).count() as u32;
        trial.note(if before < after { first } else { !first });
    }

    /// Settled without having been tried.
    #[cfg(test)]
    pub(super) fn settle(&self, together: bool) {
        for trial in &self.0 {
            trial.held.store(COMPARISONS, Relaxed);
            trial.lead.store(i32::from(together), Relaxed);
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
    fn each_way_walks_each_half_first_and_what_wins_more_often_is_kept() {
        let (level, trials) = (Level::new(), Trials::default());
        let mut turns = Vec::new();
        for _ in 0..COMPARISONS {
            assert_eq!(trials.settled(level, true), None);
            trials.compare(level, true, 1000, |together, part| turns.push((together, part.of(1000).next() == Some(0))));
        }
        for turn in [(true, true), (true, false), (false, true), (false, false)] {
            assert_eq!(turns.iter().step_by(2).filter(|other| **other == turn).count(), COMPARISONS as usize / 4);
        }
        assert_eq!(trials.settled(level, false), None);
        let trial = Trial { held: COMPARISONS.into(), lead: 0.into() };
        for (won, settled) in [(true, true), (false, false), (false, false), (true, false), (true, true)] {
            trial.note(won);
            assert_eq!(trial.settled(), Some(settled));
        }
    }
}
