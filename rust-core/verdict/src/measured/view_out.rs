//! What `gonio view-out` prints: eyes one by one, sensor grids of models, and grids.

use super::{
    area::{Area, Figure, with_notes},
    object::{Found, number, objects, text},
};
use crate::{estimate::Estimate, plan::Plan, unit::Unit};
use serde_json::{Map, Value};

/// Figures by their names, their keys in the file, their units, and other names of them.
const FIGURES: [(&str, &str, &str, &str); 2] =
    [("sight_angle", "sight_angle_deg", "°", "horizontal_sight_angle"), ("distance", "distance_m", "m", "outside_distance")];
/// What shares of points reach, by the names of the levels.
const LEVELS: [(&str, &str); 3] = [("view_minimum", "minimum"), ("view_medium", "medium"), ("view_high", "high")];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let meters = objects(whole, "meters")?.into_iter().map(|of| area(of, "an eye", file));
    let together = objects(whole, "sensor_grids")?.into_iter().chain(objects(whole, "grids")?);
    let areas: Found<Vec<Area>> = meters.chain(together.map(|of| area(of, "a grid", file))).collect();
    Ok(with_notes(areas?, whole))
}

/// An eye, or the points of a grid: of these the figures are what three quarters have.
fn area(of: &Map<String, Value>, what: &str, file: usize) -> Found<Area> {
    let mut area = Area::new(text(of, "name", what)?, file);
    for (name, key, sign, alias) in FIGURES {
        let shown = plan(of, name, key, sign).map(|plan| {
            area.plans.push(plan);
            area.plans.len() - 1
        });
        let value = number(of, key).map(|value| Estimate::new(value, None));
        area.figures.push(Figure { aliases: vec![alias.to_owned()], plan: shown, ..Figure::new(name, value, Unit::of(sign)) });
    }
    for (criterion, shares) in of.get("shares").and_then(Value::as_object).into_iter().flatten() {
        let Some(shares) = shares.as_object() else { continue };
        let criterion = Some(criterion).filter(|criterion| *criterion != "all").cloned();
        let figure = |(name, level): (&str, &str)| {
            let value = number(shares, level).map(|value| Estimate::new(value, None));
            Figure { of: criterion.clone(), wants_of: criterion.is_some(), ..Figure::new(name, value, Unit::share()) }
        };
        area.figures.extend(LEVELS.map(figure));
    }
    Ok(area)
}

/// A figure of the points where they lie.
fn plan(of: &Map<String, Value>, name: &str, key: &str, sign: &str) -> Option<Plan> {
    let count = |key: &str| of.get(key)?.as_u64()?.try_into().ok();
    let spacing: Vec<f64> = of.get("spacing_m")?.as_array()?.iter().filter_map(Value::as_f64).collect();
    let values = of.get("points")?.as_array()?.iter().map(|point| number(point.as_object()?, key)).collect();
    Plan::new([count("columns")?, count("rows")?], spacing.try_into().ok()?, values, name, sign)
}
