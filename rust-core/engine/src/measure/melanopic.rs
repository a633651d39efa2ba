//! Melanopic equivalent daylight illuminance (CIE S 026): what melanopsin gets, as the lx of D65 that would bring as much.

use crate::{
    error::{Diagnostic, Error, Result},
    scene::{LightShape, Observer, Origin, Scene},
};

/// The scene as melanopsin sees it, for meters of an origin.
///
/// # Errors
/// Lamps without a spectrum: their colour does not tell what melanopsin gets of them.
pub(super) fn seen(scene: &Scene, of: &Origin, diagnostics: &mut Vec<Diagnostic>) -> Result<Scene> {
    let without = |light: &&crate::scene::Light| light.spectrum.is_none() && !light.portal && light.dimming != 0.0;
    let is_sky = |light: &crate::scene::Light| matches!(light.shape, LightShape::Dome { .. } | LightShape::Distant { .. });
    if let Some(lamp) = scene.lights.iter().filter(without).find(|light| !is_sky(light)) {
        let problem =
            "melanopic figures want its spectrum, which its colour does not tell: give it gonio:spectrum, a file or a name such as LED-B3";
        return Err(Error::scene(&lamp.origin, problem));
    }
    if scene.lights.iter().filter(without).any(is_sky) {
        diagnostics.push(Diagnostic::info(of, "sun and sky without a spectrum count as daylight D65 of their colour"));
    }
    if scene.materials.iter().flat_map(|material| &material.closures).any(|closure| closure.input("emission_color").is_some()) {
        diagnostics
            .push(Diagnostic::warning(of, "surfaces that shine have no spectrum; melanopsin gets of them what D65 of their colour brings"));
    }
    let mut seen = scene.clone();
    (seen.settings.spectral, seen.settings.observer) = (true, Observer::Melanopic);
    Ok(seen)
}
