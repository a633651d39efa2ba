//! Views on disk: a table of the points, and plans of grids.

use super::areas::{Seen, SeenGrid};
use crate::{
    file::{print_path, put},
    measure::draw,
};
use gonio::{
    Result,
    measure::{GridReading, quoted},
    output::FalseColourScale,
    scene::Scene,
    view_out::{Layer, View, ViewLevel},
};
use std::{
    fmt::Write,
    path::{Path, PathBuf},
};

/// A figure that is drawn: the file's name, the unit, the end of the scale and its steps.
struct Drawn {
    name: &'static str,
    unit: &'static str,
    max: f32,
    steps: u32,
    of: fn(&View) -> f64,
}

const DRAWN: [Drawn; 3] = [
    // The first two limits of levels are edges.
    Drawn { name: "sight_angle.png", unit: "deg", max: 70.0, steps: 5, of: |view| view.sight_angle_deg },
    Drawn { name: "distance.png", unit: "m", max: 60.0, steps: 10, of: View::distance_m },
    // Edges lie between the whole numbers.
    Drawn { name: "level.png", unit: "", max: 3.2, steps: 4, of: |view| reached(view.level()) as f64 },
];

/// How many levels a view has: 0 below the minimum, 3 high.
fn reached(level: ViewLevel) -> usize {
    ViewLevel::REACHED.iter().filter(|other| **other <= level).count()
}

/// The files that a scene gives.
pub(super) fn paths(folder: &Path, scene: &Scene) -> Vec<PathBuf> {
    let drawn = DRAWN.iter().filter(|_| !scene.grids.is_empty()).map(|drawn| drawn.name);
    ["points.csv"].into_iter().chain(drawn).map(|name| folder.join(name)).collect()
}

pub(super) fn write(folder: &Path, found: &Seen<'_>, tell: bool) -> Result<()> {
    let points = folder.join("points.csv");
    put(&points, table(found).as_bytes())?;
    if tell {
        print_path(&points);
    }
    for drawn in DRAWN.iter().filter(|_| !found.grids.is_empty()) {
        let reading = |seen: &SeenGrid<'_>| {
            let values: Vec<f64> = seen.views.iter().map(drawn.of).collect();
            GridReading::of_values(seen.grid, seen.points.clone(), &values)
        };
        let readings: Vec<GridReading> = found.grids.iter().map(reading).collect();
        let scale = |_: &GridReading| Ok((drawn.unit, FalseColourScale::new(drawn.max, drawn.steps, None)?));
        draw(&readings, &folder.join(drawn.name), tell, scale)?;
    }
    Ok(())
}

/// A line for each point (RFC 4180); columns and rows of points of their own, and distances without a view, are empty.
fn table(found: &Seen<'_>) -> String {
    let mut text = "name,row,column,x_m,y_m,z_m,sight_angle_deg,widest_deg,least_m,lower_quartile_m,median_m,upper_quartile_m,greatest_m,\
                    sky_sr,landscape_sr,ground_sr,level\r\n"
        .to_owned();
    for (meter, view) in &found.meters {
        line(&mut text, &meter.origin.name, None, view);
    }
    for seen in &found.grids {
        let there = seen.points.positions.iter().enumerate().filter(|(_, place)| place.is_some());
        for ((index, _), view) in there.zip(seen.views) {
            let columns = seen.points.size[0];
            line(&mut text, &seen.grid.origin.name, Some([index / columns, index % columns]), view);
        }
    }
    text
}

fn line(text: &mut String, name: &str, place: Option<[usize; 2]>, view: &View) {
    let name = quoted(name);
    let place = place.map_or_else(|| ",".to_owned(), |[row, column]| format!("{row},{column}"));
    let [x, y, z] = view.position;
    let distances: String = match view.distances_m {
        Some(distances) => distances.iter().map(|metres| format!(",{metres:.3}")).collect(),
        None => ",".repeat(5),
    };
    let layers: String = Layer::NAMES.iter().map(|(layer, _)| format!(",{:.5}", view.layers_sr[*layer as usize])).collect();
    let (angle, widest, level) = (view.sight_angle_deg, view.widest_deg, view.level().name());
    // Writing to a string does not fail.
    let _ = write!(text, "{name},{place},{x:.6},{y:.6},{z:.6},{angle:.3},{widest:.3}{distances}{layers},{level}\r\n");
}
