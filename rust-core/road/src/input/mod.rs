//! Reading a road from its TOML file and the files that it names.

mod files;
mod keys;
mod lists;
mod read;
mod rows;

use crate::{error::Result, road::Road};
use std::path::Path;

impl Road {
    /// Reads a road; files that it names lie relative to it.
    ///
    /// # Errors
    /// A file that cannot be read, with what the system says; anything in one that has no sensible reading, with the file, its line, and
    /// what was expected.
    pub fn read(path: &Path) -> Result<Self> {
        read::road(&files::bytes(path)?, path)
    }
}
