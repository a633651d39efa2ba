//! The figures and pictures of calculation grids and meters, and the installed power over them.

use super::{html::Page, numbers::with_error, schedule::Schedule};
use crate::{arguments::ReportOptions, falsecolor};
use gonio::{
    Result,
    measure::{GridReading, MeterReading, value_picture},
    output::FalseColour,
    scene::Measurand,
};
use gonio_formats::short_number;

/// The grids' figures, then each with its picture.
pub(super) fn write_grids(options: &ReportOptions, grids: &[GridReading], schedule: &Schedule<'_>, page: &mut Page) -> Result<()> {
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
    if let Some(line) = power_density(grids, schedule) {
        page.paragraph(&line);
    }
    for grid in grids {
        let unit = grid.measurand.unit();
        let style = FalseColour {
            scale: super::scale(options, options.max_illuminance, None, &grid.values())?,
            unit: unit.into(),
            contours: true,
            smoothing: 0,
            legend: true,
        };
        let picture = falsecolor::encoded(&options.output, &value_picture(grid, &style))?;
        page.wide_picture("png", &picture, &format!("{}: {} {unit}", grid.origin, grid.measurand.name()));
    }
    Ok(())
}

fn row(grid: &GridReading) -> Vec<String> {
    let (unit, summary) = (grid.measurand.unit(), &grid.summary);
    let [along, across] = grid.spacing;
    vec![
        grid.origin.to_string(),
        grid.measurand.name().into(),
        summary.points.to_string(),
        format!("{along:.2} × {across:.2}"),
        with_error(&summary.average, unit),
        with_error(&summary.min, unit),
        with_error(&summary.max, unit),
        format!("{:.2}", summary.uniformity()),
        format!("{:.2}", summary.diversity()),
    ]
}

/// Installed power over the area of the largest grid of illuminance, and for each 100 lx there; none without such a grid or power.
fn power_density(grids: &[GridReading], schedule: &Schedule<'_>) -> Option<String> {
    let measures_illuminance = |grid: &&GridReading| grid.measurand == Measurand::Illuminance;
    let largest = grids.iter().filter(measures_illuminance).max_by(|a, b| a.area.total_cmp(&b.area))?;
    let (watts, unknown) = schedule.installed_power();
    if watts <= 0.0 || largest.area <= 0.0 {
        return None;
    }
    let density = watts / largest.area;
    let average = largest.summary.average.value;
    let of_light = if average > 0.0 { format!(", {:.2} W/m² per 100 lx", density * 100.0 / average) } else { String::new() };
    let without = if unknown > 0 { format!("; the power of {unknown} lights is unknown and not counted") } else { String::new() };
    Some(format!(
        "Installed power density: {} W over {:.2} m² of {} are {density:.2} W/m²{of_light}{without}.",
        short_number(watts),
        largest.area,
        largest.origin
    ))
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
}
