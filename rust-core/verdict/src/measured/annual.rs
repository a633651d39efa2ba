//! What `gonio annual` and `gonio annual-metrics` print: a year of daylight.

use super::{
    area::{Area, Figure, with_notes},
    object::{Found, number, objects, text},
    table,
};
use crate::{estimate::Estimate, note::Note, plan::Plan};
use serde_json::{Map, Value};

/// Figures of a grid, and what of its points a plan shows for them.
const SHOWN: [(&str, &str); 5] = [
    ("sda_300_50", "da_300"),
    ("ase_1000_250", "hours_direct_1000"),
    ("mean_lx", "mean_lx"),
    ("udi_100_3000", "udi_100_3000"),
    ("median_daylight_factor", "daylight_factor"),
];
/// Numbers of a grid that are no figures.
const NO_FIGURES: [&str; 3] = ["columns", "rows", "used_hours"];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let areas: Found<Vec<Area>> = objects(whole, "grids")?.into_iter().map(|of| grid(of, file)).collect();
    Ok(with_notes(areas?, whole))
}

fn grid(of: &Map<String, Value>, file: usize) -> Found<Area> {
    let mut area = Area::new(text(of, "name", "a grid")?, file);
    let errors = of.get("standard_errors").and_then(Value::as_object);
    let points = Points::new(of, errors);
    for name in points.names() {
        let plan = points.plan(of, &name);
        area.figures.extend(points.figures(&name, plan.as_ref().map(|_| area.plans.len())));
        area.plans.extend(plan);
    }
    let known: Vec<String> = area.plans.iter().map(|plan| plan.of.clone()).collect();
    for (key, value) in table::numbers(of).into_iter().filter(|(key, _)| !NO_FIGURES.contains(&key.as_str())) {
        let error = errors.and_then(|errors| number(errors, &key));
        let mut figure = figure(&key, value.map(|value| Estimate::new(value, error)));
        let shown = SHOWN.iter().find(|(name, _)| *name == key).map(|(_, shown)| *shown);
        figure.plan = shown.and_then(|shown| known.iter().position(|of| of == shown));
        // The mean of the points' means is the grid's, with its own error.
        area.figures.retain(|other| !other.aliases.contains(&key));
        area.figures.push(figure);
    }
    area.figures.extend(daylight_provision(of, errors));
    area.figures.extend(electric_light(of, errors));
    Ok(area)
}

fn figure(key: &str, value: Option<Estimate>) -> Figure {
    let notes = value.filter(|value| value.error.is_none()).map(|_| Note::NoError).into_iter().collect();
    Figure { notes, ..Figure::new(key, value, table::unit(key)) }
}

/// Energy of the lamps beside daylight, where it was asked for.
fn electric_light(of: &Map<String, Value>, errors: Option<&Map<String, Value>>) -> Vec<Figure> {
    let object = |of: &Map<String, Value>| of.get("electric").and_then(Value::as_object).cloned();
    let (Some(found), errors) = (object(of), errors.and_then(object)) else { return Vec::new() };
    let error = |key: &str| errors.as_ref().and_then(|errors| number(errors, key));
    let of_key = |(key, value): (String, Option<f64>)| figure(&key, value.map(|value| Estimate::new(value, error(&key))));
    table::numbers(&found).into_iter().map(of_key).collect()
}

/// Shares of the area by both methods of EN 17037: `hourly_area_300`, `daylight_factor_area_300`.
fn daylight_provision(of: &Map<String, Value>, errors: Option<&Map<String, Value>>) -> Vec<Figure> {
    let Some(provision) = of.get("en17037").and_then(Value::as_object) else { return Vec::new() };
    let of_method = |(method, value): (&String, &Value)| {
        let numbers = value.as_object().map(table::numbers).unwrap_or_default();
        let errors = errors.and_then(|errors| errors.get("en17037")?.get(method)?.as_object()).map(table::numbers).unwrap_or_default();
        let error = |key: &str| errors.iter().find(|(known, _)| known == key).and_then(|(_, error)| *error);
        let named = numbers.into_iter().map(|(key, value)| (format!("{method}_{key}"), value, error(&key)));
        named.map(|(key, value, error)| figure(&key, value.map(|value| Estimate::new(value, error)))).collect::<Vec<_>>()
    };
    provision.iter().flat_map(of_method).collect()
}

