//! What `gonio sports` prints: fields with what lights them towards cameras, and observers.

use super::{
    area::{Area, Figure, with_notes},
    lit::{estimate, figures},
    object::{Found, objects, text},
};
use crate::unit::Unit;
use serde_json::{Map, Value};

/// Ratios by their keys, and other names of them.
const RATIOS: [(&str, &[&str]); 3] = [("u1", &["min_to_max"]), ("u2", &["min_to_average", "uo"]), ("gradient_ratio", &[])];

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let mut areas = Vec::new();
    for field in objects(whole, "fields")? {
        let mut area = Area::new(text(field, "name", "a field")?, file);
        let planes = field.get("horizontal").and_then(Value::as_object).map(|lit| ("horizontal", lit));
        let cameras = objects(field, "cameras")?;
        let cameras = cameras.into_iter().map(|camera| Ok((text(camera, "name", "a camera")?, camera))).collect::<Found<Vec<_>>>()?;
        for (plane, lit) in planes.into_iter().chain(cameras) {
            let mut of_plane = figures(lit, &RATIOS)?;
            let gradient = estimate(lit, "gradient_percent", "gradient_percent_error")?;
            of_plane.push(Figure { aliases: vec!["gradient".to_owned()], ..Figure::new("gradient_percent", gradient, Unit::of("%")) });
            area.figures.extend(of_plane.into_iter().map(|figure| Figure { of: Some(plane.to_owned()), wants_of: true, ..figure }));
        }
        if let Some(glare) = field.get("glare").and_then(Value::as_object) {
            area.figures.push(rating(glare)?);
        }
        areas.push(area);
    }
    for observer in objects(whole, "observers")? {
        areas.push(Area { figures: vec![rating(observer)?], ..Area::new(text(observer, "name", "an observer")?, file) });
    }
    Ok(with_notes(areas, whole))
}

fn rating(of: &Map<String, Value>) -> Found<Figure> {
    Ok(Figure { aliases: vec!["glare".to_owned()], ..Figure::new("gr", estimate(of, "gr", "gr_error")?, Unit::plain()) })
}
