//! What `gonio emergency` prints: routes, open areas, places and luminaires.

use super::{
    area::{Area, Figure, with_notes},
    lit::{figures, lux},
    object::{Found, error, number, objects, text},
};
use crate::{estimate::Estimate, unit::Unit};
use serde_json::{Map, Value};

/// Ratios by their keys, and other names of them.
const RATIOS: [(&str, &[&str]); 1] = [("max_to_min", &["ratio"])];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let mut areas = Vec::new();
    for route in objects(whole, "routes")? {
        let mut area = Area::new(text(route, "name", "a route")?, file);
        for part in ["centre", "band"] {
            if let Some(lit) = route.get(part).and_then(Value::as_object) {
                area.figures.extend(figures(lit, &RATIOS)?.into_iter().map(|figure| Figure {
                    of: Some(part.to_owned()),
                    wants_of: true,
                    ..figure
                }));
            }
        }
        areas.push(area);
    }
    for of in objects(whole, "areas")? {
        areas.push(Area { figures: figures(of, &RATIOS)?, ..Area::new(text(of, "name", "an area")?, file) });
    }
    for of in objects(whole, "places")? {
        let value = number(of, "lx").map(|lx| Ok(Estimate::new(lx, error(of, "standard_error")?))).transpose()?;
        let figure = Figure { aliases: vec!["lx".to_owned()], ..Figure::new("illuminance", value, lux()) };
        areas.push(Area { figures: vec![figure], ..Area::new(text(of, "name", "a place")?, file) });
    }
    for of in objects(whole, "luminaires")? {
        let figure = |key: &str, unit: &str| Figure::new(key, number(of, key).map(|value| Estimate::new(value, None)), Unit::of(unit));
        let figures = vec![figure("peak_cd", "cd"), figure("height_m", "m")];
        areas.push(Area { figures, ..Area::new(text(of, "name", "a luminaire")?, file) });
    }
    Ok(with_notes(areas, whole))
}
