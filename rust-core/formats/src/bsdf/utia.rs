//! UTIA `.bin` files (Filip and Vávra, Template-Based Sampling of Anisotropic BRDFs, 2014): anisotropic reflection on a grid of 15° and 7.5°.
//!
//! Numbers are coded: divided by 140 they follow the sRGB curve, and what comes out is in 1/100 sr (as in Dupuy's `dj_brdf`, by the word of the
//! database's author). We decode the knots and interpolate between decoded values. Polar angles end at 75°; the file's last two are
//! continued to 90° on a straight line, not below zero.

use core::f64::consts::TAU;

use super::axis::{Axis, Mode};
use super::bytes::doubles;
use super::colour::Channels;
use super::coordinates::Coordinates;
use super::hemispheres::Hemispheres;
use super::table::{Layout, Table};
use crate::error::{FormatError, Result};

/// Polar angles of the file, 0° to 75°.
const POLAR: usize = 6;

/// Azimuths of the file, 0° to 352.5°.
const AZIMUTHS: usize = 48;

/// Directions of light, and of view.
const DIRECTIONS: usize = POLAR * AZIMUTHS;

/// The only size that such a file has, bytes.
pub(crate) const SIZE: usize = 3 * DIRECTIONS * DIRECTIONS * 8;

/// A coded number that stands for one.
const WHITE: f64 = 140.0;

/// A decoded number in 1/sr.
const SCALE: f64 = 100.0;

/// Reads a file.
///
/// # Errors
/// When it has not the one size that such files have, or a number is infinite or not a number.
pub fn read(bytes: &[u8]) -> Result<Table> {
    if bytes.len() != SIZE {
        return Err(FormatError::whole(format!("{} bytes, expected {SIZE}", bytes.len())));
    }
    if let Some(i) = doubles(bytes).position(|x| !x.is_finite()) {
        return Err(FormatError::byte(8 * i as u64, "a number that is infinite or not a number"));
    }
    let coded: Vec<f64> = doubles(bytes).collect();
    let layout = layout()?;
    let mut values = Vec::with_capacity(layout.value_count()?);
    for ti in 0..=POLAR {
        for pi in 0..AZIMUTHS {
            for to in 0..=POLAR {
                for po in 0..AZIMUTHS {
                    values.extend((0..3).map(|channel| continued(&coded, channel, [ti, to], [pi, po]) as f32));
                }
            }
        }
    }
    Table::new(layout, values)
}

/// A value, with the polar angle after the last one on the line of the two before.
fn continued(coded: &[f64], channel: usize, [ti, to]: [usize; 2], azimuths: [usize; 2]) -> f64 {
    let along = |to: usize| {
        let at = |ti: usize| decoded(coded[index(channel, [ti, to], azimuths)]);
        if ti < POLAR { at(ti) } else { (2.0 * at(POLAR - 1) - at(POLAR - 2)).max(0.0) }
    };
    if to < POLAR { along(to) } else { (2.0 * along(POLAR - 1) - along(POLAR - 2)).max(0.0) }
}

fn index(channel: usize, [ti, to]: [usize; 2], [pi, po]: [usize; 2]) -> usize {
    DIRECTIONS * (DIRECTIONS * channel + AZIMUTHS * ti + pi) + AZIMUTHS * to + po
}

/// 1/sr of a coded number (IEC 61966-2-1).
fn decoded(coded: f64) -> f64 {
    let x = coded.max(0.0) / WHITE;
    SCALE * if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

fn encoded(value: f64) -> f64 {
    let x = value / SCALE;
    WHITE * if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// The table of a file: its grid, and 90°.
///
/// # Errors
/// Never: the grid is a constant.
pub fn layout() -> Result<Layout> {
    let theta = Axis::uniform(0.0, 90_f64.to_radians(), POLAR + 1, Mode::Linear)?;
    let step = TAU / AZIMUTHS as f64;
    let phi = Axis::uniform(0.0, TAU - step, AZIMUTHS, Mode::Periodic { period: TAU })?;
    Ok(Layout {
        coordinates: Coordinates::Anisotropic,
        axes: vec![theta.clone(), phi.clone(), theta, phi],
        channels: Channels::Rgb,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal: false,
        bilateral: false,
    })
}

/// The file of a table that has the database's layout; 90° is left out.
///
/// # Errors
/// When the table has another layout.
pub fn write(table: &Table) -> Result<Vec<u8>> {
    if layout()? != *table.layout() {
        return Err(FormatError::whole("only a table with UTIA's own axes can be written as UTIA"));
    }
    let mut file = vec![0; SIZE];
    for (cell, values) in table.values().chunks_exact(3).enumerate() {
        let (po, to) = (cell % AZIMUTHS, cell / AZIMUTHS % (POLAR + 1));
        let (pi, ti) = (cell / (AZIMUTHS * (POLAR + 1)) % AZIMUTHS, cell / (AZIMUTHS * (POLAR + 1) * AZIMUTHS));
        if to < POLAR && ti < POLAR {
            for (channel, &v) in values.iter().enumerate() {
                let at = 8 * index(channel, [ti, to], [pi, po]);
                let coded = if v.is_nan() { 0.0 } else { encoded(v.into()) };
                file[at..at + 8].copy_from_slice(&coded.to_le_bytes());
            }
        }
    }
    Ok(file)
}
