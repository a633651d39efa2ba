//! Views as lines: a point each, and a table for each grid.

use super::areas::Seen;
use gonio::{
    scene::Meter,
    view_out::{AreaView, FARTHEST_M, Layer, View, ViewLevel},
};

pub(super) fn lines(found: &Seen<'_>) -> Vec<String> {
    let mut lines: Vec<String> = found.single_meters().map(|(meter, view)| point(meter, view)).collect();
    for (name, views) in found.sensor_grids() {
        lines.push(format!("{name}: view out, {} points together", views.len()));
        lines.extend(table(&AreaView::new(&views)));
    }
    for seen in &found.grids {
        let [columns, rows] = seen.points.size;
        lines.push(format!("{}: view out, {columns} × {rows} points ({} there)", seen.grid.origin, seen.views.len()));
        lines.extend(table(&AreaView::new(seen.views)));
    }
    lines
}

/// The layers that a view has, by their names.
pub(super) fn layers(view: &View) -> Vec<&'static str> {
    Layer::NAMES.iter().filter(|(layer, _)| view.sees(*layer)).map(|(_, name)| *name).collect()
}

/// Metres as they are told; what has no end says so.
fn metres(distance: f64) -> String {
    if distance >= FARTHEST_M { "open".to_owned() } else { format!("{distance:.1} m") }
}

fn point(meter: &Meter, view: &View) -> String {
    let Some([least, _, median, _, greatest]) = view.distances_m else {
        return format!("{}: no view out; EN 17037: {}", meter.origin, view.level().name());
    };
    format!(
        "{}: sight angle {:.1}° (widest part {:.1}°), outside distance {} ({} to {}), {}; EN 17037: {}",
        meter.origin,
        view.sight_angle_deg,
        view.widest_deg,
        metres(median),
        metres(least),
        metres(greatest),
        layers(view).join(", "),
        view.level().name()
    )
}

/// What most points have by each criterion, and which shares reach which level.
fn table(area: &AreaView) -> Vec<String> {
    let row = |name: &str, had: &str, level: ViewLevel, shares: [f64; 3]| {
        let [minimum, medium, high] = shares.map(|share| format!("{:.0} %", 100.0 * share));
        format!("  {name:<18}{had:>14}  {:<18}{minimum:>8}{medium:>8}{high:>8}", level.name())
    };
    let [angle, distance, layers] = area.levels;
    let head = format!("  {:<18}{:>14}  {:<18}{:>8}{:>8}{:>8}", "", "75 % have", "level", "minimum", "medium", "high");
    vec![
        head,
        row("sight angle", &format!("{:.1}°", area.sight_angle_deg), angle, area.shares[0]),
        row("outside distance", &metres(area.distance_m), distance, area.shares[1]),
        row("layers", "", layers, area.shares[2]),
        row("EN 17037", "", area.level(), area.shares_of_all),
    ]
}
