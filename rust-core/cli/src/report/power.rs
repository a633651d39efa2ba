//! Installed power density: of a room by its area, and of all luminaires by a grid's.

use super::schedule::Schedule;
use crate::words::Words;
use gonio::{
    compile::CompiledScene,
    measure::{GridReading, Room},
    scene::Measurand,
};
use gonio_page::fill;

/// Installed power of the room about the largest grid of illuminance, over the room's area. Where there is no closed room, or where it is asked for, that of
/// all luminaires over the grid's area, which says so. None without such a grid or without power.
pub(super) fn density(
    grids: &[GridReading],
    schedule: &Schedule<'_>,
    scene: &CompiledScene,
    (up, by_grid): ([f64; 3], bool),
    words: &Words,
) -> Vec<String> {
    let measures_illuminance = |grid: &&GridReading| grid.measurand == Measurand::Illuminance && grid.eyes.is_none();
    let Some(grid) = grids.iter().filter(measures_illuminance).max_by(|a, b| a.area.total_cmp(&b.area)) else { return Vec::new() };
    let room = middle(grid).and_then(|place| Room::about(scene, place, up));
    let mut lines = Vec::new();
    if let Some(room) = &room {
        let area = words.numbers.fixed(room.area, 2);
        let what = fill(&words.power.room, &[("area", &area), ("grid", &grid.origin.to_string())]);
        lines.extend(line(schedule.installed_power(|place| room.contains(place)), room.area, &what, grid, words));
    }
    if room.is_none() || by_grid {
        let why = if room.is_none() { words.power.no_room.as_str() } else { "" };
        let area = words.numbers.fixed(grid.area, 2);
        let what = fill(&words.power.grid, &[("area", &area), ("grid", &grid.origin.to_string())]) + why;
        lines.extend(line(schedule.installed_power(|_| true), grid.area, &what, grid, words));
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
fn line((watts, known, unknown): (f64, usize, usize), area: f64, what: &str, grid: &GridReading, words: &Words) -> Option<String> {
    if watts <= 0.0 || area <= 0.0 {
        return None;
    }
    let (say, numbers) = (&words.power, words.numbers);
    let density = watts / area;
    let average = grid.summary.average.value;
    let per_light = || fill(&say.of_light, &[("value", &numbers.fixed(density * 100.0 / average, 2))]);
    let values = [
        ("watts", numbers.short(watts)),
        ("count", known.to_string()),
        ("what", what.to_owned()),
        ("density", numbers.fixed(density, 2)),
        ("of_light", if average > 0.0 { per_light() } else { String::new() }),
        ("without", if unknown > 0 { fill(&say.without, &[("count", &unknown.to_string())]) } else { String::new() }),
    ];
    Some(fill(&say.density, &values.each_ref().map(|(name, value)| (*name, value.as_str()))))
}
