//! Rounds that are kept while others are traced, parts of them, and parts that are joined.

use super::file::{self, Traced};
use crate::{
    checkpoint::Pace,
    error::{Diagnostic, Error, Result},
    measure::{Kept, ROUNDS},
    scene::Origin,
};
use std::{
    ops::Range,
    path::{Path, PathBuf},
    time::Duration,
};

/// Where finished rounds are kept, and which of them are traced.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    /// The file that keeps them, from time to time and at the end.
    pub path: Option<PathBuf>,
    /// How long it is between two writings at least.
    pub every: Duration,
    /// Whether to go on with it where it is there.
    pub resume: bool,
    /// One part alone, of so many: 1 is the first. The first has the suns.
    pub part: Option<[u32; 2]>,
    /// Those of finished parts, in any order, in place of tracing.
    pub merge: Vec<PathBuf>,
}

impl Checkpoints {
    /// Whether rounds are read or written.
    pub(super) fn are_wanted(&self) -> bool {
        self.path.is_some() || !self.merge.is_empty()
    }

    /// The rounds that are traced, and whether suns are.
    pub(super) fn rounds(&self) -> Result<(Range<usize>, bool)> {
        let Some([part, count]) = self.part else { return Ok((0..ROUNDS, true)) };
        if count as usize > ROUNDS {
            return Err(Error::setting("part", format!("there cannot be {count} parts of a year, but {ROUNDS}")));
        }
        if !(1..=count).contains(&part) {
            return Err(Error::setting("part", format!("{part} of {count} was found, expected 1 to {count}")));
        }
        if self.path.is_none() {
            return Err(Error::setting("part", "a part is kept in a checkpoint, and none was named"));
        }
        let from = |part: u32| ROUNDS * part as usize / count as usize;
        Ok((from(part - 1)..from(part), part == 1))
    }

    /// What earlier runs have left of some tracings.
    pub(super) fn read(&self, wanted: &[Traced]) -> Result<Vec<Kept>> {
        if !self.merge.is_empty() {
            return joined(&self.merge, wanted);
        }
        match &self.path {
            Some(path) if path.exists() && !self.resume => {
                let problem = format!("{} is there already; resume goes on with it, or remove it", path.display());
                Err(Error::setting("checkpoint", problem))
            }
            Some(path) if path.exists() => file::read(path, wanted),
            _ => Ok(vec![Kept::default(); wanted.len()]),
        }
    }
}

/// All rounds of some tracings from the checkpoints of their parts.
fn joined(paths: &[PathBuf], wanted: &[Traced]) -> Result<Vec<Kept>> {
    let mut whole = vec![Kept::default(); wanted.len()];
    for path in paths {
        for (whole, part) in whole.iter_mut().zip(file::read(path, wanted)?) {
            for (number, (round, found)) in whole.rounds.iter_mut().zip(part.rounds).enumerate() {
                if round.is_some() && found.is_some() {
                    let problem = format!("its round {} is there twice", number + 1);
                    return Err(Error::Format { path: path.clone(), line: None, problem });
                }
                *round = round.take().or(found);
            }
            whole.suns = whole.suns.take().or(part.suns);
        }
    }
    let missing = |number: &usize| whole.iter().any(|kept| kept.rounds[*number].is_none());
    let missing: Vec<String> = (0..ROUNDS).filter(missing).map(|number| (number + 1).to_string()).collect();
    if missing.is_empty() {
        return Ok(whole);
    }
    Err(Error::setting("merge", format!("rounds {} of {ROUNDS} are missing; are all parts there, and finished?", missing.join(", "))))
}

/// Writes rounds as they are finished.
pub(super) struct Keeper<'a> {
    path: &'a Path,
    tracings: &'a [Traced],
    pace: Pace,
    /// What could not be written, and why.
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl<'a> Keeper<'a> {
    /// One where a file is named to keep them.
    pub(super) fn new(checkpoints: &'a Checkpoints, tracings: &'a [Traced]) -> Option<Self> {
        let path = checkpoints.path.as_deref()?;
        Some(Self { path, tracings, pace: Pace::new(checkpoints.every), diagnostics: Vec::new() })
    }

    /// Writes all that is there if it is time. What cannot be written does not end the tracing: there may yet be room.
    pub(super) fn keep_if_due(&mut self, kept: &[&Kept]) {
        if self.pace.is_due()
            && let Err(error) = self.keep(kept)
        {
            let origin = Origin::new(self.path.to_string_lossy());
            self.diagnostics.push(Diagnostic::warning(&origin, format!("the checkpoint could not be written: {error}")));
        }
    }

    pub(super) fn keep(&mut self, kept: &[&Kept]) -> Result<()> {
        self.pace.written(|| file::write(self.path, self.tracings, kept))
    }
}
