//! A year of daylight glare at eyes in a scene: traced coefficients as `gonio_annual::GlareYear` takes them.

use crate::{
    annual::{AnnualTask, coefficients, matrix},
    error::{Diagnostic, Error, Result},
    measure::Watch,
    scene::{Meter, Origin, Scene},
};
use gonio_annual::{Division, Group, SkyView};
use gonio_simd::Execution;

/// Somebody who looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Eye {
    /// What it is called.
    pub origin: Origin,
    /// Where it is in the scene, metres.
    pub position: [f64; 3],
    /// Where it looks in the scene; any length.
    pub facing: [f64; 3],
}

/// What eyes see.
#[derive(Debug)]
pub struct EyesTraced {
    /// The light at their planes: a point an eye.
    pub group: Group,
    /// What each sees of the sky.
    pub views: Vec<SkyView>,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

/// Traces eyes: `scene.settings.samples` paths each. Blinds are as the scene has them.
///
/// # Errors
/// Eyes without a direction, what compiling finds, coefficients that would take too much memory, cancellation.
pub fn trace_eyes(scene: &Scene, eyes: &[Eye], task: &AnnualTask<'_>, execution: Execution, watch: &mut Watch<'_>) -> Result<EyesTraced> {
    let facings = eyes.iter().map(unit_facing).collect::<Result<Vec<_>>>()?;
    let plane = |(eye, facing): (&Eye, &[f64; 3])| Meter {
        origin: eye.origin.clone(),
        position: eye.position,
        normal: *facing,
        ..Meter::default()
    };
    let planes: Vec<Meter> = eyes.iter().zip(&facings).map(plane).collect();
    let found = coefficients(scene, &planes, task, execution, watch)?;
    let rows = 0..eyes.len();
    let patches = Division::count(task.factor);
    let division = Division::new(task.factor).ok_or_else(|| Error::setting("factor", "expected 1 to 6"))?;
    // What is not scattered comes straight from the patches.
    let straight: Vec<Vec<f32>> = found
        .all
        .iter()
        .zip(&found.scattered)
        .map(|(all, scattered)| all.iter().zip(scattered).map(|(a, b)| (a - b).max(0.0)).collect())
        .collect();
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| task.frame.to_scene(axis));
    let view = |(eye, facing): (usize, &[f64; 3])| {
        let compass = axes.map(|axis| axis.iter().zip(facing).map(|(a, b)| a * b).sum::<f64>());
        let rounds = straight.iter().map(|round| &round[eye * patches..][..patches]);
        SkyView::new(&division, compass, rounds)
    };
    let views = facings.iter().enumerate().map(view).collect();
    let group = Group {
        open: matrix(&found.all, eyes.len(), rows.clone())?,
        scattered: Some(matrix(&found.scattered, eyes.len(), rows.clone())?),
        direct: Some(matrix(std::slice::from_ref(&found.suns), eyes.len(), rows)?),
        sun: None,
        blinds: None,
        closed: None,
    };
    Ok(EyesTraced { group, views, diagnostics: found.diagnostics })
}

fn unit_facing(eye: &Eye) -> Result<[f64; 3]> {
    let length = eye.facing.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        Ok(eye.facing.map(|part| part / length))
    } else {
        Err(Error::scene(&eye.origin, "an eye looks nowhere; its direction is zero or no number"))
    }
}
