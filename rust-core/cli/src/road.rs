//! `gonio road`.

use super::{
    arguments::RoadOptions,
    drawing,
    file::{check_ending, check_targets, ending, put},
    messages::print,
    report::{Head, Page, as_file},
    words::Words,
};
use gonio::{Error, Result};
use gonio_road::{Best, Results, Road, RoadError, Row, sheet, text};
use serde_json::{Value, json};
use std::{
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

/// Endings of a sheet's file.
const ENDINGS: &[&str] = &["svg", "png", "html", "htm", "pdf"];

/// Reads the road, calculates it, and writes what was asked for.
pub(super) fn road(options: &RoadOptions, interrupted: &AtomicBool) -> Result<i32> {
    if let Some(output) = &options.output {
        check_ending("output", output, ENDINGS)?;
        check_targets([output])?;
    }
    let (road, results, best) = calculated(&options.file, &|| interrupted.load(Ordering::Relaxed))?;
    if let Some(output) = &options.output {
        put(output, &drawn(options, output, (&road, &results), interrupted)?)?;
    }
    if options.json {
        print(&as_json(&options.file, &results, best.as_ref()).to_string());
    } else {
        best.iter().for_each(|best| print(&text::optimised(best)));
        text::lines(&results).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// A road's error as the command line's.
fn told(error: RoadError) -> Error {
    match error {
        RoadError::Content { path, error } => Error::in_file(path, &error),
        RoadError::File { path, source } => Error::io(path, source),
    }
}

/// What `gonio road --json` prints of a road's file; `stopped` ends a search.
///
/// # Errors
/// A file that is no road's, with its line; being stopped.
pub fn road_figures(file: &Path, stopped: &dyn Fn() -> bool) -> Result<Value> {
    calculated(file, stopped).map(|(_, results, best)| as_json(file, &results, best.as_ref()))
}

/// The road of a file, or the best that it asks to look for.
fn calculated(file: &Path, stopped: &dyn Fn() -> bool) -> Result<(Road, Results, Option<Best>)> {
    let read = Road::read(file).map_err(told)?;
    let found = read.optimise(stopped);
    if stopped() {
        return Err(Error::Cancelled);
    }
    Ok(match found {
        Some((road, results, best)) => (road, results, Some(best)),
        None => {
            let results = read.evaluate();
            (read, results, None)
        }
    })
}

fn as_json(file: &Path, results: &Results, best: Option<&Best>) -> Value {
    let mut value = json!(results);
    if let Value::Object(object) = &mut value {
        object.insert("file".into(), json!(file.to_string_lossy()));
        object.insert("optimised".into(), json!(best));
    }
    value
}

/// The bytes of the sheet's file.
fn drawn(options: &RoadOptions, output: &Path, (road, results): (&Road, &Results), interrupted: &AtomicBool) -> Result<Vec<u8>> {
    let name = options.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let title = options.title.clone().unwrap_or(name);
    match ending(output).as_str() {
        "html" | "htm" | "pdf" => as_file(page(options, title, road, results), output, interrupted),
        _ => drawing::encoded(sheet::sheet(road, results, &title), output),
    }
}

/// The sheet as a page with tables.
fn page(options: &RoadOptions, title: String, road: &Road, results: &Results) -> String {
    let facts = [
        ("Road", format!("{} m wide, {} lanes", road.carriageway_width, road.lanes)),
        ("Surface", results.surface.name.clone()),
        ("Model", options.file.file_name().unwrap_or_default().to_string_lossy().into_owned()),
        ("Calculated by", format!("gonio {}, conventions of {}", env!("CARGO_PKG_VERSION"), results.standard)),
    ];
    let mut page = Page::new(&Head { title, facts: facts.map(|(name, fact)| (name.to_owned(), fact)).into() }, Words::english());
    page.section("Results");
    page.list(&text::summary(results));
    page.table(&text::OBSERVER_COLUMNS, &text::observer_rows(results), &[]);
    let required = text::requirements(results);
    if !required.is_empty() {
        page.section("Required");
        page.list(&required);
    }
    page.section("Luminaires");
    let names = ["file", "side", "spacing, m", "height, m", "overhang, m", "tilt, °", "maintenance factor", "power, W"];
    page.table(&names, &road.rows.iter().map(row).collect::<Vec<_>>(), &[]);
    page.section("Plan and lines of equal value");
    page.wide_drawing(&sheet::plan(road, results), "The field between two luminaires");
    page.wide_drawing(&sheet::isolux(road, results), "Horizontal illuminance on the ground, in lx");
    for seen in &results.observers {
        let caption = format!("Luminance for the observer in lane {}, in cd/m²", seen.lane);
        page.wide_drawing(&sheet::isoluminance(road, results, seen.lane), &caption);
        page.wide_drawing(&sheet::view(road, results, seen.lane), &format!("What the driver in lane {} sees", seen.lane));
    }
    page.section("All values");
    page.list(&text::lines(results));
    page.finish()
}

fn row(row: &Row) -> Vec<String> {
    vec![
        row.luminaire.clone(),
        row.side.name().into(),
        format!("{:.2}", row.spacing),
        format!("{:.2}", row.height),
        format!("{:.2}", row.overhang),
        format!("{:.1}", row.tilt),
        format!("{:.2}", row.maintenance_factor),
        text::number(row.power, 1),
    ]
}
