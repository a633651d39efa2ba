//! The file as a whole, and its `[road]`.

use super::{
    files::named,
    keys::{Bounds, File, Keys, WIDE},
    lists, rows,
};
use crate::{
    error::{Result, RoadError},
    road::{Reach, Road},
    standard::Standard,
    surface::{Kind, Material, Surface, Table},
};
use gonio_formats::FormatError;
use std::path::Path;
use toml::de::DeTable;

/// The most lanes.
const LANES: u32 = 20;
/// Mounting heights that luminaires are looked for in.
const REACHES: Bounds = Bounds::above(0.0, 1000.0, " mounting heights");
/// Ages of observers.
const AGES: Bounds = Bounds::from(15.0, 100.0, " years");
/// Shares.
const SHARES: Bounds = Bounds::above(0.0, 1.0, "");

const PARTS: [&str; 7] = ["road", "row", "footpath", "required", "class", "period", "optimise"];
const KEYS: [&str; 11] = [
    "carriageway_width",
    "lanes",
    "surface",
    "reflectance",
    "q0",
    "wet_surface",
    "standard",
    "observer_age",
    "edge_strip",
    "luminance_reach",
    "illuminance_reach",
];
const STANDARDS: [(&str, Standard); 2] = [("EN 13201", Standard::En13201), ("CIE 140", Standard::Cie140)];

/// Reads a road from the bytes of its file.
pub(super) fn road(bytes: &[u8], path: &Path) -> Result<Road> {
    let whole = |problem| RoadError::content(path, FormatError::whole(problem));
    let text = std::str::from_utf8(bytes).map_err(|_| whole("not a text in UTF-8, expected TOML".to_owned()))?;
    let file = File { path, text };
    let parsed = DeTable::parse(text).map_err(|error| {
        let message = format!("no TOML: {}", error.message().replace('\n', ", "));
        error.span().map_or_else(|| whole(message.clone()), |span| file.problem(span.start, message.clone()))
    })?;
    let parts = Keys::new("the road's file", &file, parsed.get_ref(), 0);
    parts.check(&PARTS)?;
    let (own, start) = parts.table("road")?.ok_or_else(|| parts.problem_of("road", "is missing, expected a table [road]"))?;
    let own = Keys::new("[road]", &file, own, start);
    own.check(&KEYS)?;
    let carriageway_width = own.needed("carriageway_width", WIDE)?;
    let lanes =
        own.count("lanes", LANES)?.ok_or_else(|| own.problem_of("lanes", "is missing, expected how many lanes the carriageway has"))?;
    let strip = Bounds::above(0.0, carriageway_width, " m, the carriageway's width");
    let road = Road {
        carriageway_width,
        lanes,
        surface: surface(&own)?,
        wet: own.text("wet_surface")?.map(|name| of_file(&own, "wet_surface", name)).transpose()?,
        standard: own.word("standard", &STANDARDS)?.unwrap_or_default(),
        observer_age: own.number("observer_age", AGES)?.unwrap_or(23.0),
        edge_strip: own.number("edge_strip", strip)?.unwrap_or(carriageway_width / f64::from(lanes)),
        reach: reach(&own)?,
        rows: rows::rows(&parts, &file)?,
        footpaths: lists::footpaths(&parts, &file)?,
        required: lists::required(&parts, &file)?,
        classes: lists::classes(&parts, &file)?,
        periods: lists::periods(&parts, &file)?,
        ranges: lists::ranges(&parts, &file)?,
    };
    if road.ranges.is_some() && !road.requires_anything() {
        return Err(parts.problem_of("optimise", "has nothing to meet, expected values under [required] or in a footpath's required"));
    }
    Ok(road)
}

fn reach(own: &Keys<'_>) -> Result<Reach> {
    let usual = Reach::default();
    Ok(Reach {
        luminance: own.numbers("luminance_reach", REACHES)?.unwrap_or(usual.luminance),
        illuminance: own.number("illuminance_reach", REACHES)?.unwrap_or(usual.illuminance),
    })
}

/// The dry surface.
fn surface(own: &Keys<'_>) -> Result<Surface> {
    let name = own.needed_text("surface", "\"lambert\" or the name of a file with an r-table or a measured material")?;
    if name == "lambert" {
        if own.get("q0").is_some() {
            return Err(own.problem_of("q0", "is for r-tables, expected reflectance = π · q0 beside surface = \"lambert\""));
        }
        return Ok(Surface::lambert(own.needed("reflectance", SHARES)?));
    }
    let surface = of_file(own, "surface", name)?;
    if own.get("reflectance").is_some() {
        return Err(own.problem_of("reflectance", "is for surface = \"lambert\", expected q0 or nothing beside a file"));
    }
    let Some(q0) = own.number("q0", SHARES)? else { return Ok(surface) };
    match surface.kind {
        Kind::Table(table) if surface.figures.q0 > 0.0 => Ok(Surface::table(name, table.times(q0 / surface.figures.q0))),
        Kind::Table(_) => Err(own.problem_of("q0", "cannot be given to a table without light")),
        _ => Err(own.problem_of("q0", "is for r-tables; measured materials keep their own")),
    }
}

/// The file of an r-table or of a measured material.
fn of_file(own: &Keys<'_>, key: &str, name: &str) -> Result<Surface> {
    let expected =
        "expected \"lambert\", or the file of an r-table or a measured material beside it (norms' own tables are no part of gonio)";
    let (path, bytes) = named(own, key, name, expected)?;
    if let Some(material) = Material::read(&bytes, name) {
        return material.map(|material| Surface::material(name, material)).map_err(|error| RoadError::content(&path, error));
    }
    let found = Table::read(&bytes).map_err(|error| RoadError::content(&path, error))?;
    Ok(Surface::table(name, found))
}
