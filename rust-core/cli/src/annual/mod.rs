//! `gonio annual-metrics`.

mod inputs;
mod series;
mod text;

use super::{
    arguments::AnnualOptions,
    file::{check_targets, print_path},
    messages::{print, say},
};
use gonio::{Error, Result, threads::available_threads};
use gonio_annual::{AnnualError, Chunk, Grid, Settings, evaluate};
use inputs::{Inputs, Named};
use serde_json::{Value, json};
use series::Series;
use std::sync::atomic::{AtomicBool, Ordering};

/// Reads weather and coefficients, calculates every grid, and writes what was asked for.
pub(super) fn annual_metrics(options: &AnnualOptions, interrupted: &AtomicBool) -> Result<i32> {
    let settings = settings(options)?;
    if let Some(folder) = &options.output {
        check_targets(inputs::grid_names(options).iter().flat_map(|name| series::paths(folder, name)).collect::<Vec<_>>().iter())?;
    }
    let inputs = Inputs::read(options)?;
    inputs.year.doubts.iter().for_each(|doubt| say(&format!("warning: {}: {doubt}", options.weather.display())));
    let mut grids = Vec::new();
    for named in &inputs.grids {
        let grid = calculate(options, &inputs, named, &settings, interrupted)?;
        if !options.json {
            text::lines(&named.name, &grid).iter().for_each(|line| print(line));
        }
        grids.push(as_json(named, &grid));
    }
    if options.json {
        print(&whole(options, &inputs, grids).to_string());
    }
    Ok(0)
}

/// One grid, whose series is written if that is asked for.
fn calculate(options: &AnnualOptions, inputs: &Inputs, named: &Named, settings: &Settings, interrupted: &AtomicBool) -> Result<Grid> {
    let mut series = options.output.is_some().then(|| Series::new(named.groups[0].open.points, inputs.year.steps.len()));
    let mut take = |chunk: &Chunk<'_>| {
        series.iter_mut().for_each(|series| series.take(chunk));
        !interrupted.load(Ordering::Relaxed)
    };
    let grid = evaluate(&inputs.year, &inputs.schedule, &named.groups, settings, &mut take).map_err(told)?;
    let grid = grid.ok_or(Error::Cancelled)?;
    if let (Some(folder), Some(series)) = (&options.output, series) {
        let written = series.write(folder, &named.name, &grid)?;
        written.iter().filter(|_| !options.json).for_each(|path| print_path(path));
    }
    Ok(grid)
}

fn settings(options: &AnnualOptions) -> Result<Settings> {
    let threads = if options.threads == 0 { available_threads() } else { options.threads as usize };
    Ok(Settings { sky: inputs::sky(options)?, memory: usize::try_from(options.memory).unwrap_or(usize::MAX), threads })
}

/// A year's error as the command line's.
fn told(error: AnnualError) -> Error {
    match error {
        AnnualError::Content { path, error } => Error::in_file(path, &error),
        AnnualError::Setting { name, problem } => Error::setting(name, problem),
    }
}

fn as_json(named: &Named, grid: &Grid) -> Value {
    let mut value = json!(grid);
    if let Value::Object(object) = &mut value {
        object.insert("name".into(), json!(named.name));
    }
    value
}

fn whole(options: &AnnualOptions, inputs: &Inputs, grids: Vec<Value>) -> Value {
    let year = &inputs.year;
    json!({
        "weather": options.weather.to_string_lossy(),
        "place": year.place,
        "latitude_deg": year.latitude_deg,
        "longitude_deg": year.longitude_deg,
        "steps": year.steps.len(),
        "schedule": options.schedule,
        "doubts": year.doubts,
        "grids": grids,
    })
}
