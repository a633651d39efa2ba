//! `gonio annual` and `gonio annual-metrics`: a year of daylight.

mod facades;
mod farm;
pub(super) mod glare;
mod inputs;
mod pictures;
mod series;
mod text;
pub(super) mod trace;

use super::{
    arguments::{AnnualMetricsOptions, LightingArguments, YearArguments},
    file::{check_targets, print_path},
    messages::{print, say},
};
use gonio::{Error, Result, annual::told, threads::available_threads};
use gonio_annual::{Chunk, Grid, Series, Settings, Year, evaluate};
use inputs::{Inputs, Named};
use serde_json::{Value, json};
use std::sync::atomic::{AtomicBool, Ordering};

/// Reads weather and coefficients, calculates every grid, and writes what was asked for.
pub(super) fn annual_metrics(options: &AnnualMetricsOptions, interrupted: &AtomicBool) -> Result<i32> {
    let mut settings = settings(&options.year, Some(&options.lighting), options.threads)?;
    settings.sky.rotation_deg = -options.year.north;
    if let Some(folder) = &options.year.output {
        check_targets(inputs::grid_names(options).iter().flat_map(|name| series::paths(folder, name)).collect::<Vec<_>>().iter())?;
    }
    let inputs = Inputs::read(options)?;
    tell_doubts(&options.year, &inputs.year);
    let mut grids = Vec::new();
    for named in &inputs.grids {
        let grid = calculate(&options.year, &inputs, named, &settings, interrupted)?.0;
        if !options.year.json {
            text::lines(&named.name, &grid, &[]).iter().for_each(|line| print(line));
        }
        grids.push(as_json(named, &grid));
    }
    if options.year.json {
        print(&whole(&options.year, &inputs, grids).to_string());
    }
    Ok(0)
}

fn tell_doubts(options: &YearArguments, year: &Year) {
    year.doubts.iter().for_each(|doubt| say(&format!("warning: {}: {doubt}", options.weather.display())));
}

/// One grid, and its series where that was asked for and so written.
fn calculate(
    options: &YearArguments,
    inputs: &Inputs,
    named: &Named,
    settings: &Settings,
    interrupted: &AtomicBool,
) -> Result<(Grid, Option<Series>)> {
    let mut series = options.output.is_some().then(|| Series::new(named.groups[0].open.points, inputs.year.steps.len()));
    let mut take = |chunk: &Chunk<'_>| {
        series.iter_mut().for_each(|series| series.take(chunk));
        !interrupted.load(Ordering::Relaxed)
    };
    let grid = evaluate(&inputs.year, &inputs.schedule, &named.groups, settings, &mut take).map_err(told)?;
    let grid = grid.ok_or(Error::Cancelled)?;
    if let (Some(folder), Some(series)) = (&options.output, &series) {
        let written = series::write(series, folder, &named.name, &grid)?;
        written.iter().filter(|_| !options.json).for_each(|path| print_path(path));
    }
    Ok((grid, series))
}

fn settings(options: &YearArguments, lighting: Option<&LightingArguments>, threads: u32) -> Result<Settings> {
    let threads = if threads == 0 { available_threads() } else { threads as usize };
    let (memory, electric) = (usize::try_from(options.memory).unwrap_or(usize::MAX), lighting.and_then(inputs::electric));
    Ok(Settings { sky: inputs::sky(options)?, memory, threads, electric })
}

fn as_json(named: &Named, grid: &Grid) -> Value {
    let mut value = json!(grid);
    if let Value::Object(object) = &mut value {
        object.insert("name".into(), json!(named.name));
    }
    value
}

fn whole(options: &YearArguments, inputs: &Inputs, grids: Vec<Value>) -> Value {
    let year = &inputs.year;
    json!({
        "weather": options.weather.to_string_lossy(),
        "place": year.place,
        "latitude_deg": year.latitude_deg,
        "longitude_deg": year.longitude_deg,
        "steps": year.steps.len(),
        "sun_position": inputs.positions.name(),
        "schedule": options.schedule,
        "doubts": year.doubts,
        "grids": grids,
    })
}
