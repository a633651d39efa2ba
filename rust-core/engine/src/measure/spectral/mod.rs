//! What is measured by wavelengths: melanopic light, and figures of the light's colour.

pub(super) mod colour;
mod colour_reading;
pub(super) mod melanopic;
mod sources;

pub use colour_reading::ColourReading;

use crate::{
    error::{Diagnostic, Error, Result},
    scene::{Light, LightShape, Origin, Scene},
};

/// Checks whether the colours of a scene's lights stand in for spectra that nobody knows, in figures of this name at meters of an origin.
///
/// # Errors
/// Lamps without a spectrum.
fn check_spectra(scene: &Scene, of: &Origin, figures: &str, diagnostics: &mut Vec<Diagnostic>) -> Result<()> {
    let is_sky = |light: &&Light| matches!(light.shape, LightShape::Dome { .. } | LightShape::Distant { .. });
    if let Some(lamp) = without_spectra(scene).find(|light| !is_sky(light)) {
        let problem =
            format!("{figures} want its spectrum, which its colour does not tell: give it gonio:spectrum, a file or a name such as LED-B3");
        return Err(Error::scene(&lamp.origin, problem));
    }
    if without_spectra(scene).next().is_some() {
        diagnostics.push(Diagnostic::info(of, "sun and sky without a spectrum count as daylight D65 of their colour"));
    }
    if scene.shines_without_spectra() {
        let message = format!(
            "surfaces, fire and haze shine without a spectrum; in {figures} they count as daylight D65 of their colour: give materials gonio:spectrum"
        );
        diagnostics.push(Diagnostic::warning(of, message));
    }
    Ok(())
}

/// Lights that shine without a spectrum.
fn without_spectra(scene: &Scene) -> impl Iterator<Item = &Light> {
    scene.lights.iter().filter(|light| light.spectrum.is_none() && shines(light))
}

fn shines(light: &Light) -> bool {
    !light.portal && light.dimming != 0.0
}
