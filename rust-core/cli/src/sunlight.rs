//! `gonio sunlight`.

use super::{
    arguments::SunlightOptions,
    daylight,
    file::{check_ending, check_targets},
    measure::{author_grids, check_asked, draw, take_points, watched},
    messages::{print, tell},
    progress::Reporter,
    reading::triple,
    render::stage_options,
    stage::Stage,
};
use gonio::{
    Result,
    measure::{GridPoints, GridReading, Watch},
    scene::{Measurand, Meter, Origin},
    sky::{Frame, Moment},
    sunlight::{Sunlight, SunlightTask, sunlight as sunlight_of_day},
};
use gonio_simd::Execution;
use gonio_usd::{Loaded, context::UpAxis, daylight::up_axis};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::sync::atomic::AtomicBool;

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
    let points = points(options, loaded.info.up_axis)?;
    take_points(&mut loaded.scene, &options.grids, points);
    check_asked(&loaded.scene)?;
    let frame = Frame { up_axis: up_axis(loaded.info.up_axis), north_deg: options.north };
    let task = SunlightTask { place, day, frame, least_elevation_deg: options.least_elevation, step_min: options.step };
    py.detach(|| run(options, &loaded, &task, interrupted))
}

/// The meters of `--at`.
fn points(options: &SunlightOptions, axis: UpAxis) -> Result<Vec<Meter>> {
    let [up, _] = gonio_usd::meter::axes(axis);
    let normal = options.normal.as_ref().map_or(Ok(up), |text| triple("normal", text))?;
    let meter = |text: &String| Ok(Meter { origin: Origin::new(text), position: triple("at", text)?, normal, ..Meter::default() });
    options.at.iter().map(meter).collect()
}

fn run(options: &SunlightOptions, loaded: &Loaded, task: &SunlightTask, interrupted: &AtomicBool) -> Result<i32> {
    let tell = |diagnostics: &[gonio::Diagnostic]| tell(&options.stage, options.quiet, diagnostics);
    tell(&loaded.diagnostics);
    let scene = &loaded.scene;
    let (meters, grids) = (&scene.meters, GridPoints::of_scene(scene)?);
    let of_grids = scene.grids.iter().zip(&grids).flat_map(|(grid, points)| points.planes(grid));
    // The sun is seen from planes, whatever they measure.
    let plane = |meter: Meter| Meter { measurand: Measurand::Illuminance, ..meter };
    let points: Vec<Meter> = meters.iter().cloned().chain(of_grids).map(plane).collect();
    let follow = |watch: &mut Watch<'_>| sunlight_of_day(scene, &points, task, Execution::detect(), watch);
    let (found, diagnostics) = watched(Reporter::new(options.quiet), None, interrupted, follow)?;
    tell(&diagnostics);
    let mut first = meters.len();
    let mut readings = Vec::new();
    for (grid, points) in scene.grids.iter().zip(grids) {
        let hours: Vec<f64> = (first..first + points.known().count()).map(|point| found.hours(point)).collect();
        first += hours.len();
        readings.push(GridReading::of_values(grid, points, &hours));
    }
    if let Some(path) = &options.output {
        let scale = |grid: &GridReading| Ok(("h", grid.scale(None, STEPS, None)?));
        draw(&readings, path, !options.quiet && !options.json, scale)?;
    }
    if options.json {
        print(&as_json(&found, task, meters, &readings).to_string());
    } else {
        as_text(&found, task, meters, &readings).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// What EN 17037 calls so many hours of a day; none of days that it does not know, and without the least height of the sun that it has for each place.
fn level(hours: f64, task: &SunlightTask) -> Option<&'static str> {
    let is_known = task.least_elevation_deg > 0.0 && (DAYS[0]..=DAYS[1]).contains(&(task.day.month, task.day.day));
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
    if task.least_elevation_deg <= 0.0 && !meters.is_empty() {
        lines.push("EN 17037's levels count the sun from a height on that depends on the place: give it as --least-elevation".into());
    }
    for (number, meter) in meters.iter().enumerate() {
        let spans: Vec<String> = found.spans(number).iter().map(|[from, to]| format!("{}–{}", clock(*from), clock(*to))).collect();
        let spans = if spans.is_empty() { "never".to_owned() } else { spans.join(", ") };
        let level = level(found.hours(number), task).map_or(String::new(), |level| format!("; EN 17037: {level}"));
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
            "en17037_level": level(found.hours(number), task),
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
