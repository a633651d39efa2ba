//! Figures of files whose numbers stand under their own names.

use super::area::Figure;
use crate::{estimate::Estimate, unit::Unit};
use serde_json::{Map, Value};

/// Units by the beginnings of the names of numbers; the longest counts.
const UNITS: [(&str, &str, bool); 22] = [
    ("l_av", "cd/m²", true),
    ("e_", "lx", true),
    ("mean_lx", "lx", true),
    ("inside", "lx", true),
    ("outside", "lx", true),
    ("median_diffuse_lx", "lx", false),
    ("veiling", "cd/m²", false),
    ("veiling_x", "m", false),
    ("ti", "%", false),
    ("pdi", "mW/(lx·m²)", false),
    ("aeci", "kWh/m²", false),
    ("power_w_per_km", "W/km", false),
    ("daylight_factor", "%", true),
    ("median_daylight_factor", "%", true),
    ("daylight_factor_area_", "", false),
    ("used_hours", "h", false),
    ("hours_direct_", "h", false),
    ("leni_", "kWh/m²", false),
    ("daylight_hours", "h", false),
    ("full_load_hours", "h", false),
    ("modelling", "", false),
    ("lane", "", false),
];
/// Beginnings of the names of shares, from 0 to 1.
const SHARES: [&str; 14] = [
    "sda_",
    "ase_",
    "da_",
    "cda_",
    "udi_",
    "daylight_hours_",
    "hourly_area_",
    "daylight_factor_area_",
    "uniformity",
    "diversity",
    "u0",
    "uo",
    "ul",
    "eir",
];

/// The unit of a number by its name.
pub(super) fn unit(key: &str) -> Unit {
    let fits = UNITS.iter().filter(|(start, ..)| key.starts_with(start));
    match fits.max_by_key(|(start, ..)| start.len()) {
        _ if SHARES.iter().any(|start| key.starts_with(start)) && key != "eir" => Unit::share(),
        Some((_, sign, true)) => Unit::light(sign),
        Some((_, sign, false)) => Unit::of(sign),
        None => Unit::plain(),
    }
}

/// The numbers of an object by their names; lists whose name has their numbers at its end, `area_100_300`, are taken apart.
pub(super) fn numbers(of: &Map<String, Value>) -> Vec<(String, Option<f64>)> {
    let finite = |value: &Value| value.as_f64().filter(|value| value.is_finite());
    let mut found = Vec::new();
    for (key, value) in of {
        match value {
            Value::Number(_) | Value::Null => found.push((key.clone(), finite(value))),
            Value::Array(list) => found.extend(apart(key, list.len()).into_iter().zip(list.iter().map(finite))),
            _ => {}
        }
    }
    found
}

/// `area_100_300` as `area_100` and `area_300`; nothing where the name has not so many numbers.
fn apart(key: &str, count: usize) -> Vec<String> {
    let mut parts: Vec<&str> = key.rsplitn(count + 1, '_').collect();
    let Some(start) = parts.pop().filter(|_| parts.len() == count && count > 0) else { return Vec::new() };
    let numeric = parts.iter().all(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()));
    if numeric { parts.iter().rev().map(|part| format!("{start}_{part}")).collect() } else { Vec::new() }
}

/// A figure of a number that has no error in the file.
pub(super) fn figure(key: &str, value: Option<f64>) -> Figure {
    Figure::new(key, value.map(|value| Estimate::new(value, None)), unit(key))
}
