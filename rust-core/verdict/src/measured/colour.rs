//! Figures of the light's colour, of which a meter that measures one tells all.

use super::{
    area::Figure,
    object::{Found, error, number},
};
use crate::{estimate::Estimate, unit::Unit};
use serde_json::{Map, Value};

/// The figures with their units. They are not proportional to light.
const FIGURES: [(&str, &str); 5] = [("cct", "K"), ("duv", ""), ("ra", ""), ("rf", ""), ("rg", "")];

/// Whether a quantity is one of them.
pub(super) fn is_of_colour(quantity: &str) -> bool {
    FIGURES.iter().any(|(name, _)| *name == quantity)
}

/// The figures of a meter beside its own, and the melanopic light on its plane.
pub(super) fn beside(own: &str, meter: &Map<String, Value>) -> Found<Vec<Figure>> {
    let Some(colour) = meter.get("colour").and_then(Value::as_object) else { return Ok(Vec::new()) };
    let empty = Map::new();
    let errors = colour.get("standard_errors").and_then(Value::as_object).unwrap_or(&empty);
    let figure = |key: &str, name: &str, unit: Unit| -> Found<Figure> {
        let error = error(errors, key)?;
        Ok(Figure::new(name, number(colour, key).map(|value| Estimate::new(value, error)), unit))
    };
    let others = FIGURES.into_iter().filter(|(name, _)| *name != own).map(|(name, sign)| figure(name, name, Unit::of(sign)));
    others.chain([figure("melanopic_edi_lx", "melanopic_edi", Unit::light("lx"))]).collect()
}
