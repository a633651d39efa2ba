//! What `gonio road` prints: the road, its footpaths, edges and observers.

use super::{
    area::{Area, with_notes},
    object::number,
    table,
};
use crate::{note::Note, plan::Plan, unit::Unit};
use serde_json::{Map, Value};
use std::path::Path;

/// Numbers that are no figures.
const NO_FIGURES: [&str; 5] = ["lane", "veiling_x", "distance", "optimised", "wet_surface"];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Vec<Area> {
    let path = whole.get("file").and_then(Value::as_str).unwrap_or("road");
    let stem = Path::new(path).file_stem().map_or("road".into(), |stem| stem.to_string_lossy());
    let mut road = area(&stem, whole, file);
    road.aliases = vec!["road".to_owned(), path.to_owned()];
    if let Some(energy) = whole.get("energy").and_then(Value::as_object) {
        road.figures.extend(area("", energy, file).figures);
    }
    road.plans = plan(whole).into_iter().collect();
    if !road.plans.is_empty() {
        road.figures
            .iter_mut()
            .filter(|figure| matches!(figure.key.as_str(), "e_av" | "e_min" | "e_max" | "u0"))
            .for_each(|figure| figure.plan = Some(0));
    }
    let parts = |key: &str, name: &dyn Fn(&Map<String, Value>) -> Option<String>| {
        let list = whole.get(key).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
        let named = list.iter().filter_map(|entry| entry.as_object()).filter_map(|of| Some((name(of)?, of)));
        named.map(|(name, of)| area(&name, of, file)).collect::<Vec<_>>()
    };
    let text = |of: &Map<String, Value>, key: &str| of.get(key).and_then(Value::as_str).map(str::to_owned);
    let paths = parts("footpaths", &|of| text(of, "name"));
    let edges = parts("edges", &|of| Some(format!("{} edge", text(of, "side")?)));
    let lanes = parts("observers", &|of| Some(format!("lane {}", number(of, "lane")?)));
    with_notes(std::iter::once(road).chain(paths).chain(edges).chain(lanes).collect(), whole)
}

/// An area of all numbers of an object.
fn area(name: &str, of: &Map<String, Value>, file: usize) -> Area {
    let mut area = Area::new(name, file);
    for (key, value) in table::numbers(of).into_iter().filter(|(key, _)| !NO_FIGURES.contains(&key.as_str())) {
        let mut figure = table::figure(&key, value);
        // Roads have maintenance factors of their own.
        figure.unit = Unit { light: false, ..figure.unit };
        figure.notes = vec![Note::Calculated];
        area.figures.push(figure);
    }
    area
}

/// Illuminances on the carriageway.
fn plan(whole: &Map<String, Value>) -> Option<Plan> {
    let list = |key: &str| whole.get(key)?.as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>();
    let rows: Vec<&Vec<Value>> = whole.get("illuminance")?.as_array()?.iter().map(Value::as_array).collect::<Option<_>>()?;
    let (x, y) = (list("x")?, list("illuminance_y")?);
    // The first point lies half a step from the edge.
    let steps = [2.0 * y.first()?, (x.get(1)? - x.first()?)];
    let values = rows.iter().flat_map(|row| row.iter().map(Value::as_f64)).collect();
    Plan::new([x.len(), y.len()], [steps[1], steps[0]], values, "illuminance", "lx")
}
