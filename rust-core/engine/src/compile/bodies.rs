//! Placed meshes that absorb or refract, and in which of those that absorb lamps may stand.

use super::{bounds::Bounds, casters::is_one};
use crate::{
    bsdf::Surface,
    light::LightTable,
    scene::{Closure, Instances, Material, Scene},
    transport::{Bodies, Body, MaterialTable},
};

/// More pairs of bodies and lights are not tested: lamps may then stand in any body.
const MOST_PAIRS: usize = 1 << 24;

/// Those of a scene whose geometry has bounds; `rows` are the sets that instances came from, their numbers there, and their geometry.
pub(super) fn of(
    scene: &Scene,
    mesh_bounds: &[Bounds],
    rows: impl Iterator<Item = (u32, u32, u32)>,
    (materials, lights): (&MaterialTable, &LightTable),
    origin: [f64; 3],
) -> Bodies {
    let filled: Vec<bool> = scene.materials.iter().map(absorbs).collect();
    let is_filled = |id: usize| filled.get(id) == Some(&true);
    let fill = |set: &Instances| Fill {
        absorbs: set.materials.iter().any(|id| is_filled(id.index())),
        refracts: is_one(set, materials, refracts),
    };
    let fills: Vec<Fill> = scene.instances.iter().map(fill).collect();
    if !fills.iter().any(|fill| fill.absorbs || fill.refracts) {
        return Bodies::default();
    }
    // Nothing stands in a hair.
    let strands = scene.meshes.len()..scene.meshes.len() + scene.curves.len();
    let body = |(instance, (set, number, mesh)): (usize, (u32, u32, u32))| {
        let is_strand = strands.contains(&(mesh as usize));
        let transform = scene.instances.get(set as usize)?.transforms.get(number as usize)?;
        let fill = fills.get(set as usize).filter(|fill| !is_strand && (fill.absorbs || fill.refracts))?;
        let bounds = mesh_bounds.get(mesh as usize)?.transformed(transform);
        let corner = |place: [f64; 3]| [0, 1, 2].map(|axis| (place[axis] - origin[axis]) as f32);
        Some((fill, Body { instance: instance as u32, bounds: [corner(bounds.min), corner(bounds.max)] }))
    };
    let bodies: Vec<(&Fill, Body)> = rows.enumerate().filter_map(body).collect();
    let that = |holds: fn(&Fill) -> bool| bodies.iter().filter(|(fill, _)| holds(fill)).map(|(_, body)| *body).collect::<Vec<_>>();
    let (absorbing, refracting) = (that(|fill| fill.absorbs), that(|fill| fill.refracts));
    let balls: Vec<([f32; 3], f32)> = (0..lights.len() as u32).filter_map(|light| lights.ball(light)).collect();
    let around_lights = match absorbing.len().saturating_mul(balls.len()) <= MOST_PAIRS {
        true => absorbing.iter().filter(|body| balls.iter().any(|ball| meets(body, ball))).copied().collect(),
        false => absorbing.clone(),
    };
    Bodies { absorbing, around_lights, refracting }
}

/// What the placements of a set are full of.
struct Fill {
    absorbs: bool,
    refracts: bool,
}

/// Whether light may be bent on its way into a mesh.
fn refracts(surface: &Surface) -> bool {
    surface.lobes.transmission && !surface.switches.thin_walled
}

/// Whether a material may absorb what goes through the meshes that it covers.
fn absorbs(material: &Material) -> bool {
    let is_filled = |closure: &Closure| !closure.solid.is_clear() || closure.input("transmission_depth").is_some();
    !material.medium.is_clear() || material.closures.iter().any(is_filled)
}

/// Whether a body's bounds meet the box about a ball.
fn meets(body: &Body, (centre, radius): &([f32; 3], f32)) -> bool {
    let [min, max] = body.bounds;
    (0..3).all(|axis| centre[axis] + radius >= min[axis] && centre[axis] - radius <= max[axis])
}
