//! Light that comes straight from luminaires to eyes, for ratings of glare that do not ask how bright a source is, but how much light it sends (CIE 112).

use super::{eye::Eye, watch::Watch};
use crate::{
    compile::{compile, luminaires},
    error::{Diagnostic, Result},
    scene::{Measurand, Meter, Origin, Scene},
};

/// To one eye: unit directions from it, and the illuminance that comes from each, lx across it.
pub type StraightLight = Vec<([f64; 3], f64)>;

/// To eyes at some places, from all luminaires that nothing opaque hides; whether each sees any through glass or a cover alone, whose light is left out;
/// and what differs from what was asked for.
///
/// # Errors
/// Places that are not finite, what compiling finds, cancellation.
pub fn straight_light(
    scene: &Scene,
    places: &[[f64; 3]],
    watch: &mut Watch<'_>,
) -> Result<(Vec<StraightLight>, Vec<bool>, Vec<Diagnostic>)> {
    let compiled = compile(scene, watch.previous, watch.cancel)?;
    let meters: Vec<Meter> = places.iter().map(|place| eye_at(*place)).collect();
    let luminaires = luminaires(scene, compiled.tables.origin);
    let (mut all, mut covered) = (Vec::new(), Vec::new());
    for meter in &meters {
        let eye = Eye::new(meter)?;
        let (light, behind): (Vec<_>, Vec<bool>) = luminaires.iter().map(|luminaire| eye.straight(luminaire, &compiled)).unzip();
        all.push(light.concat());
        covered.push(behind.contains(&true));
    }
    Ok((all, covered, compiled.diagnostics))
}

/// Which way it looks does not matter.
fn eye_at(position: [f64; 3]) -> Meter {
    let [normal, facing] = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
    Meter { origin: Origin::new("eye"), position, normal, facing, measurand: Measurand::Illuminance }
}
