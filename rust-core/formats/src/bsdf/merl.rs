//! MERL `.binary` files (Matusik, Pfister, Brand and McMillan, A Data-Driven Reflectance Model, 2003): isotropic reflection over half and
//! difference angles, three channels one after the other.
//!
//! A value belongs to the centre of its bin; between centres we interpolate, where the database's own code takes the nearest bin. Bins below
//! the horizon or not measured are negative in the file. The camera's RGB is taken for linear Rec.709.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use super::axis::{Axis, Mode};
use super::bytes::{Cursor, doubles, floats};
use super::colour::Channels;
use super::coordinates::Coordinates;
use super::hemispheres::Hemispheres;
use super::table::{Layout, Table};
use crate::error::{FormatError, Result};

/// What the database's numbers are multiplied by to be in 1/sr.
const SCALE: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// θh, θd and φd of the database.
pub const BINS: [usize; 3] = [90, 90, 180];

/// More bins than that along φd cover a full turn: half a turn in degrees is the most that reciprocal data needs.
const MOST_HALF_TURN_BINS: usize = 180;

/// How many bytes the three lengths take.
const HEADER: usize = 12;

/// The lengths that a file states and the bytes of a number, if they add up to its size.
pub(crate) fn shape(bytes: &[u8]) -> Option<([usize; 3], usize)> {
    let mut cursor = Cursor::new(bytes);
    let mut bins = [0; 3];
    for n in &mut bins {
        *n = usize::try_from(cursor.u32("a length").ok()? as i32).ok()?;
    }
    let numbers = bins.iter().try_fold(3_usize, |product, &n| product.checked_mul(n))?;
    let size = |width: usize| numbers.checked_mul(width)?.checked_add(HEADER);
    let width = [8, 4].into_iter().find(|&width| size(width) == Some(bytes.len()))?;
    bins.iter().all(|&n| n > 0).then_some((bins, width))
}

/// Reads a file with any lengths, in double or single precision. With up to 180 bins φd covers half a turn and the data is reciprocal, with
/// more it covers a full turn.
///
/// # Errors
/// When the lengths do not add up to the file's size, or a number is infinite or not a number.
pub fn read(bytes: &[u8]) -> Result<Table> {
    let Some((bins, width)) = shape(bytes) else {
        let stated: Vec<i32> = bytes.chunks_exact(4).take(3).map(|b| i32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let problem = format!("lengths {stated:?} do not fit {} bytes; expected 12 + 3 × n × 8 (or × 4) for n bins", bytes.len());
        return Err(FormatError::byte(0, problem));
    };
    let data = &bytes[HEADER..];
    let cells = bins.iter().product::<usize>();
    let mut values = vec![0.0; 3 * cells];
    let mut put = |i: usize, x: f64| {
        let (channel, cell) = (i / cells, i % cells);
        values[3 * cell + channel] = if x < 0.0 { f32::NAN } else { (x * SCALE[channel]) as f32 };
        x.is_finite()
    };
    let bad = if width == 8 {
        doubles(data).enumerate().position(|(i, x)| !put(i, x))
    } else {
        floats(data).enumerate().position(|(i, x)| !put(i, x.into()))
    };
    match bad {
        Some(i) => Err(FormatError::byte((HEADER + i * width) as u64, "a number that is infinite or not a number")),
        None => Table::new(layout(bins)?, values),
    }
}

/// The table of a file with that many bins of θh, θd and φd.
///
/// # Errors
/// When there are no bins along one of them.
pub fn layout(bins: [usize; 3]) -> Result<Layout> {
    let centre = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let reciprocal = bins[2] <= MOST_HALF_TURN_BINS;
    let period = if reciprocal { PI } else { TAU };
    let half = (0..bins[0]).map(|i| FRAC_PI_2 * centre(i, bins[0]).powi(2)).collect();
    let difference = (0..bins[1]).map(|i| FRAC_PI_2 * centre(i, bins[1])).collect();
    let about = (0..bins[2]).map(|i| period * centre(i, bins[2])).collect();
    Ok(Layout {
        coordinates: Coordinates::HalfDifference,
        axes: vec![Axis::new(half, Mode::Linear)?, Axis::new(difference, Mode::Linear)?, Axis::new(about, Mode::Periodic { period })?],
        channels: Channels::Rgb,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal,
        bilateral: false,
    })
}

/// The file of a table that has MERL's layout, in double precision.
///
/// # Errors
/// When the table has another layout.
pub fn write(table: &Table) -> Result<Vec<u8>> {
    let axes = &table.layout().axes;
    let bins = [0, 1, 2].map(|i| axes.get(i).map_or(0, |axis| axis.knots().len()));
    if layout(bins)? != *table.layout() {
        return Err(FormatError::whole("only a table with MERL's own axes can be written as MERL"));
    }
    let mut file: Vec<u8> = bins.iter().flat_map(|&n| (n as i32).to_le_bytes()).collect();
    for (channel, scale) in SCALE.into_iter().enumerate() {
        for &v in table.values().iter().skip(channel).step_by(3) {
            let x = if v.is_nan() { -1.0 } else { f64::from(v) / scale };
            file.extend(x.to_le_bytes());
        }
    }
    Ok(file)
}
