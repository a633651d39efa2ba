//! Where light is measured: prims with `gonio:grid` and `gonio:meter` attributes; `docs/measuring.md` lists them.

use crate::context::{Context, UpAxis};
use crate::prim::Prim;
use gonio::scene::{Eyes, Grid, GridArea, Measurand, MeshId, Meter, Transform};

/// The attributes' names begin so.
const GRID: &str = "gonio:grid:";
const METER: &str = "gonio:meter:";
/// The most directions of eyes.
const MOST_DIRECTIONS: i32 = 64;

/// Whether the prim is a grid or a meter.
pub(crate) fn is_measured(prim: &Prim<'_>) -> bool {
    prim.has_authored_prefix(GRID) || prim.has_authored_prefix(METER)
}

/// Adds the grid and the meter at a prim, which may have a surface; `transform` takes its local space to metres.
pub(crate) fn add<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, mesh: Option<MeshId>, transform: &Transform) {
    if prim.has_authored_prefix(GRID)
        && let Some(grid) = grid(context, prim, mesh, transform)
    {
        context.scene.grids.push(grid);
    }
    if prim.has_authored_prefix(METER)
        && let Some(meter) = meter(context, prim, transform)
    {
        context.scene.meters.push(meter);
    }
}

/// Up, and the way that meters face when nothing is said: +Y where Z is up, −Z where Y is up.
pub fn axes(axis: UpAxis) -> [[f64; 3]; 2] {
    match axis {
        UpAxis::Y => [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
        UpAxis::Z => [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    }
}

fn grid<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, mesh: Option<MeshId>, transform: &Transform) -> Option<Grid> {
    let measurand = measurand(context, prim, GRID)?;
    let area = match mesh {
        Some(mesh) => GridArea::Mesh { mesh, transform: *transform },
        None => rectangle(context, prim, transform)?,
    };
    let [_, ahead] = axes(context.up_axis);
    let facing = direction(context, prim, &format!("{GRID}facing"), ahead);
    let [spacing, margin, height] = ["spacing", "margin", "height"].map(|name| length(context, prim, &format!("{GRID}{name}")));
    let eyes = eyes(context, prim);
    Some(Grid { origin: prim.origin(), area, spacing, margin, height, facing: transform.vector(facing), eyes, measurand })
}

/// Eyes at the points, which look so many ways around; none where none are asked for.
fn eyes<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Eyes> {
    let name = format!("{GRID}eyes");
    let found: i32 = context.get_authored(prim, &name)?;
    if (1..=MOST_DIRECTIONS).contains(&found) {
        return Some(Eyes::Around(found.unsigned_abs()));
    }
    if found != 0 {
        let problem =
            format!("{name} is {found}, expected so many directions from 1 to {MOST_DIRECTIONS}, 0 for none; the plane is measured");
        context.warn(&prim.origin(), problem);
    }
    None
}

/// The level rectangle of `gonio:grid:size` about the prim's origin.
fn rectangle<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, transform: &Transform) -> Option<GridArea> {
    let Some([width, depth]) = context.get_authored::<[f64; 2]>(prim, &format!("{GRID}size")) else {
        let type_name = prim.type_name();
        context.warn(&prim.origin(), format!("a grid on a prim of type '{type_name}' wants gonio:grid:size (double2); it is left out"));
        return None;
    };
    let [_, ahead] = axes(context.up_axis);
    let corner = [0, 1, 2].map(|i| if i == 0 { -0.5 * width } else { -0.5 * depth * ahead[i] });
    let edges = [transform.vector([width, 0.0, 0.0]), transform.vector(ahead.map(|x| x * depth))];
    Some(GridArea::Rectangle { corner: transform.point(corner), edges })
}

fn meter<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, transform: &Transform) -> Option<Meter> {
    let measurand = measurand(context, prim, METER)?;
    let [up, ahead] = axes(context.up_axis);
    let mut of = |name: &str, otherwise| direction(context, prim, &format!("{METER}{name}"), otherwise);
    let (normal, facing) = (of("normal", up), of("facing", ahead));
    Some(Meter {
        origin: prim.origin(),
        position: transform.point([0.0; 3]),
        normal: transform.vector(normal),
        facing: transform.vector(facing),
        measurand,
    })
}

/// A length in metres, 0 where none is said; what is no number is told.
fn length<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str) -> f64 {
    let found = context.get_authored::<f64>(prim, name).unwrap_or(0.0);
    if found.is_finite() {
        return found * context.metres_per_unit;
    }
    context.warn(&prim.origin(), format!("{name} is {found}, expected a number; 0 is used"));
    0.0
}

/// A direction; what is no number is told.
fn direction<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str, otherwise: [f64; 3]) -> [f64; 3] {
    let found: [f64; 3] = context.get_authored(prim, name).unwrap_or(otherwise);
    if found.iter().all(|x| x.is_finite()) {
        return found;
    }
    context.warn(&prim.origin(), format!("{name} is {found:?}, expected numbers; {otherwise:?} is used"));
    otherwise
}

/// What is measured; without a word of it, illuminance.
fn measurand<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, prefix: &str) -> Option<Measurand> {
    let Some(name) = context.get_authored::<String>(prim, &format!("{prefix}quantity")) else { return Some(Measurand::default()) };
    let found = Measurand::by_name(&name);
    if found.is_none() {
        let expected = Measurand::NAMES.map(|(_, name)| name).join(", ");
        context
            .warn(&prim.origin(), format!("{prefix}quantity '{name}' is not known, expected one of {expected}; nothing is measured there"));
    }
    found
}
