//! `gonio annual` and `gonio annual-metrics`: a year of daylight.

mod facades;
mod farm;
pub(super) mod glare;
mod inputs;
mod pictures;
pub(super) mod plots;
pub(super) mod series;
mod text;
pub(super) mod trace;

use super::{
    arguments::{AnnualMetricsOptions, LightingArguments, YearArguments},
    file::{check_targets, print_path, put},
    messages::{print, say},
    words::Words,
};
use gonio::{Error, Result, annual::told, threads::available_threads};
use gonio_annual::{Chunk, Grid, Series, Settings, Year, evaluate};
use inputs::{Inputs, Named};
use plots::{Layout, Plots, Times};
use serde_json::{Value, json};
use std::{
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

/// Reads weather and coefficients, calculates every grid, and writes what was asked for.
pub(super) fn annual_metrics(options: &AnnualMetricsOptions, interrupted: &AtomicBool) -> Result<i32> {
    let mut settings = settings(&options.year, Some(&options.lighting), options.threads)?;
    settings.sky.rotation_deg = -options.year.north;
    if let Some(folder) = &options.year.output {
        let files = |name: &String| series::paths(folder, name).into_iter().chain(plots::paths(folder, name));
        check_targets(inputs::grid_names(options).iter().flat_map(files).chain([kept_path(folder)]).collect::<Vec<_>>().iter())?;
    }
    let inputs = Inputs::read(options)?;
    tell_doubts(&options.year, &inputs.year);
    let mut grids = Vec::new();
    for named in &inputs.grids {
        let (grid, series) = calculate(&options.year, &inputs, named, &settings, interrupted)?;
        draw(&options.year, &inputs.year, (&named.name, &grid, None), series.as_ref())?;
        if !options.year.json {
            text::lines(&named.name, &grid, &[]).iter().for_each(|line| print(line));
        }
        grids.push(as_json(named, &grid));
    }
    tell_whole(&options.year, &whole(&options.year, &inputs, grids))?;
    Ok(0)
}

/// The plots of a grid whose series was asked for.
fn draw(options: &YearArguments, year: &Year, (name, grid, layout): (&str, &Grid, Option<&Layout>), series: Option<&Series>) -> Result<()> {
    let (Some(folder), Some(series)) = (&options.output, series) else { return Ok(()) };
    let plots = Plots { name, grid, layout, words: Words::english() };
    let written = plots.write(folder, &Times::new(year), &series.means())?;
    written.iter().filter(|_| !options.json).for_each(|path| print_path(path));
    Ok(())
}

/// The file that keeps what `--json` prints.
pub(super) fn kept_path(folder: &Path) -> PathBuf {
    folder.join("year.json")
}

/// Prints all figures for machines where they are asked for, and keeps them beside series.
fn tell_whole(options: &YearArguments, whole: &Value) -> Result<()> {
    let text = whole.to_string();
    if let Some(folder) = &options.output {
        put(&kept_path(folder), text.as_bytes())?;
    }
    if options.json {
        print(&text);
    } else {
        options.output.iter().for_each(|folder| print_path(&kept_path(folder)));
    }
    Ok(())
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
    let Times { step_hours, sunrise_sunset_h } = Times::new(year);
    json!({
        "weather": options.weather.to_string_lossy(),
        "place": year.place,
        "latitude_deg": year.latitude_deg,
        "longitude_deg": year.longitude_deg,
        "steps": year.steps.len(),
        "step_hours": step_hours,
        "sunrise_sunset_h": sunrise_sunset_h,
        "sun_position": inputs.positions.name(),
        "schedule": options.schedule,
        "doubts": year.doubts,
        "grids": grids,
    })
}
