//! Eyes over the surfaces that `--grid` names, beside the grids there.

use crate::{arguments::ReportOptions, eyes::looking, words::Words};
use gonio::{
    Result,
    scene::{Grid, Measurand, Origin, Scene},
};
use gonio_page::fill;

/// Adds a grid of eyes to each grid of the command line: what they get of melanopic light.
pub(super) fn add(scene: &mut Scene, options: &ReportOptions, words: &Words) -> Result<()> {
    let Some(height) = options.eyes else { return Ok(()) };
    let looking = looking(&options.facing, options.directions)?;
    let named = scene.grids.iter().filter(|grid| options.grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    let eyes = |grid: &Grid| {
        let name = fill(&words.grids.eyes_at, &[("grid", &grid.origin.name), ("height", &words.numbers.form(&height.to_string()))]);
        let origin = Origin { name: name.into(), file: grid.origin.file.clone() };
        Grid { origin, height, eyes: Some(looking.clone()), measurand: Measurand::MelanopicEdi, ..grid.clone() }
    };
    let added: Vec<Grid> = named.map(eyes).collect();
    scene.grids.extend(added);
    Ok(())
}
