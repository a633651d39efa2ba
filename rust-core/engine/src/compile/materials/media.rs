//! Media as rows of the table that kernels read.

use crate::{
    bsdf::phase,
    error::Diagnostic,
    light::LightTable,
    scene::{Medium, Origin, Phase},
    transport::{self, MediumTable},
};

/// Tells that lights at infinity send nothing through what fills all of space.
pub(in crate::compile) fn report(atmosphere: &Medium, lights: &LightTable, diagnostics: &mut Vec<Diagnostic>) {
    let takes_light = atmosphere.field.is_none() && atmosphere.absorption.iter().chain(&atmosphere.scattering).any(|x| *x > 0.0);
    if takes_light && lights.infinite_lights().next().is_some() {
        let problem =
            "it fills all of space, so that nothing arrives of skies and suns, which are infinitely far; a box of the medium ends it";
        diagnostics.push(Diagnostic::warning(&Origin::new("atmosphere"), problem));
    }
}

/// The largest magnitude of a mean cosine: beyond it light hardly turns at all.
const MOST_ANISOTROPY: f32 = 0.999;
/// What the numbers of phase functions are held in. Fournier and Forand's would be a single direction at an index of 1 and where nothing goes back.
const ALPHA: [f32; 2] = [0.0, 1000.0];
const IOR: [f32; 2] = [1.001, 3.0];
const BACKSCATTER: [f32; 2] = [0.005, 0.499];
const DIAMETER: [f32; 2] = [0.0, 50.0];

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
    if (Medium { phase: medium.phase, ..held }) != *medium {
        let problem =
            "coefficients of a medium are 0 or more and finite, its anisotropy is from -0.999 to 0.999; what is beyond is held there";
        diagnostics.push(Diagnostic::warning(origin, problem));
    }
    if held.phase != medium.phase {
        let problem = "of a medium's phase function alpha is from 0 to 1000, ior from 1.001 to 3, backscatter from 0.005 to 0.499 and diameter \
                       from 0 to 50 micrometres; what is beyond is held there";
        diagnostics.push(Diagnostic::warning(origin, problem));
    }
    let Medium { absorption, scattering, emission, .. } = held;
    (!held.is_clear()).then(|| table.add(transport::Medium { absorption, scattering, emission, phase: phase_of(&held), field }))
}

/// The phase function that kernels know; what does not scatter needs none.
fn phase_of(held: &Medium) -> phase::Phase {
    let g = held.anisotropy;
    match held.phase {
        _ if held.scattering == [0.0; 3] => phase::Phase::HenyeyGreenstein { g },
        Phase::HenyeyGreenstein => phase::Phase::HenyeyGreenstein { g },
        Phase::Rayleigh => phase::Phase::Draine { g: 0.0, alpha: 1.0 },
        Phase::Draine { alpha } => phase::Phase::Draine { g, alpha },
        Phase::FournierForand { ior, backscatter } => phase::Phase::FournierForand { ior, backscatter },
        Phase::Mie { diameter } => phase::Phase::Mie { diameter },
    }
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
        phase: held_phase(medium.phase),
        field: medium.field,
    }
}

fn held_phase(phase: Phase) -> Phase {
    let within = |x: f32, [low, high]: [f32; 2]| if x.is_nan() { low } else { x.clamp(low, high) };
    match phase {
        Phase::HenyeyGreenstein | Phase::Rayleigh => phase,
        Phase::Draine { alpha } => Phase::Draine { alpha: within(alpha, ALPHA) },
        Phase::FournierForand { ior, backscatter } => {
            Phase::FournierForand { ior: within(ior, IOR), backscatter: within(backscatter, BACKSCATTER) }
        }
        Phase::Mie { diameter } => Phase::Mie { diameter: within(diameter, DIAMETER) },
    }
}
