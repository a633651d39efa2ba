//! Eyes at a grid's points, and which shares of points and eyes reach the value that `gonio measure --target` names.

use super::{
    area::Figure,
    object::{Found, error, number},
};
use crate::{estimate::Estimate, note::Note, unit::Unit};
use serde_json::{Map, Value};

/// Shares by their names, and by their keys in the file.
const SHARES: [(&str, &str); 3] = [("share_of_points", "points"), ("share_all_ways", "points_all_ways"), ("share_of_eyes", "eyes")];

/// The figures that a grid has of them.
pub(super) fn figures(grid: &Map<String, Value>, quantity: &str, unit: &Unit) -> Found<Vec<Figure>> {
    let part = |key: &str| grid.get(key).and_then(Value::as_object);
    let mut figures = Vec::new();
    if let Some(least) = part("eyes").and_then(|eyes| eyes.get("least")).and_then(Value::as_object) {
        figures.push(figure("least_eye", quantity, estimate(least, "value")?, unit.clone()));
    }
    let Some(target) = part("target") else { return Ok(figures) };
    for (name, key) in SHARES {
        if let Some(share) = target.get(key).and_then(Value::as_object) {
            let notes = number(target, "value").map(|value| Note::Target { value, unit: unit.sign.clone() }).into_iter().collect();
            figures.push(Figure { notes, ..figure(name, quantity, estimate(share, "share")?, Unit::share()) });
        }
    }
    Ok(figures)
}

fn figure(name: &str, quantity: &str, value: Option<Estimate>, unit: Unit) -> Figure {
    Figure { of: Some(quantity.to_owned()), ..Figure::new(name, value, unit) }
}

fn estimate(of: &Map<String, Value>, key: &str) -> Found<Option<Estimate>> {
    let error = error(of, "standard_error")?;
    Ok(number(of, key).map(|value| Estimate::new(value, error)))
}
