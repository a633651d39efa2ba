//! Melanopic equivalent daylight illuminance (CIE S 026): what melanopsin gets, as the lx of D65 that would bring as much.

use super::check_spectra;
use crate::{
    error::{Diagnostic, Result},
    scene::{Observer, Origin, Scene},
};

/// The scene as melanopsin sees it, for meters of an origin.
///
/// # Errors
/// Lamps without a spectrum: their colour does not tell what melanopsin gets of them.
pub(in super::super) fn seen(scene: &Scene, of: &Origin, diagnostics: &mut Vec<Diagnostic>) -> Result<Scene> {
    check_spectra(scene, of, "melanopic figures", diagnostics)?;
    let mut seen = scene.clone();
    (seen.settings.spectral, seen.settings.observer) = (true, Observer::Melanopic);
    Ok(seen)
}
