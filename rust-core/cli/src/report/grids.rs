//! The figures and pictures of calculation grids and meters.

use super::html::Page;
use crate::{arguments::ReportOptions, falsecolor, rating_words, words::Words};
use gonio::{
    Result,
    measure::{GridReading, MeterReading, Reading, value_picture},
    output::FalseColour,
};
use gonio_page::fill;

/// The grids' figures, then each with its picture.
pub(super) fn write_grids(
    options: &ReportOptions,
    grids: &[GridReading],
    power: &[String],
    (words, page): (&Words, &mut Page),
) -> Result<()> {
    if grids.is_empty() {
        return Ok(());
    }
    let say = &words.grids;
    page.section(&say.title);
    page.table(&say.columns, &grids.iter().map(|grid| row(grid, words)).collect::<Vec<_>>(), &[]);
    page.note(&fill(&say.note, &[("samples", &options.point_spp.to_string())]));
    for grid in grids {
        if let Some(note) = rating_words::of_grid(grid, words) {
            page.note(&format!("{}: {note}.", grid.origin));
        }
    }
    power.iter().for_each(|line| page.paragraph(line));
    let eyes: Vec<Vec<String>> = grids.iter().flat_map(|grid| eye_rows(grid, words)).collect();
    if !eyes.is_empty() {
        page.part(&say.eyes);
        page.table(&say.eyes_columns, &eyes, &[]);
        page.note(&say.eyes_note);
    }
    grids.iter().try_for_each(|grid| plan(options, grid, (words, &mut *page)))
}

/// The grid in false colour.
pub(super) fn plan(options: &ReportOptions, grid: &GridReading, (words, page): (&Words, &mut Page)) -> Result<()> {
    let unit = grid.measurand.unit();
    let max = options.max_illuminance.filter(|_| !grid.measurand.is_of_colour());
    let style = FalseColour { scale: grid.scale(max, options.steps, None)?, unit: unit.into(), contours: true, smoothing: 0, legend: true };
    let picture = falsecolor::encoded(&options.output, &value_picture(grid, &style))?;
    page.wide_picture("png", &picture, &format!("{}: {} {unit}", grid.origin, words.language.quantity(grid.measurand.name())));
    Ok(())
}

/// A line for each direction of a grid's eyes, and one for all.
fn eye_rows(grid: &GridReading, words: &Words) -> Vec<Vec<String>> {
    let Some(eyes) = &grid.eyes else { return Vec::new() };
    let (unit, quantity) = (grid.measurand.unit(), words.language.quantity(grid.measurand.name()));
    let row = |looking: String, average: &Reading, least: String| {
        vec![grid.origin.to_string(), quantity.clone(), looking, figure(average, unit, words), least]
    };
    let directions = fill(&words.grids.directions, &[("count", &eyes.facings.len().to_string())]);
    let all = row(directions, &grid.summary.average, figure(&eyes.least(), unit, words));
    let towards = eyes.facings.iter().zip(eyes.by_facing());
    let one = |(facing, reading): (&[f64; 3], Reading)| row(words.place(*facing), &reading, "–".to_owned());
    std::iter::once(all).chain(towards.map(one)).collect()
}

fn row(grid: &GridReading, words: &Words) -> Vec<String> {
    let (unit, summary, numbers) = (grid.measurand.unit(), &grid.summary, words.numbers);
    let [along, across] = grid.spacing.map(|length| numbers.fixed(length, 2));
    let evenness = |ratio: f64| if grid.measurand.is_amount() { numbers.fixed(ratio, 2) } else { "–".to_owned() };
    vec![
        grid.origin.to_string(),
        words.language.quantity(grid.measurand.name()),
        summary.points.to_string(),
        format!("{along} × {across}"),
        figure(&summary.average, unit, words),
        figure(&summary.min, unit, words),
        figure(&summary.max, unit, words),
        evenness(summary.uniformity()),
        evenness(summary.diversity()),
    ]
}

/// A reading with its error.
pub(super) fn figure(reading: &Reading, unit: &str, words: &Words) -> String {
    words.figure(reading.value, reading.standard_error, unit)
}

/// What meters show.
pub(super) fn write_meters(meters: &[MeterReading], words: &Words, page: &mut Page) {
    if meters.is_empty() {
        return;
    }
    page.section(&words.grids.meters);
    let row = |found: &MeterReading| {
        let meter = &found.meter;
        let quantity = words.language.quantity(meter.measurand.name());
        vec![meter.origin.to_string(), quantity, words.place(meter.position), figure(&found.reading, meter.measurand.unit(), words)]
    };
    page.table(&words.grids.meters_columns, &meters.iter().map(row).collect::<Vec<_>>(), &[]);
    for found in meters {
        if let Some(note) = rating_words::of_meter(found, words) {
            page.note(&format!("{}: {note}.", found.meter.origin));
        }
    }
}
