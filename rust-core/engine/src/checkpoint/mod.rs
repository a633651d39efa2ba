//! Renders on disk: sums so far, to go on from after a kill, and parts of a render's samples, to be merged. Both give the bits of one undisturbed render.

pub(crate) mod described;
mod file;
mod identity;
mod merge;
mod pace;
mod parts;
mod stamp;

pub use file::write_checkpoint;
pub use identity::Identity;
pub use merge::merge;
pub use pace::Pace;
pub use parts::{Part, parts};
pub use stamp::Stamp;

use crate::{error::Result, film::Film};
use std::path::Path;

/// A film and what it is of.
#[derive(Debug)]
pub struct Checkpoint {
    /// What it is of.
    pub identity: Identity,
    /// The sums so far.
    pub film: Film,
}

impl Checkpoint {
    /// Reads a checkpoint to go on with a render; one of another render is an error that says what differs.
    pub fn resume(path: &Path, wanted: &Identity) -> Result<Film> {
        let checkpoint = Self::read(path)?;
        wanted.stamp.check(&checkpoint.identity.stamp, path, &[])?;
        Ok(checkpoint.film)
    }
}
