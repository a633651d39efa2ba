//! `gonio emergency`.

use super::{Found, leave_burning, loaded, measured, not_counted, plan, show};
use crate::{arguments::EmergencyOptions, messages::tell};
use gonio::{
    Result,
    compile::luminous_intensities,
    measure::{IN_PART, StraightLight},
    scene::{Integrator, Scene},
};
use gonio_norms::{
    Reading, Spot,
    emergency::{Figures, Lamp, Plan, lines},
};
use pyo3::prelude::*;
use std::{collections::BTreeMap, sync::atomic::AtomicBool};

/// Degrees between directions in which intensities are asked for, across and down.
const STEPS_DEG: [f64; 2] = [5.0, 1.0];

/// Metres before a plane from which luminaires are looked at: it may lie on a surface.
const BEFORE: f64 = 1e-3;

/// Measures what the plan asks for and tells what it comes to.
pub(crate) fn emergency(py: Python<'_>, options: &EmergencyOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let (plan, options) = (plan(&options.plan, Plan::read)?, &options.norm);
    let (mut stage, up) = loaded(py, options, interrupted)?;
    let (scene, spots) = (&mut stage.scene, plan.spots(up));
    let burning = leave_burning(scene, &plan.groups, &plan.lights, "in an emergency")?;
    // What surfaces send on does not count (EN 1838).
    let Found { readings, straight, told } = measured(py, scene, (&spots, &before(&spots)), (options, Integrator::Direct), interrupted)?;
    let not_counted = not_counted(&straight, "points", "counted");
    // What measuring says of integrators is no way out here.
    let told = told.iter().filter(|diagnostic| not_counted.is_none() || diagnostic.message != IN_PART);
    tell(&options.stage, options.quiet, &told.chain(&not_counted).cloned().collect::<Vec<_>>());
    // Nothing but what is not counted may be all there is: no figure, and no zero.
    let known =
        |(reading, light): (Reading, &StraightLight)| if light.sees_covered && reading.lx <= 0.0 { Reading::UNKNOWN } else { reading };
    let readings: Vec<Reading> = readings.into_iter().zip(&straight).map(known).collect();
    let notes = not_counted.into_iter().map(|note| note.message).collect();
    let figures = Figures::new(&plan, &spots, &readings, seen(scene, &burning, &plan, up)).with_notes(notes);
    show(options, || figures.json(), || lines(&figures));
    Ok(0)
}

/// Places just before the points' planes.
fn before(spots: &[Spot]) -> Vec<[f64; 3]> {
    let lengths = spots.iter().map(|spot| spot.normal.iter().map(|x| x * x).sum::<f64>().sqrt());
    let place = |(spot, length): (&Spot, f64)| std::array::from_fn(|k| spot.position[k] + BEFORE * spot.normal[k] / length);
    spots.iter().zip(lengths).map(place).collect()
}

/// Luminaires with their height above the lowest floor of the plan and their greatest intensity within its angles; lights of one prim are one.
fn seen(scene: &Scene, burning: &[usize], plan: &Plan, up: [f64; 3]) -> Vec<Lamp> {
    let along = |p: [f64; 3]| p[0] * up[0] + p[1] * up[1] + p[2] * up[2];
    let corners = plan.routes.iter().flat_map(|route| &route.line).chain(plan.areas.iter().flat_map(|area| &area.outline));
    let floor = corners.map(|corner| along(*corner)).fold(f64::INFINITY, f64::min);
    let floor = if floor.is_finite() { floor } else { 0.0 };
    let intensities = luminous_intensities(scene, &directions(plan.glare_deg, up));
    let mut lamps: BTreeMap<&str, (f64, Vec<f64>)> = BTreeMap::new();
    for number in burning {
        let light = &scene.lights[*number];
        let Some(Some(found)) = intensities.get(*number) else { continue };
        let height = along(light.transform.point([0.0; 3])) - floor;
        let (_, sum) = lamps.entry(&light.origin.name).or_insert_with(|| (height, vec![0.0; found.len()]));
        sum.iter_mut().zip(found).for_each(|(sum, part)| *sum += part);
    }
    let lamp = |(name, (height, sum)): (&str, (f64, Vec<f64>))| Lamp {
        name: name.to_owned(),
        height,
        peak_cd: sum.into_iter().fold(0.0, f64::max),
    };
    lamps.into_iter().map(lamp).collect()
}

/// Directions between two angles from straight down, all around.
fn directions([from, to]: [f64; 2], up: [f64; 3]) -> Vec<[f64; 3]> {
    let side = [up[1], up[2], up[0]];
    let other = [up[1] * side[2] - up[2] * side[1], up[2] * side[0] - up[0] * side[2], up[0] * side[1] - up[1] * side[0]];
    let [around, down] = [(360.0 / STEPS_DEG[0]) as usize, ((to - from) / STEPS_DEG[1]).ceil().max(1.0) as usize];
    let direction = |k: usize, j: usize| {
        let (sin, cos) = (from + (to - from) * j as f64 / down as f64).to_radians().sin_cos();
        let (y, x) = (STEPS_DEG[0] * k as f64).to_radians().sin_cos();
        std::array::from_fn(|axis| sin * (x * side[axis] + y * other[axis]) - cos * up[axis])
    };
    (0..around).flat_map(|k| (0..=down).map(move |j| direction(k, j))).collect()
}
