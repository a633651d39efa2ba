//! `gonio dim`.

mod asked;
mod contributions;
mod groups;
mod shown;
mod told;

use super::{
    arguments::DimOptions,
    file::{check_ending, check_targets, print_path, put},
    measure::loaded,
    messages::print,
};
use asked::Asked;
use gonio::Result;
use gonio_dimming::{Problem, Solution};
use gonio_usd::{Loaded, SampleTime};
use groups::LightGroup;
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;
use told::told;

/// Measures the groups, solves, and writes what was asked for; the status is 1 where a target is not met.
pub(super) fn dim(py: Python<'_>, options: &DimOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    if let Some(output) = &options.output {
        check_ending("output", output, &["usda"])?;
        check_targets([output])?;
    }
    let (stage, mut loaded) = loaded(py, &options.measuring, interrupted)?;
    let groups = LightGroup::all(options, &loaded)?;
    let asked = Asked::new(options, &loaded.scene, &groups)?;
    let lamps = groups.clone();
    let (problem, solution) = py.detach(|| solved(options, &mut loaded, groups, &asked, interrupted))?;
    if let Some(output) = &options.output {
        let factors = dimmed(&lamps, &solution);
        let time = options.measuring.frame.map_or(SampleTime::Start, SampleTime::Code);
        put(output, stage.usd("output")?.dimmed(py, &factors, time, output)?.as_bytes())?;
    }
    show(options, &problem, &lamps, &solution);
    Ok(i32::from(!solution.meets_all()))
}

/// What was measured of the groups, and the levels found; glare is rated at these.
fn solved(
    options: &DimOptions,
    loaded: &mut Loaded,
    groups: Vec<LightGroup>,
    asked: &Asked,
    interrupted: &'static AtomicBool,
) -> Result<(Problem, Solution)> {
    let areas = contributions::measured(&options.measuring, &mut loaded.scene, &groups, asked, interrupted)?;
    let lamps: Vec<Vec<usize>> = groups.iter().map(|group| group.lights.clone()).collect();
    let problem = Problem {
        groups: groups.into_iter().map(|group| group.group).collect(),
        areas,
        targets: asked.light.clone(),
        goal: asked.goal.clone(),
        errors_kept: options.errors,
    };
    let mut solution = problem.solve().map_err(|error| told("target", error))?;
    solution.targets.extend(contributions::glare(&options.measuring, &mut loaded.scene, (&lamps, &solution.levels), asked, interrupted)?);
    Ok((problem, solution))
}

/// The factors of the prims whose lights are dimmed.
fn dimmed(groups: &[LightGroup], solution: &Solution) -> Vec<(String, f64)> {
    let of_group = |(group, level): (&LightGroup, &f64)| {
        let level = *level;
        group.prims.iter().map(move |prim| (prim.clone(), level)).collect::<Vec<_>>()
    };
    groups.iter().zip(&solution.levels).filter(|(_, level)| **level < 1.0).flat_map(of_group).collect()
}

fn show(options: &DimOptions, problem: &Problem, groups: &[LightGroup], solution: &Solution) {
    if options.measuring.json {
        print(&shown::as_json(problem, groups, solution).to_string());
        return;
    }
    shown::lines(groups, solution).iter().for_each(|line| print(line));
    options.output.iter().filter(|_| !options.measuring.quiet).for_each(|output| print_path(output));
}
