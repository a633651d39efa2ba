//! Views for machines.

use super::{
    areas::{Seen, SeenGrid},
    text::layers,
};
use crate::messages::diagnostics_json;
use gonio::{
    Diagnostic,
    scene::Meter,
    view_out::{AreaView, Criterion, FARTHEST_M, Layer, SHARE, View, ViewLevel, ViewTask},
};
use serde_json::{Map, Value, json};

pub(super) fn whole<'a>(found: &Seen<'_>, task: &ViewTask, told: impl Iterator<Item = &'a Diagnostic>) -> Value {
    let meter = |(meter, view): &(&Meter, &View)| {
        let mut all = point(view);
        all.insert("name".into(), json!(&*meter.origin.name));
        all
    };
    let sensor_grids = found.sensor_grids();
    let together = sensor_grids.iter().map(|(name, views)| area(name, views)).collect::<Vec<_>>();
    let grid = |seen: &SeenGrid<'_>| {
        let mut all = area(&seen.grid.origin.name, seen.views);
        let mut next = seen.views.iter().map(point);
        let points: Vec<Option<Map<String, Value>>> = seen.points.positions.iter().map(|place| place.and_then(|_| next.next())).collect();
        all.extend([
            ("columns".to_owned(), json!(seen.points.size[0])),
            ("rows".to_owned(), json!(seen.points.size[1])),
            ("spacing_m".to_owned(), json!(seen.points.spacing)),
            ("points".to_owned(), json!(points)),
        ]);
        all
    };
    json!({
        "field_deg": task.field_deg,
        "step_deg": task.step_deg,
        "nearest_m": task.nearest_m,
        "horizon_deg": task.horizon_deg,
        "farthest_m": FARTHEST_M,
        "share_of_points": SHARE,
        "meters": found.meters.iter().map(meter).collect::<Vec<_>>(),
        "sensor_grids": together,
        "grids": found.grids.iter().map(grid).collect::<Vec<_>>(),
        "diagnostics": diagnostics_json(told),
    })
}

fn point(view: &View) -> Map<String, Value> {
    let levels = Criterion::ALL.map(|criterion| (criterion.name().to_owned(), json!(view.level_by(criterion).name())));
    let shares = Layer::NAMES.iter().map(|(layer, name)| ((*name).to_owned(), json!(view.layers_sr[*layer as usize])));
    let all = [
        ("position_m", json!(view.position)),
        ("sight_angle_deg", json!(view.sight_angle_deg)),
        ("widest_deg", json!(view.widest_deg)),
        ("distance_m", json!(view.distance_m())),
        ("distances_m", json!(view.distances_m)),
        ("layers", json!(layers(view))),
        ("layers_sr", Value::Object(shares.collect())),
        ("en17037_level", json!(view.level().name())),
        ("en17037_levels", Value::Object(levels.into_iter().collect())),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// The points of an area together.
fn area(name: &str, views: &[View]) -> Map<String, Value> {
    let found = AreaView::new(views);
    let levels = Criterion::ALL.iter().zip(found.levels).map(|(criterion, level)| (criterion.name().to_owned(), json!(level.name())));
    let shares = Criterion::ALL.iter().zip(found.shares).map(|(criterion, shares)| (criterion.name().to_owned(), reached(shares)));
    let shares = shares.chain([("all".to_owned(), reached(found.shares_of_all))]);
    let all = [
        ("name", json!(name)),
        ("count", json!(views.len())),
        ("sight_angle_deg", json!(found.sight_angle_deg)),
        ("distance_m", json!(found.distance_m)),
        ("en17037_level", json!(found.level().name())),
        ("en17037_levels", Value::Object(levels.collect())),
        ("shares", Value::Object(shares.collect())),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Shares of points by the level that they reach.
fn reached(shares: [f64; 3]) -> Value {
    let named = ViewLevel::REACHED.into_iter().zip(shares);
    Value::Object(named.map(|(level, share)| (level.name().to_owned(), json!(share))).collect())
}
