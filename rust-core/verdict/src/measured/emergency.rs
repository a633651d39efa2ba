//! What `gonio emergency` prints: routes, open areas, places and luminaires.

use super::{
    area::{Area, Figure},
    object::{Found, error, number, objects, text},
};
use crate::{estimate::Estimate, unit::Unit};
use serde_json::{Map, Value};

/// Figures of light by their keys without unit, and other names of them.
const LIT: [(&str, &[&str]); 3] = [("min", &["e_min", "least"]), ("max", &["e_max"]), ("average", &["mean", "e_av"])];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let mut areas = Vec::new();
    for route in objects(whole, "routes")? {
        let mut area = Area::new(text(route, "name", "a route")?, file);
        for part in ["centre", "band"] {
            if let Some(lit) = route.get(part).and_then(Value::as_object) {
                area.figures.extend(figures(lit)?.into_iter().map(|figure| Figure { of: Some(part.to_owned()), wants_of: true, ..figure }));
            }
        }
        areas.push(area);
    }
    for of in objects(whole, "areas")? {
        areas.push(Area { figures: figures(of)?, ..Area::new(text(of, "name", "an area")?, file) });
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
    Ok(areas)
}

/// What the file's light is already multiplied with is no maintenance factor of a requirement.
fn lux() -> Unit {
    Unit::of("lx")
}

/// The figures of a line or an area.
fn figures(of: &Map<String, Value>) -> Found<Vec<Figure>> {
    let mut found = Vec::new();
    for (key, others) in LIT {
        let value = match number(of, &format!("{key}_lx")) {
            Some(value) => Some(Estimate::new(value, error(of, &format!("{key}_error_lx"))?)),
            None => None,
        };
        found.push(Figure { aliases: others.iter().map(|name| (*name).to_owned()).collect(), ..Figure::new(key, value, lux()) });
    }
    let ratio = match number(of, "max_to_min") {
        Some(ratio) => Some(Estimate::new(ratio, error(of, "max_to_min_error")?)),
        None => None,
    };
    found.push(Figure { aliases: vec!["ratio".to_owned()], ..Figure::new("max_to_min", ratio, Unit::plain()) });
    Ok(found)
}
