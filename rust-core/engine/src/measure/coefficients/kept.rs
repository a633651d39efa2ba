//! Coefficients that are there already: rounds and suns, of which those that are missing are traced.

use super::{DaylightCoefficients, ROUNDS, Tracing, Work, rounds, straight};
use crate::{error::Result, threads::workers};
use std::ops::Range;

/// An independent estimate of what light each patch brings: points × patches, lx for 1 cd/m²; see [`DaylightCoefficients`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Round {
    /// All light.
    pub all: Vec<f32>,
    /// The part that anything scattered on its way.
    pub scattered: Vec<f32>,
}

/// What is there of coefficients.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    /// By number.
    pub rounds: [Option<Round>; ROUNDS],
    /// What comes straight from the suns' discs: points × suns.
    pub suns: Option<Vec<f32>>,
}

/// What is traced, and who keeps it.
pub struct Keeping<'a> {
    /// What is there already, to which comes what is traced.
    pub kept: &'a mut Kept,
    /// The rounds that are wanted.
    pub rounds: Range<usize>,
    /// Whether the suns are.
    pub suns: bool,
    /// Is told whenever more is there; `None` where nobody keeps anything before the end.
    pub finished: Option<&'a mut (dyn FnMut(&Kept) + Send)>,
}

impl std::fmt::Debug for Keeping<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Keeping").field("rounds", &self.rounds).field("suns", &self.suns).finish_non_exhaustive()
    }
}

impl Keeping<'_> {
    fn missing(&self) -> Vec<usize> {
        self.rounds.clone().filter(|round| self.kept.rounds[*round].is_none()).collect()
    }

    fn suns_are_missing(&self) -> bool {
        self.suns && self.kept.suns.is_none()
    }

    /// Batches that are to be traced.
    pub(super) fn batches(&self, tracing: &Tracing<'_>) -> u64 {
        let of_a_round = rounds::size(tracing).1 + straight::batches_of_a_round(tracing);
        let of_suns = if self.suns_are_missing() { straight::batches_of_suns(tracing) } else { 0 };
        self.missing().len() as u64 * of_a_round + of_suns
    }

    /// Traces what is missing: where it is kept as many rounds together as have work for all threads, else all.
    pub(super) fn trace(&mut self, tracing: &Tracing<'_>, work: &Work) -> Result<()> {
        let missing = self.missing();
        let busy = workers(tracing.settings.threads).div_ceil(rounds::size(tracing).0.max(1));
        let together = if self.finished.is_some() { busy } else { missing.len() };
        for chosen in missing.chunks(together.max(1)) {
            let [all, scattered] = rounds::trace(tracing, work, chosen)?;
            let straight = straight::patches(tracing, work, chosen)?;
            for (((round, mut all), scattered), straight) in chosen.iter().zip(all).zip(scattered).zip(straight) {
                all.iter_mut().zip(straight).for_each(|(all, straight)| *all += straight);
                self.kept.rounds[*round] = Some(Round { all, scattered });
            }
            self.tell();
        }
        if self.suns_are_missing() {
            self.kept.suns = Some(straight::suns(tracing, work)?);
            self.tell();
        }
        Ok(())
    }

    fn tell(&mut self) {
        if let Some(finished) = &mut self.finished {
            finished(self.kept);
        }
    }
}

impl From<Kept> for DaylightCoefficients {
    /// Of the rounds that are there.
    fn from(kept: Kept) -> Self {
        let (all, scattered) = kept.rounds.into_iter().flatten().map(|round| (round.all, round.scattered)).unzip();
        Self { all, scattered, suns: kept.suns.unwrap_or_default() }
    }
}
