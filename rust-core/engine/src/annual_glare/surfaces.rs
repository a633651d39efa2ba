//! What eyes see of surfaces: luminances of directions before them by patches of the sky.

use super::Eye;
use crate::{
    annual::{AnnualTask, PointsTraced, under_sky},
    error::Result,
    measure::{DaylightCoefficients, Keeping, Kept, ROUNDS, SkyTask, Watch, trace_rounds},
    scene::{Measurand, Meter, Scene},
};
use gonio_annual::{Surfaces, sights};
use gonio_simd::Execution;

/// The finest division of the sky that lights surfaces: their light is scattered.
const FINEST: u32 = 2;
/// Independent estimates that rounds are put together to.
const ESTIMATES: usize = 4;
/// Paths of an eye's plane for one of each direction, and the fewest of these: no less than a block of pixels has in all rounds.
const PATHS_OF_A_PLANE: u32 = 32;
const FEWEST_PATHS: u32 = 256;

/// Traces what eyes, which look along unit vectors (east, north, up), see of surfaces, with open and closed blinds.
pub(super) fn trace_surfaces(
    scene: &Scene,
    (eyes, facings): (&[Eye], &[[f64; 3]]),
    task: &AnnualTask<'_>,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<Surfaces> {
    let mut weights = Vec::new();
    let mut points = Vec::new();
    for (eye, facing) in eyes.iter().zip(facings) {
        for sight in sights(*facing) {
            weights.push(sight.weight);
            let facing = task.frame.to_scene(sight.direction);
            points.push(Meter {
                origin: eye.origin.clone(),
                position: eye.position,
                facing,
                measurand: Measurand::Luminance,
                ..Meter::default()
            });
        }
    }
    let task = AnnualTask { factor: task.factor.min(FINEST), ..task.clone() };
    let states = under_sky(&task, points.len(), |sky| {
        // Scattered light alone is asked for: nothing straight, neither of suns nor of patches.
        let sky = SkyTask { suns: &[], place: &|_, _| None, ..*sky };
        let state = |scene: &Scene| {
            let mut scene = scene.clone();
            scene.settings.samples = (scene.settings.samples / PATHS_OF_A_PLANE).max(FEWEST_PATHS);
            let mut kept = Kept::default();
            let mut keeping = Keeping { kept: &mut kept, rounds: 0..ROUNDS, suns: false, finished: None };
            trace_rounds(&scene, &points, &sky, execution, watch, &mut keeping)?;
            Ok(DaylightCoefficients { all: estimates(kept), ..DaylightCoefficients::default() })
        };
        std::iter::once(scene).chain(task.closed).map(state).collect::<Result<Vec<_>>>()
    })?;
    let traced = PointsTraced { states, points: points.len(), diagnostics: Vec::new() };
    Ok(Surfaces { weights, windows: traced.groups(0..points.len(), task.facades)? })
}

/// Scattered light of rounds as fewer estimates, of as many rounds each.
fn estimates(kept: Kept) -> Vec<Vec<f32>> {
    let mut rounds = kept.rounds.into_iter().flatten().map(|round| round.scattered);
    let each = ROUNDS / ESTIMATES;
    let estimate = |mut sum: Vec<f32>, others: Vec<Vec<f32>>| {
        others.iter().for_each(|other| sum.iter_mut().zip(other).for_each(|(sum, value)| *sum += value));
        sum.iter_mut().for_each(|sum| *sum /= each as f32);
        sum
    };
    let mut found = Vec::with_capacity(ESTIMATES);
    while let Some(first) = rounds.next() {
        found.push(estimate(first, rounds.by_ref().take(each - 1).collect()));
    }
    found
}
