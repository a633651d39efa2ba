//! Light that comes straight from luminaires to eyes, for ratings of glare that do not ask how bright a source is, but how much light it sends (CIE 112).

use super::eye::Eye;
use crate::{
    compile::{CompiledScene, luminaires},
    error::{Error, Result},
    scene::{Measurand, Meter, Origin, Scene},
    threads::in_pool,
};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// What comes straight to an eye.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StraightLight {
    /// Unit directions from it, and the illuminance that comes from each, lx across it.
    pub sources: Vec<([f64; 3], f64)>,
    /// Whether it sees any luminaire through glass or a cover alone, whose light is left out.
    pub sees_covered: bool,
}

/// To eyes at some places, from all luminaires that nothing opaque hides; `compiled` is of this scene.
///
/// # Errors
/// Places that are not finite, cancellation.
pub fn straight_light(scene: &Scene, compiled: &CompiledScene, places: &[[f64; 3]], cancel: &AtomicBool) -> Result<Vec<StraightLight>> {
    let luminaires = luminaires(scene, compiled.tables.origin, &compiled.light_images.means(scene));
    let to = |place: &[f64; 3]| {
        if cancel.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
        let eye = Eye::new(&eye_at(*place))?;
        let (light, covered): (Vec<_>, Vec<bool>) = luminaires.iter().map(|luminaire| eye.straight(luminaire, compiled)).unzip();
        Ok(StraightLight { sources: light.concat(), sees_covered: covered.contains(&true) })
    };
    in_pool(|| places.par_iter().map(to).collect())
}

/// Which way it looks does not matter.
fn eye_at(position: [f64; 3]) -> Meter {
    let [normal, facing] = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
    Meter { origin: Origin::new("eye"), position, normal, facing, measurand: Measurand::Illuminance }
}
