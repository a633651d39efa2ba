//! The sky and the suns of a year as rays meet them.

use super::AnnualTask;
use crate::{
    error::{Error, Result},
    measure::{ROUNDS, SkyTask},
};
use gonio_annual::{
    Division, Patch, SUN_ANGLE_DEG, Year,
    sky::{SkyMatrix, SkyOptions},
};

/// Bytes that coefficients may take before they are refused.
const MOST_BYTES: f64 = 16e9;

/// Steps of a year that tell how bright patches are, about.
const TOLD_BY: usize = 512;

/// Does something with the sky and the suns of a task, for so many points.
pub(crate) fn under_sky<T>(task: &AnnualTask<'_>, points: usize, then: impl FnOnce(&SkyTask<'_>) -> Result<T>) -> Result<T> {
    let AnnualTask { year, frame, factor, .. } = task;
    let division = Division::new(*factor).ok_or_else(|| Error::setting("factor", format!("{factor} was found, expected 1 to 6")))?;
    let patches = division.patches().len();
    let openings: Vec<Vec<String>> =
        task.facades.iter().filter(|facade| !facade.prims.is_empty()).map(|facade| facade.prims.clone()).collect();
    let parts = if openings.is_empty() { 1 } else { openings.len() + 1 };
    let bytes = 8.0 * (ROUNDS * parts * (1 + task.closed.len())) as f64 * points as f64 * patches as f64;
    if bytes > MOST_BYTES {
        let (wanted, most) = (bytes * 1e-9, MOST_BYTES * 1e-9);
        let problem = format!(
            "{points} points with {patches} patches want {wanted:.0} GB, expected at most {most:.0}; take a wider spacing or a smaller factor"
        );
        return Err(Error::setting("grids", problem));
    }
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| frame.to_scene(axis));
    let along = |axis: [f64; 3], direction: [f32; 3]| axis.iter().zip(direction).map(|(a, b)| a * f64::from(b)).sum::<f64>();
    let suns: Vec<[f64; 3]> = year.sunny_steps().iter().map(|step| frame.to_scene(year.steps[*step].sun.direction())).collect();
    let brightness = brightness(year, *factor);
    then(&SkyTask {
        patches,
        patch_of: &|direction| division.patch_of(axes.map(|axis| along(axis, direction))),
        place: &|patch, within| division.place(patch, within).map(|place| frame.to_scene(place).map(|x| x as f32)),
        solid_angle: &|patch| division.patches()[patch].solid_angle,
        brightness: &|patch| brightness.get(patch).copied().unwrap_or(1.0),
        suns: &suns,
        sun_angle: SUN_ANGLE_DEG.to_radians(),
        up: axes[2],
        openings: &openings,
    })
}

/// By patch its radiance over the light that a level surface has at the same time, the root of the mean square over the year: hours count alike, dark or
/// bright, and patches that the sun passes most.
fn brightness(year: &Year, factor: u32) -> Vec<f64> {
    let Ok(matrix) = SkyMatrix::new(year, SkyOptions { factor, ..SkyOptions::default() }) else { return Vec::new() };
    let lit: Vec<usize> = (0..year.steps.len()).filter(|step| matrix.conditions(*step).is_some()).collect();
    let chosen: Vec<usize> = lit.iter().copied().step_by(lit.len().div_ceil(TOLD_BY).max(1)).collect();
    let patches = matrix.division().patches();
    let mut sums = vec![0.0; patches.len()];
    for column in matrix.columns(&chosen, 1).chunks_exact(patches.len()) {
        let level = |(value, patch): (&f32, &Patch)| f64::from(*value) * patch.direction()[2].max(0.0) * patch.solid_angle;
        let level: f64 = column.iter().zip(patches).map(level).sum();
        if level > 0.0 {
            sums.iter_mut().zip(column).for_each(|(sum, value)| *sum += (f64::from(*value) / level).powi(2));
        }
    }
    sums.into_iter().map(|sum: f64| (sum / chosen.len().max(1) as f64).sqrt()).collect()
}
