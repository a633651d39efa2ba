//! The spectrum and the colour of a luminaire's lamps.

use super::{Reading, chromaticity};
use crate::scene::{Geometry, LampSpectrum, Scene};
use gonio_formats::gldf::ProductColour;
use gonio_spectrum::{Spectrum, figures};
use std::sync::Arc;

/// The spectra of all that shines, each once; `None` is one that is not known.
#[derive(Clone, Debug, Default)]
pub(super) struct Lamps(Vec<Option<Arc<LampSpectrum>>>);

impl Lamps {
    /// Of the lights, and of the surfaces that shine.
    pub(super) fn of(scene: &Scene) -> Self {
        let placed = scene.instances.iter().filter(|set| matches!(set.geometry, Geometry::Mesh(_)));
        let mut materials: Vec<usize> = placed.flat_map(|set| &set.materials).map(|material| material.index()).collect();
        materials.sort_unstable();
        materials.dedup();
        let shining = materials.iter().filter_map(|index| scene.materials.get(*index)).filter(|material| material.shines());
        let mut found: Vec<Option<Arc<LampSpectrum>>> = Vec::new();
        let of_lights = scene.lights.iter().map(|light| light.lamp_spectrum().cloned());
        for spectrum in of_lights.chain(shining.map(|material| material.spectrum.clone())) {
            if !found.contains(&spectrum) {
                found.push(spectrum);
            }
        }
        Self(found)
    }

    /// The colour of the light source, and its spectrum if all that shines has the same: without one it is the colour of what left.
    pub(super) fn found(&self, reading: &Reading, tell: &mut impl FnMut(String)) -> (ProductColour, Vec<(f64, f64)>) {
        let without = || (colour_of_light(reading), Vec::new());
        let [Some(lamp)] = &self.0[..] else {
            if self.0.iter().any(Option::is_some) {
                let count = self.0.iter().flatten().count();
                let rest = if self.0.contains(&None) { " and lamps without one" } else { "" };
                tell(format!("the lamps have {count} spectra{rest}: none is written, and the colour is that of the light that leaves"));
            }
            return without();
        };
        let Ok(spectrum) = Spectrum::new(&lamp.name, &lamp.wavelengths_nm, &lamp.power) else { return without() };
        let points = spectrum.wavelengths_nm.iter().copied().zip(spectrum.power.iter().copied()).collect();
        (colour_of(&spectrum), points)
    }
}

fn colour_of_light(reading: &Reading) -> ProductColour {
    ProductColour { temperature: reading.colour_temperature(), chromaticity: chromaticity(reading), ..ProductColour::default() }
}

fn colour_of(spectrum: &Spectrum) -> ProductColour {
    let found = figures(spectrum);
    let white = found.white.as_ref();
    ProductColour {
        temperature: white.map(|white| white.cct),
        rendering: white.and_then(|white| white.rendering.as_ref()).map(|rendering| rendering.ra),
        chromaticity: Some(found.xy),
        rendition: white.and_then(|white| white.rendition.as_ref()).map(|rendition| [rendition.rf, rendition.rg]),
        melanopic: found.melanopic_der(),
    }
}
