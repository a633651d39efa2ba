//! Installed power density: of a room by its area, and of all luminaires by a grid's.

use super::schedule::Schedule;
use gonio::{
    compile::CompiledScene,
    measure::{GridReading, Room},
    scene::Measurand,
};
use gonio_formats::short_number;

/// Installed power of the room about the largest grid of illuminance, over the room's area. Where there is no closed room, or where it is asked for, that of
/// all luminaires over the grid's area, which says so. None without such a grid or without power.
pub(super) fn density(grids: &[GridReading], schedule: &Schedule<'_>, scene: &CompiledScene, up: [f64; 3], by_grid: bool) -> Vec<String> {
    let measures_illuminance = |grid: &&GridReading| grid.measurand == Measurand::Illuminance && grid.eyes.is_none();
    let Some(grid) = grids.iter().filter(measures_illuminance).max_by(|a, b| a.area.total_cmp(&b.area)) else { return Vec::new() };
    let room = middle(grid).and_then(|place| Room::about(scene, place, up));
    let mut lines = Vec::new();
    if let Some(room) = &room {
        let what = format!("{:.2} m² of the room about {}", room.area, grid.origin);
        lines.extend(line(schedule.installed_power(|place| room.contains(place)), room.area, &what, grid));
    }
    if room.is_none() || by_grid {
        let why = if room.is_none() { " (there is no closed room about it)" } else { "" };
        let what = format!("{:.2} m² of the grid {}{why}", grid.area, grid.origin);
        lines.extend(line(schedule.installed_power(|_| true), grid.area, &what, grid));
    }
    lines
}

/// The measured point that is nearest to the middle of all.
fn middle(grid: &GridReading) -> Option<[f64; 3]> {
    let places: Vec<[f64; 3]> = grid.points.iter().flatten().map(|(place, _)| *place).collect();
    let mean = [0, 1, 2].map(|k| places.iter().map(|place| place[k]).sum::<f64>() / places.len().max(1) as f64);
    let far = |place: &[f64; 3]| (0..3).map(|k| (place[k] - mean[k]).powi(2)).sum::<f64>();
    places.into_iter().min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Power over an area and for each 100 lx of the grid's mean; none without power.
fn line((watts, known, unknown): (f64, usize, usize), area: f64, what: &str, grid: &GridReading) -> Option<String> {
    if watts <= 0.0 || area <= 0.0 {
        return None;
    }
    let density = watts / area;
    let average = grid.summary.average.value;
    let of_light = if average > 0.0 { format!(", {:.2} W/m² per 100 lx", density * 100.0 / average) } else { String::new() };
    let without = if unknown > 0 { format!("; the power of {unknown} lights is unknown and not counted") } else { String::new() };
    let watts = short_number(watts);
    Some(format!("Installed power density: {watts} W of {known} lights over {what} are {density:.2} W/m²{of_light}{without}."))
}
