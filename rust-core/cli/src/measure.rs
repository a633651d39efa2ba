//! `gonio measure`.

use super::{
    arguments::{GridArguments, MeasureOptions, MeasuringArguments, TextureArguments, WorkArguments},
    daylight, eyes, falsecolor,
    file::{check_ending, check_targets, print_path, put},
    glare::coverage_json,
    interrupt::goes_on,
    messages::diagnostics_json,
    messages::print,
    messages::tell,
    progress::Reporter,
    reading::{figure, places, reading_json, spaced, triple},
    render::stage_options,
    spectrum::figures_json,
    stage::{Stage, light_model},
};
use gonio::{
    Diagnostic, Error, Result,
    compile::CompiledScene,
    measure::{
        ColourReading, GridReading, MOST_BOUNCES, Measurements, MeterReading, Reading, SensorGrid, Summary, Watch, csv,
        measure as evaluate, value_picture,
    },
    output::{FalseColour, FalseColourScale},
    scene::{Integrator, Measurand, Meter, Origin, Scene},
};
use gonio_simd::Execution;
use gonio_usd::{Loaded, SampleTime, context::UpAxis};
use pyo3::prelude::*;
use serde_json::{Map, Value, json};
use std::{
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

/// Measures what stage and options ask for.
pub(super) fn measure(py: Python<'_>, options: &MeasureOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    for (option, path, ending) in [("output", &options.output, "png"), ("csv", &options.csv, "csv")] {
        path.iter().try_for_each(|path| check_ending(option, path, &[ending]))?;
    }
    check_targets(options.output.iter().chain(&options.csv))?;
    let (_stage, loaded) = loaded(py, &options.measuring, interrupted)?;
    py.detach(|| run(options, loaded, interrupted))
}

/// The stage with the meters and grids that are asked for, daylight and settings, once what is doubtful of it is told.
pub(super) fn loaded(py: Python<'_>, options: &MeasuringArguments, interrupted: &'static AtomicBool) -> Result<(Stage, Loaded)> {
    let measurand = options.quantity.as_deref().map(measurand).transpose()?;
    let mut stage_options = stage_options(&options.stage)?;
    stage_options.time = options.frame.map_or(SampleTime::Start, SampleTime::Code);
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    author_grids(py, &stage, &eyes::at_eyes(&options.grids, &options.eyes), measurand)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    eyes::open(&mut loaded.scene, &options.grids, &options.eyes, &options.facing)?;
    let points = points(options, measurand.unwrap_or(Measurand::Illuminance), loaded.info.up_axis)?;
    take_points(&mut loaded.scene, &options.grids, points);
    daylight::add(&options.daylight, &mut loaded, options.stage.strict, options.quiet)?;
    light_model(&options.stage.stage, &mut loaded, options.quiet);
    tell(&options.stage, options.quiet, &loaded.diagnostics);
    let limits = (options.spp, options.max_bounces);
    apply_settings(&mut loaded.scene, limits, options.integrator.into(), (&options.work, &options.textures));
    check_asked(&loaded.scene)?;
    Ok((stage, loaded))
}

