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

/// All that a spectrum says, beside what was asked for: its names in the file and as quantities, with its units.
fn others(own: &str) -> impl Iterator<Item = (&'static str, &'static str, Unit)> {
    let figures = FIGURES.into_iter().filter(move |(name, _)| *name != own).map(|(name, sign)| (name, name, Unit::of(sign)));
    figures.chain([("melanopic_edi_lx", "melanopic_edi", Unit::light("lx"))])
}

/// A figure of a spectrum, if it has one.
fn estimate(colour: &Map<String, Value>, key: &str) -> Found<Option<Estimate>> {
    let errors = colour.get("standard_errors").and_then(Value::as_object);
    let error = errors.map_or(Ok(None), |errors| error(errors, key))?;
    Ok(number(colour, key).map(|value| Estimate::new(value, error)))
}

/// The figures of a meter beside its own, and the melanopic light on its plane.
pub(super) fn beside(own: &str, meter: &Map<String, Value>) -> Found<Vec<Figure>> {
    let Some(colour) = meter.get("colour").and_then(Value::as_object) else { return Ok(Vec::new()) };
    others(own).map(|(key, name, unit)| Ok(Figure::new(name, estimate(colour, key)?, unit))).collect()
}

/// Those of a grid's points, or of their eyes: mean, least and greatest.
pub(super) fn of_points(own: &str, grid: &Map<String, Value>) -> Found<Vec<Figure>> {
    let colours: Vec<_> = grid.get("colours").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_object).collect();
    let mut figures = Vec::new();
    for (key, name, unit) in others(own).filter(|_| !colours.is_empty()) {
        let all = colours.iter().map(|colour| estimate(colour, key)).collect::<Found<Vec<_>>>()?;
        let known: Vec<Estimate> = all.into_iter().flatten().collect();
        let by_value = |a: &&Estimate, b: &&Estimate| a.value.total_cmp(&b.value);
        let least = known.iter().min_by(by_value).copied();
        let greatest = known.iter().max_by(by_value).copied();
        for (figure, value) in [("mean", mean(&known)), ("minimum", least), ("maximum", greatest)] {
            let aliases = if figure == "mean" { vec![name.to_owned()] } else { Vec::new() };
            let of = Some(name.to_owned());
            figures.push(Figure { aliases, of, wants_of: true, ..Figure::new(figure, value, unit.clone()) });
        }
    }
    Ok(figures)
}

/// The mean of independent estimates.
fn mean(all: &[Estimate]) -> Option<Estimate> {
    let count = all.len() as f64;
    let squares: Option<f64> = all.iter().map(|one| one.error.map(|error| error * error)).sum();
    (count > 0.0).then(|| Estimate::new(all.iter().map(|one| one.value).sum::<f64>() / count, squares.map(|sum| sum.sqrt() / count)))
}
