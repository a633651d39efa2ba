//! `[[row]]`.

use super::{
    files::named,
    keys::{Bounds, File, Keys},
};
use crate::{
    error::{Result, RoadError},
    luminance::EYE,
    road::{Row, Side},
};
use gonio_formats::{
    gldf::split_variant,
    photometry::{Goniogram, beside, read_with},
};
use std::sync::Arc;

/// Distances of luminaires along the road.
pub(super) const SPACINGS: Bounds = Bounds::from(1.0, 500.0, " m");
/// Heights of luminaires: above the driver's eye.
pub(super) const HEIGHTS: Bounds = Bounds::above(EYE, 100.0, " m");
/// Tilts of luminaires.
pub(super) const TILTS: Bounds = Bounds::from(-90.0, 90.0, "°");

const OVERHANGS: Bounds = Bounds::from(-100.0, 100.0, " m");
const OFFSETS: Bounds = Bounds::from(-1000.0, 1000.0, " m");
const TURNS: Bounds = Bounds::from(-360.0, 360.0, "°");
const FACTORS: Bounds = Bounds::above(0.0, 1.0, "");
const WATTS: Bounds = Bounds::above(0.0, 1e5, " W");

const KEYS: [&str; 12] = [
    "luminaire",
    "lamp_set",
    "spacing",
    "height",
    "overhang",
    "tilt",
    "orientation",
    "front",
    "side",
    "offset",
    "maintenance_factor",
    "power",
];
const SIDES: [(&str, Side); 4] =
    [("left", Side::Left), ("right", Side::Right), ("opposite", Side::Opposite), ("staggered", Side::Staggered)];

/// The most rows, and lamp sets of a luminaire.
const MOST: usize = 100;

/// All rows of a file.
pub(super) fn rows(parts: &Keys<'_>, file: &File<'_>) -> Result<Vec<Row>> {
    let tables = parts.tables("row")?;
    if tables.is_empty() || tables.len() > MOST {
        return Err(parts.problem_of("row", &format!("stands {} times, expected 1 to {MOST} tables [[row]]", tables.len())));
    }
    let row = |(index, (table, start))| row(&Keys::new(&format!("[[row]] {}", index + 1), file, table, start));
    tables.into_iter().enumerate().map(row).collect()
}

fn row(keys: &Keys<'_>) -> Result<Row> {
    keys.check(&KEYS)?;
    let side = keys.word("side", &SIDES)?;
    let tilt = keys.number("tilt", TILTS)?.unwrap_or(0.0);
    let luminaire = keys.needed_text("luminaire", "the name of an IES, EULUMDAT, TM-33, GLDF or GDTF file")?;
    let goniogram = goniogram(keys, luminaire, tilt)?;
    let watts = goniogram.lamps().map(|lamps| lamps.watts).filter(|watts| *watts > 0.0);
    Ok(Row {
        luminaire: luminaire.to_owned(),
        spacing: keys.needed("spacing", SPACINGS)?,
        height: keys.needed("height", HEIGHTS)?,
        overhang: keys.number("overhang", OVERHANGS)?.unwrap_or(0.0),
        tilt,
        orientation: keys.number("orientation", TURNS)?.unwrap_or(0.0),
        front: keys.number("front", TURNS)?.unwrap_or_else(|| goniogram.street_side()),
        side: side.ok_or_else(|| keys.problem_of("side", "is missing, expected one of left, right, opposite, staggered"))?,
        offset: keys.number("offset", OFFSETS)?.unwrap_or(0.0),
        maintenance_factor: keys.number("maintenance_factor", FACTORS)?.unwrap_or(1.0),
        power: keys.number("power", WATTS)?.or(watts),
        goniogram: Arc::new(goniogram),
    })
}

/// A luminaire's intensities, for the lamps and the tilt that were asked for.
fn goniogram(keys: &Keys<'_>, name: &str, tilt: f64) -> Result<Goniogram> {
    let expected = "expected an IES, EULUMDAT, TM-33, GLDF or GDTF file, named relative to the road's file";
    let (path, bytes) = named(keys, "luminaire", split_variant(name).0, expected)?;
    let read = read_with(&bytes, name, &mut beside(&path));
    let mut goniogram = read.map_err(|error| RoadError::content(&path, error))?;
    if let Some(number) = keys.count("lamp_set", MOST as u32)? {
        let chosen = goniogram.with_lamp_set(number as usize - 1);
        goniogram = chosen.map_err(|error| keys.problem_of("lamp_set", &format!("is {number}: {}", error.problem)))?;
    }
    if goniogram.tilt.is_some() {
        goniogram = goniogram.tilted(tilt).map_err(|error| keys.problem_of("tilt", &format!("is {tilt}: {}", error.problem)))?;
    }
    Ok(goniogram)
}
