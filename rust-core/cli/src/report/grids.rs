//! The figures and pictures of calculation grids and meters.

use super::{html::Page, numbers::with_error};
use crate::{arguments::ReportOptions, falsecolor};
use gonio::{
    Result,
    measure::{GridReading, MeterReading, Reading, value_picture},
    output::FalseColour,
};

/// The grids' figures, then each with its picture.
pub(super) fn write_grids(options: &ReportOptions, grids: &[GridReading], power: &[String], page: &mut Page) -> Result<()> {
    if grids.is_empty() {
        return Ok(());
    }
    page.section("Calculation grids");
    let names = ["grid", "quantity", "points", "spacing, m", "average", "least", "greatest", "U0", "Ud"];
    let rows: Vec<Vec<String>> = grids.iter().map(row).collect();
    page.table(&names, &rows, &[]);
    page.note(&format!(
        "± is the standard error, of {} samples a point. U0 is least over average, Ud least over greatest.",
        options.point_spp
    ));
    for grid in grids {
        if let Some(note) = grid.rating_note() {
            page.note(&format!("{}: {note}.", grid.origin));
        }
    }
    power.iter().for_each(|line| page.paragraph(line));
    let with_eyes: Vec<&GridReading> = grids.iter().filter(|grid| grid.eyes.is_some()).collect();
    if !with_eyes.is_empty() {
        page.part("Eyes");
        page.table(&["grid", "quantity", "looking", "average", "least eye"], &with_eyes.iter().flat_map(eye_rows).collect::<Vec<_>>(), &[]);
        page.note("A point of a grid of eyes has the mean over their directions; the least eye is the least of all points and directions.");
    }
    grids.iter().try_for_each(|grid| plan(options, grid, page))
}

/// The grid in false colour.
pub(super) fn plan(options: &ReportOptions, grid: &GridReading, page: &mut Page) -> Result<()> {
    let unit = grid.measurand.unit();
    let max = options.max_illuminance.filter(|_| !grid.measurand.is_of_colour());
    let style = FalseColour { scale: grid.scale(max, options.steps, None)?, unit: unit.into(), contours: true, smoothing: 0, legend: true };
    let picture = falsecolor::encoded(&options.output, &value_picture(grid, &style))?;
    page.wide_picture("png", &picture, &format!("{}: {} {unit}", grid.origin, grid.measurand.name()));
    Ok(())
}

/// A line for each direction of a grid's eyes, and one for all.
fn eye_rows(grid: &&GridReading) -> Vec<Vec<String>> {
    let Some(eyes) = &grid.eyes else { return Vec::new() };
    let unit = grid.measurand.unit();
    let row = |looking: String, average: &Reading, least: String| {
        vec![grid.origin.to_string(), grid.measurand.name().to_owned(), looking, with_error(average, unit), least]
    };
    let all = row(format!("{} directions", eyes.facings.len()), &grid.summary.average, with_error(&eyes.least(), unit));
    let towards = eyes.facings.iter().zip(eyes.by_facing());
    let one = |([x, y, z], reading): (&[f64; 3], Reading)| row(format!("{x:.2}, {y:.2}, {z:.2}"), &reading, "–".to_owned());
    std::iter::once(all).chain(towards.map(one)).collect()
}

fn row(grid: &GridReading) -> Vec<String> {
    let (unit, summary) = (grid.measurand.unit(), &grid.summary);
    let [along, across] = grid.spacing;
    let evenness = |ratio: f64| if grid.measurand.is_amount() { format!("{ratio:.2}") } else { "–".to_owned() };
    vec![
        grid.origin.to_string(),
        grid.measurand.name().into(),
        summary.points.to_string(),
        format!("{along:.2} × {across:.2}"),
        with_error(&summary.average, unit),
        with_error(&summary.min, unit),
        with_error(&summary.max, unit),
        evenness(summary.uniformity()),
        evenness(summary.diversity()),
    ]
}

/// What meters show.
pub(super) fn write_meters(meters: &[MeterReading], page: &mut Page) {
    if meters.is_empty() {
        return;
    }
    page.section("Meters");
    let row = |found: &MeterReading| {
        let (meter, [x, y, z]) = (&found.meter, found.meter.position);
        let place = format!("{x:.2}, {y:.2}, {z:.2}");
        vec![meter.origin.to_string(), meter.measurand.name().into(), place, with_error(&found.reading, meter.measurand.unit())]
    };
    page.table(&["meter", "quantity", "at, m", "value"], &meters.iter().map(row).collect::<Vec<_>>(), &[]);
    for found in meters {
        if let Some(note) = found.note() {
            page.note(&format!("{}: {note}.", found.meter.origin));
        }
    }
}
