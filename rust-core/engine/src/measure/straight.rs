//! Light that comes straight from luminaires to eyes, for ratings of glare that do not ask how bright a source is, but how much light it sends (CIE 112).

use super::{eye::Eye, sense::Plan, watch::Watch};
use crate::{
    compile::{compile, luminaires},
    error::{Diagnostic, Result},
    measure::sense::Probe,
    scene::{Measurand, Meter, Origin, Scene},
};

/// To one eye: unit directions from it, and the illuminance that comes from each, lx across it.
pub type StraightLight = Vec<([f64; 3], f64)>;

/// To eyes at some places, from all luminaires that nothing opaque hides; what differs from what was asked for is told.
///
/// # Errors
/// Places that are not finite, what compiling finds, cancellation.
pub fn straight_light(scene: &Scene, places: &[[f64; 3]], watch: &mut Watch<'_>) -> Result<(Vec<StraightLight>, Vec<Diagnostic>)> {
    let compiled = compile(scene, watch.previous, watch.cancel)?;
    let mut diagnostics = compiled.diagnostics.clone();
    let meters: Vec<Meter> = places.iter().map(|place| eye_at(*place)).collect();
    let probes = meters.iter().map(Probe::new).collect::<Result<Vec<_>>>()?;
    if Plan::new(&compiled, &probes, &scene.settings, watch).is_brought() {
        let message = "light of luminaires that mirrors and clear glass send to the eye does not count as glare: give the luminaire with its cover by an IES \
                       or EULUMDAT file";
        diagnostics.push(Diagnostic::warning(&Origin::new("glare"), message));
    }
    let luminaires = luminaires(scene, compiled.tables.origin);
    let to = |meter: &Meter| {
        let eye = Eye::new(meter)?;
        Ok(luminaires.iter().flat_map(|luminaire| eye.straight(luminaire, &compiled)).collect())
    };
    Ok((meters.iter().map(to).collect::<Result<_>>()?, diagnostics))
}

/// Which way it looks does not matter.
fn eye_at(position: [f64; 3]) -> Meter {
    let [normal, facing] = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
    Meter { origin: Origin::new("eye"), position, normal, facing, measurand: Measurand::Illuminance }
}
