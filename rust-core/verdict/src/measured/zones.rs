//! What `gonio zones` prints: rooms and task areas with their zones.

use super::{
    area::{Area, Figure, with_notes},
    lit::{estimate, figures},
    object::{Found, objects, text},
};
use crate::{note::Note, unit::Unit};
use serde_json::{Map, Value};

/// Ratios by their keys, and other names of them.
const RATIOS: [(&str, &[&str]); 2] = [("u0", &["uniformity", "uo"]), ("ud", &["diversity"])];
/// Zones by their keys.
const ZONES: [&str; 6] = ["task", "surround", "background", "walls", "ceiling", "cylindrical"];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let mut areas = Vec::new();
    for (list, what) in [("rooms", "a room"), ("tasks", "a task")] {
        for of in objects(whole, list)? {
            let mut area = Area::new(text(of, "name", what)?, file);
            for (zone, lit) in ZONES.iter().filter_map(|zone| Some((*zone, of.get(*zone)?.as_object()?))) {
                area.figures.extend(figures(lit, &RATIOS)?.into_iter().map(|figure| in_zone(figure, zone)));
            }
            for (number, wall) in (1..).zip(of.get("each_wall").and_then(Value::as_array).into_iter().flatten()) {
                if let Some(lit) = wall.as_object() {
                    area.figures.extend(figures(lit, &RATIOS)?.into_iter().map(|figure| in_zone(figure, &format!("wall {number}"))));
                }
            }
            let modelling = Figure::new("modelling", estimate(of, "modelling", "modelling_error")?, Unit::plain());
            area.figures.push(Figure { notes: vec![Note::RatioOfMeans], ..modelling });
            areas.push(area);
        }
    }
    Ok(with_notes(areas, whole))
}

fn in_zone(figure: Figure, zone: &str) -> Figure {
    Figure { of: Some(zone.to_owned()), wants_of: true, ..figure }
}
