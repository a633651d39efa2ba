//! The file of a render: what it is of, the film tile by tile and what light paths brought.

use super::{
    Checkpoint, Identity,
    described::{Described, write_described},
};
use crate::{
    compile::{check_tiles, window},
    error::Result,
    film::{Film, LEAST_TILE},
};
use std::path::Path;

const FIRST_LINE: &str = "gonio checkpoint 2\n";

/// Writes a film as it is at the moment, whole or not at all; what an earlier kill left of one is overwritten.
pub fn write_checkpoint(path: &Path, identity: &Identity, film: &Film) -> Result<()> {
    write_described(path, FIRST_LINE, identity, |mut out| film.write(&mut out))
}

impl Checkpoint {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self> {
        let (mut file, identity) = Described::open::<Identity>(path, FIRST_LINE)?;
        let settings = &identity.stamp.settings;
        let window = window(settings)?;
        check_tiles(settings, window)?;
        let tiles = Film::tiles_of(window);
        if tiles.saturating_mul(LEAST_TILE) > file.length {
            return Err(file.broken("the checkpoint is shorter than its picture"));
        }
        let mut film = Film::new(settings, window, identity.exposure, identity.besides).with_manifests(identity.manifests.clone());
        film = film.with_view(identity.view);
        film.fill(&mut file.input).map_err(|error| file.damaged(&error))?;
        file.end()?;
        Ok(Self { identity, film })
    }

    /// Reads what a file is of, without its film.
    pub(super) fn read_identity(path: &Path) -> Result<Identity> {
        Described::open(path, FIRST_LINE).map(|(_, identity)| identity)
    }
}
