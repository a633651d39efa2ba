//! Eyes at the points of grids, and how many points and eyes reach a value: as the command line asks for them and tells them.

use super::{
    arguments::{EyeArguments, GridArguments},
    reading::{figure, places, reading_json, spaced, triple},
};
use gonio::{
    Result,
    measure::{GridReading, Reaching, Reading},
    scene::{Eyes, Scene},
};
use serde_json::{Map, Value, json};

/// Level directions around where nothing is said.
const AROUND: u32 = 4;

/// The grids of the command line at the height of their eyes.
pub(super) fn at_eyes(grids: &GridArguments, eyes: &EyeArguments) -> GridArguments {
    GridArguments { height: grids.height.or(eyes.eyes), ..grids.clone() }
}

/// Puts the eyes that are asked for at the grids of the command line.
pub(super) fn open(scene: &mut Scene, grids: &GridArguments, eyes: &EyeArguments, facing: &[String]) -> Result<()> {
    if eyes.eyes.is_none() {
        return Ok(());
    }
    let looking = looking(facing, eyes.directions)?;
    let named = scene.grids.iter_mut().filter(|grid| grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    named.for_each(|grid| grid.eyes = Some(looking.clone()));
    Ok(())
}

/// Where eyes look that look these ways, or so many around.
pub(super) fn looking(facing: &[String], directions: Option<u32>) -> Result<Eyes> {
    let facings = facing.iter().map(|text| triple("facing", text)).collect::<Result<Vec<_>>>()?;
    Ok(if facings.is_empty() { Eyes::Around(directions.unwrap_or(AROUND)) } else { Eyes::Towards(facings) })
}

/// What eyes add to a grid's lines.
pub(super) fn lines(grid: &GridReading) -> Vec<String> {
    let Some(eyes) = &grid.eyes else { return Vec::new() };
    let shown = |reading: &Reading| figure(reading, places(grid.measurand, [2; 2]), &spaced(grid.measurand));
    let towards = |([x, y, z], reading): (&[f64; 3], Reading)| format!("  towards {x:.2},{y:.2},{z:.2}: average {}", shown(&reading));
    let mut lines = vec![format!("  least eye: {}", shown(&eyes.least()))];
    lines.extend(eyes.facings.iter().zip(eyes.by_facing()).map(towards));
    lines
}

/// Which shares of a grid's points and eyes reach a value.
pub(super) fn reaching_line(grid: &GridReading, target: f64) -> String {
    let share = |found: Reaching| format!("{:.1} % ({:.1} % within the error)", 100.0 * found.share().value, 100.0 * found.share_open());
    let of_eyes = grid.eyes.as_ref().map_or(String::new(), |eyes| {
        let (all_ways, views) = (share(eyes.reaching_all_ways(target)), share(eyes.reaching_views(target)));
        format!(" by the mean over the directions, at {all_ways} all ways, by {views} of the eyes")
    });
    format!("  {target}{} reached at {} of the points{of_eyes}", spaced(grid.measurand), share(grid.reaching(target)))
}

/// What eyes get, for machines: by place in the grid's rows, `null` where there is no point.
pub(super) fn eyes_json(grid: &GridReading) -> Value {
    let Some(eyes) = &grid.eyes else { return Value::Null };
    let leasts = eyes.leasts();
    let in_rows = |of: &dyn Fn(usize) -> Value| {
        let mut number = 0..eyes.views.len();
        let place = |is_there: bool| is_there.then(|| number.next()).flatten().map_or(Value::Null, of);
        grid.points.iter().map(Option::is_some).map(place).collect::<Vec<_>>()
    };
    let views = |of: fn(&Reading) -> f64| in_rows(&|point| json!(eyes.views[point].iter().map(of).collect::<Vec<_>>()));
    json!({
        "facings": eyes.facings,
        "by_facing": eyes.by_facing().iter().map(reading_json).collect::<Vec<_>>(),
        "least": reading_json(&eyes.least()),
        "values": views(|reading| reading.value),
        "standard_errors": views(|reading| reading.standard_error),
        "leasts": in_rows(&|point| json!(leasts[point].value)),
        "least_standard_errors": in_rows(&|point| json!(leasts[point].standard_error)),
    })
}

/// Which shares reach a value, for machines.
pub(super) fn reaching_json(grid: &GridReading, target: Option<f64>) -> Value {
    let Some(target) = target else { return Value::Null };
    let mut all = Map::new();
    let mut add = |name: &str, found: Reaching| {
        let Reading { value, standard_error } = found.share();
        let count = found.count;
        let told = json!({ "count": count, "share": value, "standard_error": standard_error, "share_within_error": found.share_open() });
        all.insert(name.to_owned(), told);
    };
    add("points", grid.reaching(target));
    if let Some(eyes) = &grid.eyes {
        add("points_all_ways", eyes.reaching_all_ways(target));
        add("eyes", eyes.reaching_views(target));
    }
    all.insert("value".to_owned(), json!(target));
    Value::Object(all)
}
