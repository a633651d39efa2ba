//! Sheets of small files made by hand.

mod bad_input;
mod figures;
mod pages;
mod verdicts;

use crate::{Measured, Requirements, Sheet, VerdictError};
use serde_json::{Value, json};
use std::path::Path;

/// A grid of three by two points, as `gonio measure` prints it.
fn grid() -> Value {
    json!({
        "meters": [],
        "grids": [{
            "name": "/Office/Desk", "quantity": "illuminance", "unit": "lx", "columns": 3, "rows": 2, "spacing_m": [0.5, 0.4], "points": 6,
            "average": { "value": 510.0, "standard_error": 4.0 },
            "min": { "value": 400.0, "standard_error": 30.0 },
            "max": { "value": 640.0, "standard_error": 8.0 },
            "values": [400.0, 480.0, 520.0, 500.0, 520.0, 640.0],
        }],
    })
}

/// A meter, as `gonio measure` prints it.
fn meter(name: &str, quantity: &str, unit: &str, value: Value) -> Value {
    json!({
        "grids": [],
        "meters": [{ "name": name, "quantity": quantity, "unit": unit, "position_m": [0, 0, 0], "value": value, "standard_error": 0.2 }],
    })
}

/// A year, as `gonio annual` prints it.
fn year() -> Value {
    let point = |autonomy: f64, place: [f64; 3]| json!({ "da_300": autonomy, "daylight_hours_100_300": [0.9, 0.8], "position_m": place });
    json!({
        "weather": "a.epw",
        "grids": [{
            "name": "Desk", "columns": 2, "rows": 1, "sda_300_50": 0.5, "ase_1000_250": null, "mean_lx": 800.0, "median_daylight_factor": 2.1,
            "en17037": { "hourly": { "area_100_300_500_750": [1.0, 0.9, 0.5, 0.1], "level": "medium" }, "median_diffuse_lx": 13000.0 },
            "points": [point(0.4, [0.0, 0.0, 0.0]), point(0.6, [0.0, 0.5, 0.0])],
            "standard_errors": { "sda_300_50": 0.01, "mean_lx": 10.0, "en17037": { "hourly": { "area_100_300_500_750": [0.0, 0.02, 0.03, 0.01] } }, "points": [{ "da_300": 0.01 }, { "da_300": 0.03 }] },
        }],
    })
}

/// A road, as `gonio road` prints it.
fn road() -> Value {
    json!({
        "file": "roads/mill.toml", "l_av": 0.88, "uo": 0.69, "uo_wet": null, "ti": 13.7, "e_av": 12.5, "energy": { "pdi": 15.3 }, "observers":
        [{ "lane": 1, "l_av": 0.88, "ti": 13.7, "position": [-60.0, 1.75, 1.5] }, { "lane": 2, "l_av": 0.9, "ti": 11.0 }],
        "footpaths": [{ "name": "north path", "e_av": 7.5, "e_min": 5.8 }], "edges": [{ "side": "right", "ratio": 0.5, "inside": 13.1 }],
        "x": [1.25, 3.75], "illuminance_y": [0.7, 2.1], "illuminance": [[1.0, 2.0], [3.0, 4.0]],
    })
}

/// Judges the requirements of a text by files called `0.json`, `1.json`, ….
fn sheet(requirements: &str, files: &[Value]) -> Result<Sheet, VerdictError> {
    let files: Vec<_> = files.iter().enumerate().map(|(k, file)| (format!("out/{k}.json").into(), file.to_string().into_bytes())).collect();
    let requirements = requirements.as_bytes();
    Sheet::new(Requirements::read(requirements, Path::new("office.toml"))?, requirements, Measured::read(&files)?)
}

/// The same of one requirement.
fn one(keys: &str, files: &[Value]) -> Result<Sheet, VerdictError> {
    sheet(&format!("[[require]]\n{}\n", keys.replace("; ", "\n")), files)
}
