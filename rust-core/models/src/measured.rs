//! Measured BSDFs of models.

use crate::modifier::Modifier;
use crate::vector::Vec3;
use std::{path::Path, sync::Arc};

/// The modifier of a BSDF file's bytes.
///
/// # Errors
/// What the reader says.
pub(crate) fn modifier(bytes: &[u8], name: &str, up: Vec3) -> Result<Modifier, String> {
    let bsdf = gonio_formats::bsdf::read(bytes, name).map_err(|error| format!("its BSDF cannot be read: {error}"))?;
    Ok(Modifier::Measured { bsdf: Arc::new(bsdf), up })
}

/// The modifier of a BSDF file.
///
/// # Errors
/// The file's or the reader's.
pub(crate) fn of_file(path: &Path, up: Vec3) -> Result<Modifier, String> {
    let bytes = gonio_scene::read_file(path).map_err(|error| format!("{}: {error}", path.display()))?;
    modifier(&bytes, &path.to_string_lossy(), up)
}
