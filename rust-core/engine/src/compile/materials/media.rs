//! Media as rows of the table that kernels read.

use crate::{
    error::Diagnostic,
    light::LightTable,
    scene::{Medium, Origin},
    transport::{self, MediumTable},
};

/// Tells that lights at infinity send nothing through what fills all of space.
pub(in crate::compile) fn report(atmosphere: &Medium, lights: &LightTable, diagnostics: &mut Vec<Diagnostic>) {
    let takes_light = atmosphere.absorption.iter().chain(&atmosphere.scattering).any(|x| *x > 0.0);
    if takes_light && lights.infinite_lights().next().is_some() {
        let problem =
            "it fills all of space, so that nothing arrives of skies and suns, which are infinitely far; a box of the medium ends it";
        diagnostics.push(Diagnostic::warning(&Origin::new("atmosphere"), problem));
    }
}

/// The largest magnitude of a mean cosine: beyond it light hardly turns at all.
const MOST_ANISOTROPY: f32 = 0.999;

/// Adds a medium and gives its row; `None` where nothing happens to light in it. What is out of range is held there, and told.
pub(super) fn add(
    medium: &Medium,
    origin: &Origin,
    fields: &[bool],
    table: &mut MediumTable,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<u32> {
    let field = match medium.field {
        // Fields that cannot be used have been told.
        Some(id) => fields.get(id.index()).filter(|usable| **usable).map(|_| id.0 + 1)?,
        None => 0,
    };
    let held = held(medium);
    if held != *medium {
        let problem =
            "coefficients of a medium are 0 or more and finite, its anisotropy is from -0.999 to 0.999; what is beyond is held there";
        diagnostics.push(Diagnostic::warning(origin, problem));
    }
    let Medium { absorption, scattering, emission, anisotropy, .. } = held;
    (!held.is_clear()).then(|| table.add(transport::Medium { absorption, scattering, emission, anisotropy, field }))
}

fn held(medium: &Medium) -> Medium {
    let finite = |x: f32| if x.is_finite() { x } else { 0.0 };
    let coefficient = |x: f32| finite(x).max(0.0);
    let anisotropy = if medium.anisotropy.is_finite() { medium.anisotropy.clamp(-MOST_ANISOTROPY, MOST_ANISOTROPY) } else { 0.0 };
    Medium {
        absorption: medium.absorption.map(coefficient),
        scattering: medium.scattering.map(coefficient),
        // Below zero it takes light away, as lamps of negative strength do.
        emission: medium.emission.map(finite),
        anisotropy,
        field: medium.field,
    }
}
