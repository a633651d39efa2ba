//! `gonio annual`: coefficients traced in a stage, and the year that a weather file makes of them.

use super::{
    as_json, calculate, draw,
    facades::facades,
    farm,
    inputs::{self, Inputs, Named},
    kept_path, pictures,
    plots::{self, Cells, Layout},
    series, settings, tell_doubts, tell_whole, text, whole,
};
use crate::{
    arguments::{AnnualOptions, RoundArguments},
    checkpoint::{every, part_of},
    file::{check_targets, print_path},
    measure::{apply_settings, author_grids, watched},
    messages::{diagnostics_json, print, tell},
    progress::Reporter,
    render::{stage_options, variants},
    stage::Stage,
};
use gonio::{
    Diagnostic, Result,
    annual::{AnnualGrid, AnnualTask, Checkpoints, Facade, GridsTraced, trace},
    measure::Watch,
    scene::{Integrator, Scene, with_images},
    sky::Frame,
};
use gonio_annual::{Schedule, Year};
use gonio_simd::Execution;
use gonio_usd::{Loaded, SampleTime, daylight::up_axis};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::sync::atomic::AtomicBool;

/// What the year is calculated of.
struct Task<'a> {
    options: &'a AnnualOptions,
    year: &'a Year,
    schedule: &'a Schedule,
    facades: &'a [Facade],
    /// With open blinds, then those with closed ones.
    scenes: &'a [Scene],
    frame: Frame,
    /// What the stage told.
    told: &'a [Diagnostic],
}

/// Traces the stage's grids and calculates their year.
pub(crate) fn annual(py: Python<'_>, options: &AnnualOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let weather = inputs::weather(&options.year)?;
    let (year, schedule) = inputs::year(&options.year, inputs::positions(&options.year), &weather)?;
    tell_doubts(&options.year, &year);
    let (facades, states) = facades(&options.facades, &year)?;
    let Loaded { scene, diagnostics, info, .. } = load(py, options, &[], interrupted)?;
    let mut scenes = vec![scene];
    for state in &states {
        scenes.push(load(py, options, state, interrupted)?.scene);
    }
    if options.farm.dask.is_some() {
        scenes = scenes.iter().map(with_images).collect();
    }
    let frame = Frame { up_axis: up_axis(info.up_axis), north_deg: options.year.north };
    let (year, schedule, facades) = (&year, &schedule, &facades[..]);
    let task = Task { options, year, schedule, facades, scenes: &scenes, frame, told: &diagnostics };
    if options.farm.dask.is_none() {
        let checkpoints = checkpoints(&options.rounds)?;
        return py.detach(|| calculated(&task, &checkpoints, interrupted));
    }
    farm::traced(py, options, (&scenes, facades), (&weather, frame.up_axis), |merge| {
        py.detach(|| calculated(&task, &Checkpoints { merge, ..Checkpoints::default() }, interrupted))
    })
}

/// Traces what checkpoints do not have, calculates, tells and writes.
fn calculated(task: &Task<'_>, checkpoints: &Checkpoints, interrupted: &'static AtomicBool) -> Result<i32> {
    let Task { options, year, schedule, facades, scenes, frame, told } = *task;
    let tell = |diagnostics: &[Diagnostic]| tell(&options.stage, options.quiet, diagnostics);
    tell(told);
    let (grids, left_out) = AnnualGrid::all(&scenes[0])?;
    tell(&left_out);
    if let Some(folder) = &options.year.output {
        let files = |grid: &AnnualGrid| {
            series::paths(folder, &grid.name).into_iter().chain(pictures::paths(folder, &grid.name)).chain(plots::paths(folder, &grid.name))
        };
        check_targets(grids.iter().flat_map(files).chain([kept_path(folder)]).collect::<Vec<_>>().iter())?;
    }
    let traced = AnnualTask { year, frame, factor: options.factor, facades, closed: &scenes[1..] };
    let follow = |watch: &mut Watch<'_>| trace(&scenes[0], &grids, (&traced, checkpoints), Execution::detect(), watch);
    let GridsTraced { groups, diagnostics } = watched(Reporter::new(options.quiet), None, interrupted, follow)?;
    tell(&diagnostics);
    let Some(groups) = groups else { return Ok(0) };
    let named = |(grid, groups): (&AnnualGrid, _)| Named { name: grid.name.clone(), groups };
    let named = grids.iter().zip(groups).map(named).collect();
    let told: Vec<Diagnostic> = told.iter().chain(&left_out).chain(&diagnostics).cloned().collect();
    let names: Vec<&str> = facades.iter().map(|facade| facade.name.as_str()).collect();
    let positions = inputs::positions(&options.year);
    let inputs = Inputs { year: year.clone(), positions, schedule: schedule.clone(), grids: named };
    finish((options, &names), &inputs, (&grids, &told), interrupted)
}