/// The points of the command line, in place of all that it does not name.
pub(super) fn take_points(scene: &mut Scene, grids: &GridArguments, points: Vec<Meter>) {
    if !points.is_empty() {
        // Who asks for a point has not asked for what the stage would measure besides.
        scene.meters.clear();
        scene.grids.retain(|grid| grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    }
    scene.meters.extend(points);
}

/// Makes sure that anything is asked for.
pub(super) fn check_asked(scene: &Scene) -> Result<()> {
    let problem = "the stage has no gonio:grid or gonio:meter; name a surface with --grid /Prim or a point with --at X,Y,Z";
    if scene.meters.is_empty() && scene.grids.is_empty() { Err(Error::setting("grid", problem)) } else { Ok(()) }
}

fn measurand(name: &str) -> Result<Measurand> {
    Measurand::by_name(name).ok_or_else(|| {
        let expected = Measurand::NAMES.map(|(_, name)| name).join(", ");
        Error::setting("quantity", format!("'{name}' was found, expected one of {expected}"))
    })
}

/// Makes the prims that the command line names grids; without a quantity they measure their own, else illuminance.
pub(super) fn author_grids(py: Python<'_>, stage: &Stage, grids: &GridArguments, measurand: Option<Measurand>) -> Result<()> {
    let lengths = [grids.spacing, grids.margin, grids.height];
    grids.grid.iter().try_for_each(|prim| stage.usd("grid")?.author_grid(py, prim, measurand.map(Measurand::name), lengths))
}

fn run(options: &MeasureOptions, loaded: Loaded, interrupted: &'static AtomicBool) -> Result<i32> {
    let measuring = &options.measuring;
    let found = evaluated(&loaded.scene, None, Reporter::new(measuring.quiet), interrupted)?;
    tell(&measuring.stage, measuring.quiet, &found.diagnostics);
    if let Some(path) = &options.csv {
        put(path, csv(&found).as_bytes())?;
    }
    if let Some(path) = &options.output {
        let scale =
            |grid: &GridReading| Ok((grid.measurand.unit(), grid.scale(options.scale.max, options.scale.steps, options.scale.log)?));
        draw(&found.grids, path, !measuring.quiet && !measuring.json, scale)?;
    }
    if measuring.json {
        print(&as_json(&found, options.target, &loaded.diagnostics).to_string());
    } else {
        found.meters.iter().for_each(|meter| print(&meter_line(meter)));
        SensorGrid::all(&found.meters).iter().flat_map(sensor_grid_lines).for_each(|line| print(&line));
        found.grids.iter().flat_map(|grid| grid_lines(grid, options.target)).for_each(|line| print(&line));
    }
    Ok(0)
}

/// What the scene's meters and grids show, with its settings; the trees of `previous` are used again.
pub(super) fn evaluated(
    scene: &Scene,
    previous: Option<&CompiledScene>,
    reporter: Reporter,
    interrupted: &AtomicBool,
) -> Result<Measurements> {
    watched(reporter, previous, interrupted, |watch| evaluate(scene, Execution::detect(), watch))
}

/// Does what is watched as measurements are, and shows how far it is.
pub(super) fn watched<T>(
    mut reporter: Reporter,
    previous: Option<&CompiledScene>,
    interrupted: &AtomicBool,
    work: impl FnOnce(&mut Watch<'_>) -> Result<T>,
) -> Result<T> {
    let mut progress = |progress: &gonio::render::Progress| {
        reporter.show(progress);
        goes_on(interrupted)
    };
    let found = work(&mut Watch { previous, cancel: interrupted, progress: &mut progress });
    reporter.clear();
    found
}

/// Has points measured by so many samples each and at most so many bounces; without a limit by all that matter.
pub(super) fn apply_settings(
    scene: &mut Scene,
    (samples, max_bounces): (u32, Option<u32>),
    integrator: Integrator,
    (work, textures): (&WorkArguments, &TextureArguments),
) {
    let settings = &mut scene.settings;
    (settings.samples, settings.max_bounces) = (samples, max_bounces.unwrap_or(MOST_BOUNCES));
    settings.integrator = integrator;
    work.apply(settings);
    textures.apply(settings);
}

/// The meters of `--at`.
fn points(options: &MeasuringArguments, measurand: Measurand, axis: UpAxis) -> Result<Vec<Meter>> {
    let [up, ahead] = gonio_usd::meter::axes(axis);
    let direction = |name: &str, text: Option<&String>, otherwise| text.map_or(Ok(otherwise), |text| triple(name, text));
    if options.facing.len() > 1 && !options.at.is_empty() {
        return Err(Error::setting("facing", "points of --at face one way; several are for --eyes"));
    }
    let (normal, facing) = (direction("normal", options.normal.as_ref(), up)?, direction("facing", options.facing.first(), ahead)?);
    let meter = |text: &String| {
        let position = triple("at", text)?;
        Ok(Meter { origin: Origin::new(text), position, normal, facing, measurand })
    };
    options.at.iter().map(meter).collect()
}

/// The grids' pictures: under the name given, or with each prim's name before its ending. Each has its unit and its scale; `tell` names the files.
pub(super) fn draw(
    grids: &[GridReading],
    path: &Path,
    tell: bool,
    scale: impl Fn(&GridReading) -> Result<(&'static str, FalseColourScale)>,
) -> Result<()> {
    if grids.is_empty() {
        return Err(Error::setting("output", "a value picture wants a grid; points alone have none"));
    }
    for (number, grid) in grids.iter().enumerate() {
        let (unit, scale) = scale(grid)?;
        let style = FalseColour { scale, unit: unit.into(), contours: true, smoothing: 0, legend: true };
        let path = if grids.len() == 1 { path.to_owned() } else { named(path, grid, number) };
        falsecolor::write(&path, &value_picture(grid, &style))?;
        if tell {
            print_path(&path);
        }
    }
    Ok(())
}

fn named(path: &Path, grid: &GridReading, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let prim = grid.origin.name.rsplit('/').next().unwrap_or_default();
    path.with_file_name(format!("{stem}.{number}-{prim}.png"))
}

fn meter_line(meter: &MeterReading) -> String {
    let (measurand, [x, y, z]) = (meter.meter.measurand, meter.meter.position);
    let (name, figure) = (measurand.name(), figure(&meter.reading, places(measurand, [4, 2]), &spaced(measurand)));
    let note = meter.note().map_or(String::new(), |note| format!("; {note}"));
    format!("{}: {name} {figure} at {x:.3}, {y:.3}, {z:.3} m{note}", meter.meter.origin)
}

/// The figures of a grid's points.
fn summary_lines(measurand: Measurand, summary: &Summary, evenness: bool) -> Vec<String> {
    let (unit, places) = (spaced(measurand), places(measurand, [2; 2]));
    let figure = |name: &str, reading: &Reading| format!("  {name}: {}", figure(reading, places, &unit));
    let mut lines = vec![figure("average", &summary.average), figure("least", &summary.min), figure("greatest", &summary.max)];
    if evenness && measurand.is_amount() {
        lines.push(format!("  U0 (least / average): {:.3}", summary.uniformity()));
        lines.push(format!("  Ud (least / greatest): {:.3}", summary.diversity()));
    }
    lines
}

fn sensor_grid_lines(grid: &SensorGrid) -> Vec<String> {
    let head = format!("{}: {}, {} points together", grid.name, grid.measurand.name(), grid.summary.points);
    std::iter::once(head).chain(summary_lines(grid.measurand, &grid.summary, true)).collect()
}

fn grid_lines(grid: &GridReading, target: Option<f64>) -> Vec<String> {
    let ([columns, rows], [along, across]) = (grid.size, grid.spacing);
    let ways = grid.eyes.as_ref().map_or(String::new(), |eyes| format!(", mean of {} directions of eyes", eyes.facings.len()));
    let (name, points) = (grid.measurand.name(), grid.summary.points);
    let mut lines =
        vec![format!("{}: {name}{ways}, {columns} × {rows} points ({points} measured), {along:.3} × {across:.3} m apart", grid.origin)];
    lines.extend(summary_lines(grid.measurand, &grid.summary, grid.eyes.is_none()));
    lines.extend(eyes::lines(grid));
    lines.extend(target.map(|target| eyes::reaching_line(grid, target)));
    lines.extend(grid.rating_note().map(|note| format!("  {note}")));
    lines
}

/// `of_stage`: what was not as asked before anything was measured.
fn as_json(found: &Measurements, target: Option<f64>, of_stage: &[Diagnostic]) -> Value {
    let meter = |meter: &MeterReading| {
        json!({
            "name": &*meter.meter.origin.name,
            "quantity": meter.meter.measurand.name(),
            "unit": meter.meter.measurand.unit(),
            "position_m": meter.meter.position,
            "value": meter.reading.value,
            "standard_error": meter.reading.standard_error,
            "ugr_coverage": meter.coverage.as_ref().map(coverage_json),
            "ugr_small_sources": meter.small.map(|small| small.count),
            "ugr_as_in_tables": meter.small.and_then(|small| small.tabular).as_ref().map(reading_json),
            "colour": meter.colour.as_ref().map(|colour| colour_json(colour)),
        })
    };
    let grid = |grid: &GridReading| {
        let mut all = summary_json(&grid.origin.name, grid.measurand, &grid.summary);
        let in_rows =
            |of: fn(&Reading) -> f64| json!(grid.points.iter().map(|point| point.map(|(_, reading)| of(&reading))).collect::<Vec<_>>());
        let more = [
            ("columns", json!(grid.size[0])),
            ("rows", json!(grid.size[1])),
            ("spacing_m", json!(grid.spacing)),
            ("area_m2", json!(grid.area)),
            ("ugr_coverage", json!(grid.coverage.iter().map(coverage_json).collect::<Vec<_>>())),
            ("ugr_small_sources", json!(grid.small.iter().map(|small| small.count).collect::<Vec<_>>())),
            ("ugr_as_in_tables", json!(grid.small.iter().map(|small| small.tabular.map(|reading| reading.value)).collect::<Vec<_>>())),
            ("colours", json!(grid.colours.iter().map(|colour| colour_json(colour)).collect::<Vec<_>>())),
            ("values", in_rows(|reading| reading.value)),
            ("standard_errors", in_rows(|reading| reading.standard_error)),
            ("eyes", eyes::eyes_json(grid)),
            ("target", eyes::reaching_json(grid, target)),
        ];
        all.extend(more.map(|(name, value)| (name.to_owned(), value)));
        Value::Object(all)
    };
    let sensors = SensorGrid::all(&found.meters);
    json!({
        "meters": found.meters.iter().map(meter).collect::<Vec<_>>(),
        "sensor_grids": sensors.iter().map(|grid| summary_json(&grid.name, grid.measurand, &grid.summary)).collect::<Vec<_>>(),
        "grids": found.grids.iter().map(grid).collect::<Vec<_>>(),
        "diagnostics": diagnostics_json(of_stage.iter().chain(&found.diagnostics)),
    })
}

/// The figures of points together.
fn summary_json(name: &str, measurand: Measurand, summary: &Summary) -> Map<String, Value> {
    let all = [
        ("name", json!(name)),
        ("quantity", json!(measurand.name())),
        ("unit", json!(measurand.unit())),
        ("points", json!(summary.points)),
        ("average", reading_json(&summary.average)),
        ("min", reading_json(&summary.min)),
        ("max", reading_json(&summary.max)),
        ("uniformity_u0", json!(summary.uniformity())),
        ("diversity_ud", json!(summary.diversity())),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// All that a spectrum says which a meter got, and the spectrum.
pub(super) fn colour_json(colour: &ColourReading) -> Value {
    let mut all = colour.figures.as_ref().map(figures_json).unwrap_or_default();
    let named = Measurand::OF_COLOUR.map(|measurand| (measurand.name(), colour.of(measurand)));
    let others = [("illuminance_lx", Some(colour.illuminance)), ("melanopic_edi_lx", colour.melanopic_edi())];
    all.extend(others.iter().map(|(name, reading)| ((*name).to_owned(), json!(reading.map(|reading| reading.value)))));
    let errors = named.into_iter().chain(others).map(|(name, reading)| (name, reading.map(|reading| reading.standard_error)));
    all.insert("standard_errors".to_owned(), Value::from_iter(errors.map(|(name, error)| (name.to_owned(), json!(error)))));
    let at_all = |of: fn(&Reading) -> f64| colour.spectrum.iter().map(of).collect::<Vec<_>>();
    all.insert("wavelengths_nm".to_owned(), json!(colour.wavelengths_nm()));
    all.insert("irradiance_w_m2_nm".to_owned(), json!(at_all(|reading| reading.value)));
    all.insert("irradiance_standard_errors".to_owned(), json!(at_all(|reading| reading.standard_error)));
    Value::Object(all)
}
