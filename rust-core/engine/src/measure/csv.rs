//! Readings as comma-separated values (RFC 4180).

use super::{ColourReading, Coverage, Measurements, Reading, SmallSources};
use crate::scene::{Measurand, Origin};
use std::fmt::Write;

/// The columns of glare ratings, and those of figures of colour.
const RATED: &str = "left_out,share_left_out,ugr_as_in_tables";
const COLOURED: &str = "cct,duv,ra,rf,rg,melanopic_edi_lx";

/// One line a point, meters first: name, row and column in the grid (empty for meters), position in metres, what was measured, its value with the
/// standard error (empty where there is no figure), the unit, and of glare ratings how many sources were left out, which share of the sources' light at the eye they
/// bring, and the rating by CIE 117 alone, as UGR tables have it. Eyes of grids have a line each and where they look, and figures of colour have the others of the
/// same light beside them.
pub fn csv(measurements: &Measurements) -> String {
    let place = "name,row,column,x_m,y_m,z_m,quantity,value,standard_error,unit";
    let mut out = format!("{place},{RATED},facing_x,facing_y,facing_z,{COLOURED}\r\n");
    for meter in &measurements.meters {
        let (place, measurand) = ((None, meter.meter.position), meter.meter.measurand);
        let beside = Beside { rated: meter.coverage.zip(meter.small), facing: None, colour: meter.colour.as_deref() };
        line(&mut out, &meter.meter.origin, place, (measurand, meter.reading), &beside);
    }
    for grid in &measurements.grids {
        let mut rated = grid.coverage.iter().copied().zip(grid.small.iter().copied());
        let mut colours = grid.colours.iter();
        let mut eyes = grid.eyes.iter().flat_map(|eyes| &eyes.views);
        for (index, point) in grid.points.iter().enumerate() {
            let Some((position, reading)) = point else { continue };
            let place = (Some([index / grid.size[0], index % grid.size[0]]), *position);
            let facings = grid.eyes.iter().flat_map(|eyes| &eyes.facings).map(|facing| Some(*facing));
            let views: Vec<(Option<[f64; 3]>, Reading)> = match eyes.next() {
                Some(views) => facings.zip(views.iter().copied()).collect(),
                None => vec![(None, *reading)],
            };
            for (facing, reading) in views {
                let beside = Beside { rated: rated.next(), facing, colour: colours.next().map(|colour| &**colour) };
                line(&mut out, &grid.origin, place, (grid.measurand, reading), &beside);
            }
        }
    }
    out
}

/// What stands beside a value.
struct Beside<'a> {
    rated: Option<(Coverage, SmallSources)>,
    facing: Option<[f64; 3]>,
    colour: Option<&'a ColourReading>,
}

impl Beside<'_> {
    fn columns(&self) -> String {
        let rated = self.rated.map_or(",,".to_owned(), |(coverage, small)| {
            let tabular = small.tabular.map_or(String::new(), |reading| format!("{:.6}", reading.value));
            format!("{},{:.4},{tabular}", coverage.left_out(), coverage.share_left_out())
        });
        let facing = self.facing.map_or(",,".to_owned(), |facing| facing.map(|part| format!("{part:.6}")).join(","));
        let of = |measurand| self.colour.and_then(|colour| colour.of(measurand));
        let figures = Measurand::OF_COLOUR.map(of).into_iter().chain([self.colour.and_then(ColourReading::melanopic_edi)]);
        let figures: Vec<String> = figures.map(|found| found.map_or(String::new(), |reading| figure(reading.value))).collect();
        format!("{rated},{facing},{}", figures.join(","))
    }
}

fn line(
    out: &mut String,
    origin: &Origin,
    (place, [x, y, z]): (Option<[usize; 2]>, [f64; 3]),
    (measurand, reading): (Measurand, Reading),
    beside: &Beside<'_>,
) {
    let place = place.map_or_else(|| ",".to_owned(), |[row, column]| format!("{row},{column}"));
    let (quantity, unit) = (measurand.name(), measurand.unit().replace('²', "2"));
    let [value, error] = [reading.value, reading.standard_error].map(figure);
    // Writing to a string does not fail.
    let _ = write!(out, "{},{place},{x:.6},{y:.6},{z:.6},{quantity},{value},{error},{unit},{}\r\n", quoted(&origin.name), beside.columns());
}

fn figure(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:.6}") }
}

/// A text as a field: in quotes where it holds what has a meaning.
pub fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\r', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