/// Numbers of the points, and their errors.
struct Points {
    values: Vec<Vec<(String, Option<f64>)>>,
    errors: Vec<Vec<(String, Option<f64>)>>,
}

impl Points {
    fn new(of: &Map<String, Value>, errors: Option<&Map<String, Value>>) -> Self {
        let list = |of: Option<&Map<String, Value>>| {
            let points = of.and_then(|of| of.get("points")?.as_array()).map(Vec::as_slice).unwrap_or_default();
            points.iter().map(|point| point.as_object().map(table::numbers).unwrap_or_default()).collect()
        };
        Self { values: list(Some(of)), errors: list(errors) }
    }

    fn names(&self) -> Vec<String> {
        self.values.first().into_iter().flatten().map(|(key, _)| key.clone()).collect()
    }

    /// A number of every point, in their order.
    fn of(list: &[Vec<(String, Option<f64>)>], name: &str) -> Vec<Option<f64>> {
        list.iter().map(|point| point.iter().find(|(key, _)| key == name).and_then(|(_, value)| *value)).collect()
    }

    /// Mean, least and greatest of the points.
    fn figures(&self, name: &str, plan: Option<usize>) -> Vec<Figure> {
        let (values, errors) = (Self::of(&self.values, name), Self::of(&self.errors, name));
        let error = |index: usize| errors.get(index).copied().flatten().filter(|error| *error >= 0.0);
        let each: Vec<Estimate> =
            values.iter().enumerate().filter_map(|(index, value)| Some(Estimate::new((*value)?, error(index)))).collect();
        let by_value = |a: &&Estimate, b: &&Estimate| a.value.total_cmp(&b.value);
        let (least, greatest) = (each.iter().min_by(by_value).copied(), each.iter().max_by(by_value).copied());
        let found = [("mean", mean(&each)), ("minimum", least), ("maximum", greatest)];
        let make = |(key, value): (&str, Option<Estimate>)| {
            let aliases = if key == "mean" { vec![name.to_owned()] } else { Vec::new() };
            let mut made = Figure { aliases, of: Some(name.to_owned()), wants_of: true, plan, ..figure(key, value) };
            made.unit = table::unit(name);
            made.notes.extend(value.filter(|value| key == "mean" && value.error.is_some()).map(|_| Note::ErrorsAdded));
            made
        };
        found.map(make).into()
    }

    fn plan(&self, of: &Map<String, Value>, name: &str) -> Option<Plan> {
        let count = |key: &str| of.get(key)?.as_u64()?.try_into().ok();
        let size: [usize; 2] = [count("columns")?, count("rows")?];
        let values = Self::of(&self.values, name);
        Plan::new(size, spacing(of, size)?, values, name, &table::unit(name).sign)
    }
}

/// The mean. How points' errors go together is not in the file: its own is at most their mean.
fn mean(each: &[Estimate]) -> Option<Estimate> {
    let count = each.len() as f64;
    let value = each.iter().map(|point| point.value).sum::<f64>() / count;
    let error = each.iter().map(|point| point.error).sum::<Option<f64>>().map(|sum| sum / count);
    (count > 0.0).then_some(Estimate { value, error })
}

/// Distances of neighbours along and across; of a single row or column the same both ways.
fn spacing(of: &Map<String, Value>, [columns, rows]: [usize; 2]) -> Option<[f64; 2]> {
    let points = of.get("points")?.as_array()?;
    let place = |index: usize| points.get(index)?.get("position_m")?.as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>();
    let apart = |index: usize| {
        let (a, b) = (place(0)?, place(index)?);
        Some(a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt())
    };
    let along = (columns > 1).then(|| apart(1)).flatten();
    let across = (rows > 1).then(|| apart(columns)).flatten();
    Some([along.or(across)?, across.or(along)?])
}
