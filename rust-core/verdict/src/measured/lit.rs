//! Illuminances along a line or on an area, as `gonio emergency`, `gonio sports` and `gonio zones` print them.

use super::{
    area::Figure,
    object::{Found, error, number},
};
use crate::{estimate::Estimate, unit::Unit};
use serde_json::{Map, Value};

/// Figures of light by their keys without unit, and other names of them.
const LIT: [(&str, &[&str]); 3] = [("min", &["e_min", "least"]), ("max", &["e_max"]), ("average", &["mean", "e_av"])];

/// What the file's light is already multiplied with is no maintenance factor of a requirement.
pub(super) fn lux() -> Unit {
    Unit::of("lx")
}

/// The figures of a line or an area, with ratios of them by their keys and other names.
pub(super) fn figures(of: &Map<String, Value>, ratios: &[(&str, &[&str])]) -> Found<Vec<Figure>> {
    let named = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let mut found = Vec::new();
    for (key, others) in LIT {
        let value = estimate(of, &format!("{key}_lx"), &format!("{key}_error_lx"))?;
        found.push(Figure { aliases: named(others), ..Figure::new(key, value, lux()) });
    }
    for (key, others) in ratios {
        let ratio = estimate(of, key, &format!("{key}_error"))?;
        found.push(Figure { aliases: named(others), ..Figure::new(key, ratio, Unit::plain()) });
    }
    Ok(found)
}

/// A number and its standard error by their keys, if there is one.
pub(super) fn estimate(of: &Map<String, Value>, key: &str, error_key: &str) -> Found<Option<Estimate>> {
    number(of, key).map(|value| Ok(Estimate::new(value, error(of, error_key)?))).transpose()
}