/// Where rounds are kept.
fn checkpoints(options: &RoundArguments) -> Result<Checkpoints> {
    Ok(Checkpoints {
        path: options.checkpoint.clone(),
        every: every(options.keeping.checkpoint_every)?,
        resume: options.keeping.resume,
        part: options.part.as_deref().map(part_of).transpose()?,
        merge: options.merge.clone(),
    })
}

/// The stage with some more variants chosen.
fn load(py: Python<'_>, options: &AnnualOptions, more: &[String], interrupted: &'static AtomicBool) -> Result<Loaded> {
    let mut stage_options = stage_options(&options.stage)?;
    stage_options.time = SampleTime::Start;
    stage_options.variants.extend(variants("closed-variant", more)?);
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    author_grids(py, &stage, &options.grids, None)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    if !options.grids.grid.is_empty() {
        // Who names a grid has not asked for those of the stage besides.
        loaded.scene.grids.retain(|grid| options.grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    }
    apply_settings(&mut loaded.scene, (options.spp, options.max_bounces), Integrator::Path, (&options.work, &options.textures));
    Ok(loaded)
}

/// Calculates every grid, tells and writes.
fn finish(
    (options, facades): (&AnnualOptions, &[&str]),
    inputs: &Inputs,
    (grids, told): (&[AnnualGrid], &[Diagnostic]),
    interrupted: &AtomicBool,
) -> Result<i32> {
    let settings = settings(&options.year, Some(&options.lighting), options.work.threads)?;
    let mut found = Vec::new();
    for (named, traced) in inputs.grids.iter().zip(grids) {
        let (grid, series) = calculate(&options.year, inputs, named, &settings, interrupted)?;
        let layout = Layout::of(traced);
        let cells = Cells::of(traced, layout.as_ref());
        draw(&options.year, &inputs.year, (&named.name, &grid, layout.as_ref()), series.as_ref())?;
        if let (Some(folder), Some(series)) = (&options.year.output, series) {
            let written = pictures::draw(folder, &named.name, (&grid, &cells), &inputs.year, &series.means())?;
            written.iter().filter(|_| !options.year.json).for_each(|path| print_path(path));
        }
        if !options.year.json {
            let closed = text::closed(facades, &grid.closed_hours);
            text::lines(&named.name, &grid, &options.metrics).iter().chain(&closed).for_each(|line| print(line));
        }
        let mut json = placed(as_json(named, &grid), &traced.positions, &cells);
        if !options.facades.group.is_empty() {
            json["groups"] = json!(facades);
        }
        found.push(json);
    }
    let mut whole = whole(&options.year, inputs, found);
    whole["diagnostics"] = diagnostics_json(told);
    tell_whole(&options.year, &whole)?;
    Ok(0)
}

/// A grid with the places of its points.
fn placed(mut grid: Value, positions: &[[f64; 3]], cells: &Cells) -> Value {
    for (point, position) in grid["points"].as_array_mut().into_iter().flatten().zip(positions) {
        point["position_m"] = json!(position);
    }
    cells.tell(&mut grid);
    grid
}
