//! What is measured by wavelengths: melanopic light, and figures of the light's colour.

pub(super) mod colour;
mod colour_reading;
pub(super) mod melanopic;
mod sources;

pub use colour_reading::ColourReading;
pub(crate) use sources::{SourceScene, by_spectrum};

use crate::{
    error::{Diagnostic, Error, Result},
    scene::{Light, LightShape, Material, Origin, Scene},
};

/// Checks whether the colours of a scene's lights stand in for spectra that nobody knows, in figures of this name at meters of an origin.
///
/// # Errors
/// Lamps and surfaces that shine without a spectrum.
pub(crate) fn check_spectra(scene: &Scene, of: &Origin, figures: &str, diagnostics: &mut Vec<Diagnostic>) -> Result<()> {
    if let Some(lamp) = lamps_by_colour_alone(scene).next() {
        let problem =
            format!("{figures} want its spectrum, which its colour does not tell: give it gonio:spectrum, a file or a name such as LED-B3");
        return Err(Error::scene(&lamp.origin, problem));
    }
    if let Some(surface) = surfaces_without_spectra(scene).next() {
        let problem =
            format!("it shines, and {figures} want its spectrum, which its colour does not tell: give it gonio:spectrum, a file or a name");
        return Err(Error::scene(&surface.origin, problem));
    }
    if by_colour_alone(scene).next().is_some() {
        diagnostics.push(Diagnostic::info(of, "sun and sky without a spectrum count as daylight D65 of their colour"));
    }
    if scene.media_shine() {
        let message = format!("fire and haze that shine have no spectrum; in {figures} they count as daylight D65 of their colour");
        diagnostics.push(Diagnostic::warning(of, message));
    }
    Ok(())
}

/// Whether lamps or surfaces shine of which the colour alone is known: figures of colour rendering and melanopic light are not.
pub(crate) fn is_by_colours(scene: &Scene) -> bool {
    lamps_by_colour_alone(scene).next().is_some() || surfaces_without_spectra(scene).next().is_some()
}

/// The same of lamps, sun and sky left aside.
fn lamps_by_colour_alone(scene: &Scene) -> impl Iterator<Item = &Light> {
    by_colour_alone(scene).filter(|light| !matches!(light.shape, LightShape::Dome { .. } | LightShape::Distant { .. }))
}

/// Lights that shine, and of which the colour alone is known.
fn by_colour_alone(scene: &Scene) -> impl Iterator<Item = &Light> {
    without_spectra(scene).filter(|light| light.colour_spectra.is_none())
}

/// Lights that shine without a spectrum, of which the spectra of their colours may be known.
fn without_spectra(scene: &Scene) -> impl Iterator<Item = &Light> {
    scene.lights.iter().filter(|light| light.lamp_spectrum().is_none() && shines(light))
}

/// Materials of surfaces that shine without a spectrum.
fn surfaces_without_spectra(scene: &Scene) -> impl Iterator<Item = &Material> {
    let placed = scene.instances.iter().filter(|set| !set.transforms.is_empty());
    let used = placed.flat_map(|set| &set.materials).filter_map(|id| scene.materials.get(id.index()));
    used.filter(|material| material.spectrum.is_none() && material.shines())
}

fn shines(light: &Light) -> bool {
    !light.portal && light.share() != 0.0
}
