//! Who looks, and the floors whose sun closes blinds.

use crate::{arguments::AnnualGlareOptions, reading::triple};
use gonio::{
    Error, Result,
    annual::Facade,
    annual_glare::{Eye, closes_by_sun},
    measure::{GridPoints, around},
    scene::{Grid, Measurand, Meter, Origin, Scene},
};

/// Metres above the floor, from point to point and from its edges: where LM-83 has points.
const OF_LM_83: [f64; 3] = [0.76, 0.5, 0.3];

/// The eyes of the command line, and those over grids, which look around.
pub(super) fn eyes(options: &AnnualGlareOptions, scene: &Scene, up: [f64; 3], ahead: [f64; 3]) -> Result<Vec<Eye>> {
    let facings = options.facing.iter().map(|text| triple("facing", text)).collect::<Result<Vec<_>>>()?;
    let directions = if facings.is_empty() { around(up, ahead, options.directions.unwrap_or(4)) } else { facings };
    let looking = |name: &str, position: [f64; 3]| {
        let eye = |(number, facing): (usize, &[f64; 3])| {
            let name = if directions.len() > 1 { format!("{name} ({} of {})", number + 1, directions.len()) } else { name.to_owned() };
            Eye { origin: Origin::new(name), position, facing: *facing }
        };
        directions.iter().enumerate().map(eye).collect::<Vec<_>>()
    };
    let mut eyes = Vec::new();
    for text in &options.eye {
        eyes.extend(looking(text, triple("eye", text)?));
    }
    for grid in scene.grids.iter().filter(|grid| options.grids.grid.iter().any(|prim| *prim == *grid.origin.name)) {
        for (place, position) in GridPoints::new(scene, grid)?.known().enumerate() {
            eyes.extend(looking(&format!("{}/{}", grid.origin.name, place + 1), position));
        }
    }
    if eyes.is_empty() {
        return Err(Error::setting("eye", "there is nobody who looks; name an eye with --eye X,Y,Z or a floor with --grid /Prim"));
    }
    Ok(eyes)
}

/// Points of the floors whose direct sun closes blinds; none where it closes none.
pub(super) fn floor(options: &AnnualGlareOptions, scene: &Scene, facades: &[Facade]) -> Result<Vec<Meter>> {
    let named = if options.blinds_floor.is_empty() { &options.grids.grid } else { &options.blinds_floor };
    let mut points = Vec::new();
    for grid in scene.grids.iter().filter(|_| closes_by_sun(facades)) {
        let is_named = named.iter().any(|prim| *prim == *grid.origin.name);
        if is_named {
            let [height, spacing, margin] = OF_LM_83;
            let grid = Grid { height, spacing, margin, eyes: None, measurand: Measurand::Illuminance, ..grid.clone() };
            points.extend(GridPoints::new(scene, &grid)?.planes(&grid));
        } else if named.is_empty() && grid.eyes.is_none() && grid.measurand == Measurand::Illuminance {
            points.extend(GridPoints::new(scene, grid)?.planes(grid));
        }
    }
    if points.is_empty() && closes_by_sun(facades) {
        let problem = "direct sun closes them by the points of a floor, and there is none; name one with --blinds-floor /Prim, or hours with --closed-hours";
        return Err(Error::setting("blinds", problem));
    }
    Ok(points)
}
