//! A scene's light by what sends it: the spectra of its lamps, each once, and daylight D65, whose colours all other light has.

use super::{shines, without_spectra};
use crate::{
    error::{Error, Result},
    scene::{LampSpectrum, Light, Material, Scene},
};
use gonio_spectrum::{Spectrum, named};
use std::sync::Arc;

/// Light of one spectrum alone, with wavelengths.
pub(crate) struct SourceScene {
    /// What of the scene shines with it.
    pub(crate) scene: Scene,
    pub(crate) spectrum: Spectrum,
}

/// The scene by its spectra; a scene without light has daylight alone.
///
/// # Errors
/// A lamp's spectrum that cannot be used.
pub(crate) fn by_spectrum(scene: &Scene) -> Result<Vec<SourceScene>> {
    let mut known: Vec<&Arc<LampSpectrum>> = Vec::new();
    let of_lights = scene.lights.iter().filter(|light| shines(light)).filter_map(Light::lamp_spectrum);
    let of_surfaces = scene.materials.iter().filter(|material| material.shines()).filter_map(|material| material.spectrum.as_ref());
    for spectrum in of_lights.chain(of_surfaces) {
        if !known.contains(&spectrum) {
            known.push(spectrum);
        }
    }
    let of_lamps = known.iter().map(|spectrum| of_lamp(scene, spectrum)).collect::<Result<Vec<_>>>()?;
    let has_others = known.is_empty() || without_spectra(scene).next().is_some() || scene.shines_without_spectra();
    let others = || scene.with_surfaces(|material| material.spectrum.is_none());
    let of_daylight = || Ok(SourceScene { scene: alone(others(), |light| light.lamp_spectrum().is_none()), spectrum: daylight()? });
    let daylight: Option<SourceScene> = has_others.then(of_daylight).transpose()?;
    Ok(of_lamps.into_iter().chain(daylight).collect())
}

fn of_lamp(scene: &Scene, spectrum: &Arc<LampSpectrum>) -> Result<SourceScene> {
    let is_of = |light: &Light| light.lamp_spectrum() == Some(spectrum);
    let is_of_it = |material: &Material| material.spectrum.as_ref() == Some(spectrum);
    let lights = scene.lights.iter().filter(|light| is_of(light)).map(|light| &light.origin);
    let surfaces = scene.materials.iter().filter(|material| is_of_it(material)).map(|material| &material.origin);
    let origin = lights.chain(surfaces).next().cloned().unwrap_or_default();
    let found = Spectrum::new(&spectrum.name, &spectrum.wavelengths_nm, &spectrum.power);
    let lit = scene.with_surfaces_alone(is_of_it);
    let spectrum = found.map_err(|error| Error::scene(&origin, format!("its spectrum cannot be used: {error}")))?;
    Ok(SourceScene { scene: alone(lit, is_of), spectrum })
}

/// With the lights that are wanted, and portals, which let their light in.
fn alone(mut scene: Scene, wanted: impl Fn(&Light) -> bool) -> Scene {
    scene.settings.spectral = true;
    scene.lights.retain(|light| light.portal || wanted(light));
    scene
}

fn daylight() -> Result<Spectrum> {
    named("D65").and_then(std::result::Result::ok).ok_or_else(|| Error::Internal("daylight D65 is not known".to_owned()))
}
