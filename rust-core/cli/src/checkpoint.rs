//! Keeping a render on disk while it runs.

use super::{arguments::CheckpointArguments, messages::say};
use gonio::{
    Error, Result,
    checkpoint::{Checkpoint, Identity, Pace, parts, write_checkpoint},
    film::Film,
    scene::Settings,
};
use std::{path::PathBuf, time::Duration};

/// Longest time between checkpoints, seconds.
const MOST_SECONDS: f64 = 1e9;

/// Writes a render's checkpoints.
pub(super) struct Keeper {
    path: PathBuf,
    identity: Identity,
    resume: bool,
    pace: Pace,
}

impl Keeper {
    /// A keeper of one render's checkpoint; a file that is there already and is not to be resumed is an error.
    pub(super) fn new(path: PathBuf, identity: Identity, arguments: &CheckpointArguments) -> Result<Self> {
        let pace = Pace::new(every(arguments.keeping.checkpoint_every)?);
        if path.exists() && !arguments.keeping.resume {
            let problem = format!("{} is there already; --resume goes on with it, or remove it", path.display());
            return Err(Error::setting("checkpoint", problem));
        }
        Ok(Self { path, identity, resume: arguments.keeping.resume, pace })
    }

    /// What an earlier run has left.
    pub(super) fn film(&self) -> Result<Option<Film>> {
        if self.resume && self.path.exists() { Checkpoint::resume(&self.path, &self.identity).map(Some) } else { Ok(None) }
    }

    /// Writes a checkpoint if it is time. One that cannot be written does not end the render, which may yet find room.
    pub(super) fn keep_if_due(&mut self, film: &Film) {
        if self.pace.is_due()
            && let Err(error) = self.keep(film)
        {
            say(&format!("warning: the checkpoint could not be written: {error}"));
        }
    }

    /// Writes a checkpoint.
    pub(super) fn keep(&mut self, film: &Film) -> Result<()> {
        self.pace.written(|| write_checkpoint(&self.path, &self.identity, film))
    }
}

/// The time between two checkpoints, from seconds.
pub(super) fn every(seconds: f64) -> Result<Duration> {
    if seconds.is_nan() || seconds < 0.0 {
        return Err(Error::setting("checkpoint-every", format!("{seconds} was found, expected seconds from 0 on")));
    }
    Ok(Duration::from_secs_f64(seconds.min(MOST_SECONDS)))
}

/// A part and how many there are, from `NUMBER/COUNT`.
pub(super) fn part_of(text: &str) -> Result<[u32; 2]> {
    let number = |text: &str| text.trim().parse::<u32>().ok();
    let pair = text.split_once('/').and_then(|(part, count)| Some([number(part)?, number(count)?]));
    pair.filter(|[part, count]| (1..=*count).contains(part))
        .ok_or_else(|| Error::setting("part", format!("'{text}' was found, expected NUMBER/COUNT as in 1/8 to 8/8")))
}

/// Leaves of what settings ask for a part, from `NUMBER/COUNT`.
pub(super) fn take_part(text: &str, settings: &mut Settings) -> Result<()> {
    let [part, count] = part_of(text)?;
    let parts = parts(settings, count)?;
    if parts.len() != count as usize {
        return Err(Error::setting("part", format!("there cannot be {count} parts of this render, but {}", parts.len())));
    }
    let part = parts[part as usize - 1];
    (settings.tile_range, settings.sample_range) = (Some(part.tiles), Some(part.samples));
    Ok(())
}

/// A range of samples from `FIRST:END`.
pub(super) fn sample_range(text: &str) -> Result<[u32; 2]> {
    let number = |text: &str| text.trim().parse::<u32>().ok();
    let range = text.split_once(':').and_then(|(first, end)| Some([number(first)?, number(end)?]));
    range.ok_or_else(|| Error::setting("samples", format!("'{text}' was found, expected FIRST:END as in 0:256")))
}
