//! `gonio sunlight`.

use super::{
    arguments::SunlightOptions,
    daylight, falsecolor,
    file::{check_ending, check_targets, print_path},
    interrupt::goes_on,
    measure::{author_grids, named, triple},
    messages::{list, print},
    progress::Reporter,
    render::{MOST_WARNINGS, stage_options},
    stage::Stage,
};
use gonio::{
    Error, Result,
    measure::{GridPoints, GridReading, MOST_POINTS, Watch, value_picture},
    output::{FalseColour, FalseColourScale},
    scene::{Grid, Meter, Origin},
    sky::{Frame, Moment},
    sunlight::{Sunlight, SunlightTask, sunlight as follow},
};
use gonio_simd::Execution;
use gonio_usd::{Loaded, daylight::up_axis};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::{path::Path, sync::atomic::AtomicBool};

/// Hours of sun on a day by EN 17037: least, medium, high.
const LEVELS: [(f64, &str); 3] = [(4.0, "high"), (3.0, "medium"), (1.5, "minimum")];
/// The days that EN 17037 lets choose from: month and day of the first and the last.
const DAYS: [(u32, u32); 2] = [(2, 1), (3, 21)];
/// Steps of the scale of pictures.
const STEPS: u32 = 10;

/// Follows the sun and tells when it shines where.
pub(super) fn sunlight(py: Python<'_>, options: &SunlightOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    options.output.iter().try_for_each(|path| check_ending("output", path, &["png"]))?;
    check_targets(&options.output)?;
    let (place, day) = daylight::place_and_time(&options.sun, options.elevation)?;
    let stage_options = stage_options(&options.stage)?;
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    author_grids(py, &stage, &options.grids, None)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    options.work.apply(&mut loaded.scene.settings);
    options.textures.apply(&mut loaded.scene.settings);
    take_points(options, &mut loaded)?;
    let frame = Frame { up_axis: up_axis(loaded.info.up_axis), north_deg: options.north };
    let task = SunlightTask { place, day, frame, least_elevation_deg: options.least_elevation, step_min: options.step };
    py.detach(|| run(options, &loaded, &task, interrupted))
}

