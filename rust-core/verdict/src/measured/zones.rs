//! What `gonio zones` prints: rooms and task areas with their zones.

use super::{
    area::{Area, Figure, with_notes},
    lit::{estimate, figures},
    object::{Found, objects, text},
};
use crate::{note::Note, plan::Plan, unit::Unit};
use serde_json::{Map, Value};

/// Ratios by their keys, and other names of them.
const RATIOS: [(&str, &[&str]); 2] = [("u0", &["uniformity", "uo"]), ("ud", &["diversity"])];
/// The most cells of a plan: more are no file of ours.
const MOST: usize = 1 << 22;
/// Zones by their keys.
const ZONES: [&str; 6] = ["task", "surround", "background", "walls", "ceiling", "cylindrical"];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let mut areas = Vec::new();
    for (list, what) in [("rooms", "a room"), ("tasks", "a task")] {
        for of in objects(whole, list)? {
            let mut area = Area::new(text(of, "name", what)?, file);
            for (zone, lit) in ZONES.iter().filter_map(|zone| Some((*zone, of.get(*zone)?.as_object()?))) {
                add(&mut area, zone, lit)?;
            }
            for (number, wall) in (1..).zip(of.get("each_wall").and_then(Value::as_array).into_iter().flatten()) {
                if let Some(lit) = wall.as_object() {
                    add(&mut area, &format!("wall {number}"), lit)?;
                }
            }
            let modelling = Figure::new("modelling", estimate(of, "modelling", "modelling_error")?, Unit::plain());
            area.figures.push(Figure { notes: vec![Note::RatioOfMeans], ..modelling });
            areas.push(area);
        }
    }
    Ok(with_notes(areas, whole))
}

/// The figures of a zone, with its plan.
fn add(area: &mut Area, zone: &str, lit: &Map<String, Value>) -> Found<()> {
    let plan = plan(lit, zone);
    let number = plan.as_ref().map(|_| area.plans.len());
    area.plans.extend(plan);
    let in_zone = |figure: Figure| Figure { of: Some(zone.to_owned()), wants_of: true, plan: number, ..figure };
    area.figures.extend(figures(lit, &RATIOS)?.into_iter().map(in_zone));
    Ok(())
}

/// Its points where they lie; none of all walls together.
fn plan(lit: &Map<String, Value>, zone: &str) -> Option<Plan> {
    let list = |key: &str| lit.get(key)?.as_array().map(Vec::as_slice);
    let number = |value: &Value| value.as_u64().and_then(|number| usize::try_from(number).ok());
    let size = [number(list("size")?.first()?)?, number(list("size")?.get(1)?)?];
    let spacing = [list("spacing_m")?.first()?.as_f64()?, list("spacing_m")?.get(1)?.as_f64()?];
    let count = size[0].checked_mul(size[1]).filter(|count| *count <= MOST)?;
    let mut values = vec![None; count];
    for (cell, point) in list("cells")?.iter().zip(list("points")?) {
        *values.get_mut(number(cell)?)? = point.get("lx").and_then(Value::as_f64);
    }
    Plan::new(size, spacing, values, zone, "lx")
}
