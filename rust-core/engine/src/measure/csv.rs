//! Readings as comma-separated values (RFC 4180).

use super::{Coverage, Measurements, Reading, SmallSources};
use crate::scene::{Measurand, Origin};
use std::fmt::Write;

/// One line a point, meters first: name, row and column in the grid (empty for meters), position in metres, what was measured, its value with the
/// standard error (empty where there is no figure), the unit, and of glare ratings how many sources were left out, which share of the sources' light at the eye they
/// bring, and the rating by CIE 117 alone, as UGR tables have it.
pub fn csv(measurements: &Measurements) -> String {
    let mut out =
        String::from("name,row,column,x_m,y_m,z_m,quantity,value,standard_error,unit,left_out,share_left_out,ugr_as_in_tables\r\n");
    for meter in &measurements.meters {
        let place = (meter.meter.position, meter.reading);
        line(&mut out, &meter.meter.origin, None, place, meter.meter.measurand, meter.coverage.zip(meter.small));
    }
    for grid in &measurements.grids {
        let mut rated = grid.coverage.iter().copied().zip(grid.small.iter().copied());
        for (index, point) in grid.points.iter().enumerate() {
            let Some(point) = point else { continue };
            line(&mut out, &grid.origin, Some([index / grid.size[0], index % grid.size[0]]), *point, grid.measurand, rated.next());
        }
    }
    out
}

fn line(
    out: &mut String,
    origin: &Origin,
    place: Option<[usize; 2]>,
    ([x, y, z], reading): ([f64; 3], Reading),
    measurand: Measurand,
    rated: Option<(Coverage, SmallSources)>,
) {
    let place = place.map_or_else(|| ",".to_owned(), |[row, column]| format!("{row},{column}"));
    let (quantity, unit) = (measurand.name(), measurand.unit().replace('²', "2"));
    let figure = |value: f64| if value.is_nan() { String::new() } else { format!("{value:.6}") };
    let [value, error] = [reading.value, reading.standard_error].map(figure);
    let out_of = rated.map_or(",,".to_owned(), |(coverage, small)| {
        let tabular = small.tabular.map_or(String::new(), |reading| format!("{:.6}", reading.value));
        format!("{},{:.4},{tabular}", coverage.left_out(), coverage.share_left_out())
    });
    // Writing to a string does not fail.
    let _ = write!(out, "{},{place},{x:.6},{y:.6},{z:.6},{quantity},{value},{error},{unit},{out_of}\r\n", quoted(&origin.name));
}

/// A text as a field: in quotes where it holds what has a meaning.
pub fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\r', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