/// The meters of `--at`, in place of the stage's.
fn take_points(options: &SunlightOptions, loaded: &mut Loaded) -> Result<()> {
    let [up, _] = gonio_usd::meter::axes(loaded.info.up_axis);
    let normal = options.normal.as_ref().map_or(Ok(up), |text| triple("normal", text))?;
    if !options.at.is_empty() {
        loaded.scene.meters.clear();
        loaded.scene.grids.retain(|grid| options.grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    }
    for text in &options.at {
        let position = triple("at", text)?;
        loaded.scene.meters.push(Meter { origin: Origin::new(text), position, normal, ..Meter::default() });
    }
    if loaded.scene.meters.is_empty() && loaded.scene.grids.is_empty() {
        let problem = "the stage has no gonio:grid or gonio:meter; name a surface with --grid /Prim or a point with --at X,Y,Z";
        return Err(Error::setting("grid", problem));
    }
    Ok(())
}

fn run(options: &SunlightOptions, loaded: &Loaded, task: &SunlightTask, interrupted: &AtomicBool) -> Result<i32> {
    let tell = |diagnostics: &[gonio::Diagnostic]| {
        if !options.quiet {
            list(diagnostics, if options.stage.verbose { usize::MAX } else { MOST_WARNINGS });
        }
    };
    tell(&loaded.diagnostics);
    let (meters, grids) = (&loaded.scene.meters, laid_out(loaded)?);
    let of_grids = grids.iter().flat_map(|(grid, points)| {
        points.known().map(|position| Meter { origin: grid.origin.clone(), position, normal: points.normal, ..Meter::default() })
    });
    let points: Vec<Meter> = meters.iter().map(|meter| Meter { measurand: Default::default(), ..meter.clone() }).chain(of_grids).collect();
    let mut reporter = Reporter::new(options.quiet);
    let mut progress = |progress: &gonio::render::Progress| {
        reporter.show(progress);
        goes_on(interrupted)
    };
    let mut watch = Watch { previous: None, cancel: interrupted, progress: &mut progress };
    let found = follow(&loaded.scene, &points, task, Execution::detect(), &mut watch);
    reporter.clear();
    let (found, diagnostics) = found?;
    tell(&diagnostics);
    let mut first = meters.len();
    let mut readings = Vec::new();
    for (grid, points) in grids {
        let hours: Vec<f64> = (first..first + points.known().count()).map(|point| found.hours(point)).collect();
        first += hours.len();
        readings.push(GridReading::of_values(&grid, points, &hours));
    }
    if let Some(path) = &options.output {
        draw(options, &readings, path)?;
    }
    if options.json {
        print(&as_json(&found, task, meters, &readings).to_string());
    } else {
        as_text(&found, task, meters, &readings).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// The stage's grids, whatever they measure, with their points.
fn laid_out(loaded: &Loaded) -> Result<Vec<(Grid, GridPoints)>> {
    let scene = &loaded.scene;
    let grids = scene.grids.iter().map(|grid| Ok((grid.clone(), GridPoints::new(scene, grid)?))).collect::<Result<Vec<_>>>()?;
    let count = scene.meters.len() + grids.iter().map(|(_, points)| points.known().count()).sum::<usize>();
    if count > MOST_POINTS {
        return Err(Error::setting("grids", format!("more than {MOST_POINTS} points in all; take a wider spacing")));
    }
    Ok(grids)
}

/// The grids' hours in false colour, on a scale up to the hours that there are.
fn draw(options: &SunlightOptions, readings: &[GridReading], path: &Path) -> Result<()> {
    if readings.is_empty() {
        return Err(Error::setting("output", "a picture of hours wants a grid; points alone have none"));
    }
    for (number, grid) in readings.iter().enumerate() {
        let scale = FalseColourScale::new(FalseColourScale::round_max(&grid.values()), STEPS, None)?;
        let style = FalseColour { scale, unit: "h".into(), contours: true, smoothing: 0, legend: true };
        let path = if readings.len() == 1 { path.to_owned() } else { named(path, grid, number) };
        falsecolor::write(&path, &value_picture(grid, &style))?;
        if !options.quiet && !options.json {
            print_path(&path);
        }
    }
    Ok(())
}

/// What EN 17037 calls so many hours of a day; none of days that it does not know.
fn level(hours: f64, day: &Moment) -> Option<&'static str> {
    let is_known = (DAYS[0]..=DAYS[1]).contains(&(day.month, day.day));
    let found = LEVELS.iter().find(|(least, _)| hours >= *least - 1e-9).map_or("below the minimum", |(_, name)| name);
    is_known.then_some(found)
}

fn clock(hours: f64) -> String {
    let minutes = (hours * 60.0).round() as u32;
    format!("{:02}:{:02}", minutes / 60, minutes % 60)
}

fn as_text(found: &Sunlight, task: &SunlightTask, meters: &[Meter], grids: &[GridReading]) -> Vec<String> {
    let Moment { year, month, day, utc_offset_h, .. } = task.day;
    let clock_of_place = format!("UTC{}{}", if utc_offset_h < 0.0 { '-' } else { '+' }, clock(utc_offset_h.abs()));
    let above = if task.least_elevation_deg > 0.0 { format!("{}° above the horizon", task.least_elevation_deg) } else { "up".to_owned() };
    let mut lines =
        vec![format!("{year}-{month:02}-{day:02}: the sun is {above} for {:.2} h (clock of {clock_of_place})", found.possible_hours())];
    for (number, meter) in meters.iter().enumerate() {
        let spans: Vec<String> = found.spans(number).iter().map(|[from, to]| format!("{}–{}", clock(*from), clock(*to))).collect();
        let spans = if spans.is_empty() { "never".to_owned() } else { spans.join(", ") };
        let level = level(found.hours(number), &task.day).map_or(String::new(), |level| format!("; EN 17037: {level}"));
        lines.push(format!("{}: {:.2} h of sun: {spans}{level}", meter.origin, found.hours(number)));
    }
    for grid in grids {
        let (columns, rows) = (grid.size[0], grid.size[1]);
        lines.push(format!("{}: hours of sun, {columns} × {rows} points ({} there)", grid.origin, grid.summary.points));
        let summary = [("average", &grid.summary.average), ("least", &grid.summary.min), ("greatest", &grid.summary.max)];
        lines.extend(summary.map(|(name, reading)| format!("  {name}: {:.2} h", reading.value)));
    }
    lines
}

fn as_json(found: &Sunlight, task: &SunlightTask, meters: &[Meter], grids: &[GridReading]) -> Value {
    let Moment { year, month, day, utc_offset_h, .. } = task.day;
    let meter = |(number, meter): (usize, &Meter)| {
        json!({
            "name": &*meter.origin.name,
            "position_m": meter.position,
            "normal": meter.normal,
            "hours": found.hours(number),
            "spans_h": found.spans(number),
            "en17037_level": level(found.hours(number), &task.day),
        })
    };
    let grid = |grid: &GridReading| {
        json!({
            "name": &*grid.origin.name,
            "columns": grid.size[0],
            "rows": grid.size[1],
            "spacing_m": grid.spacing,
            "average_h": grid.summary.average.value,
            "min_h": grid.summary.min.value,
            "max_h": grid.summary.max.value,
            "hours": grid.points.iter().map(|point| point.map(|(_, reading)| reading.value)).collect::<Vec<_>>(),
        })
    };
    let sun = |(hour, sun): &(f64, gonio::sky::SunPosition)| json!([hour, sun.azimuth_deg, sun.elevation_deg]);
    json!({
        "date": format!("{year}-{month:02}-{day:02}"),
        "utc_offset_h": utc_offset_h,
        "least_elevation_deg": task.least_elevation_deg,
        "step_min": task.step_min,
        "possible_h": found.possible_hours(),
        "sun": found.suns.iter().map(sun).collect::<Vec<_>>(),
        "meters": meters.iter().enumerate().map(meter).collect::<Vec<_>>(),
        "grids": grids.iter().map(grid).collect::<Vec<_>>(),
    })
}
