//! Placed meshes that absorb inside, and which of them lamps may stand in.

use super::bounds::Bounds;
use crate::{
    light::LightTable,
    scene::{Material, Scene},
    transport::{Bodies, Body},
};

/// More pairs of bodies and lights are not tested: lamps may then stand in any body.
const MOST_PAIRS: usize = 1 << 24;

/// Those of a scene whose geometry has bounds; `rows` are the sets that instances came from, their numbers there, and their geometry.
pub(super) fn of(
    scene: &Scene,
    mesh_bounds: &[Bounds],
    rows: impl Iterator<Item = (u32, u32, u32)>,
    lights: &LightTable,
    origin: [f64; 3],
) -> Bodies {
    let filled: Vec<bool> = scene.materials.iter().map(absorbs).collect();
    if !filled.contains(&true) {
        return Bodies::default();
    }
    let is_filled = |id: usize| filled.get(id) == Some(&true);
    let holds: Vec<bool> = scene.instances.iter().map(|set| set.materials.iter().any(|id| is_filled(id.index()))).collect();
    // Nothing stands in a hair.
    let strands = scene.meshes.len()..scene.meshes.len() + scene.curves.len();
    let body = |(instance, (set, number, mesh)): (usize, (u32, u32, u32))| {
        let is_strand = strands.contains(&(mesh as usize));
        let transform = scene.instances.get(set as usize)?.transforms.get(number as usize)?;
        let holds = !is_strand && holds.get(set as usize) == Some(&true);
        let bounds = holds.then(|| mesh_bounds.get(mesh as usize))??.transformed(transform);
        let corner = |place: [f64; 3]| [0, 1, 2].map(|axis| (place[axis] - origin[axis]) as f32);
        Some(Body { instance: instance as u32, bounds: [corner(bounds.min), corner(bounds.max)] })
    };
    let all: Vec<Body> = rows.enumerate().filter_map(body).collect();
    let balls: Vec<([f32; 3], f32)> = (0..lights.len() as u32).filter_map(|light| lights.ball(light)).collect();
    let around_lights = match all.len().saturating_mul(balls.len()) <= MOST_PAIRS {
        true => all.iter().filter(|body| balls.iter().any(|ball| meets(body, ball))).copied().collect(),
        false => all.clone(),
    };
    Bodies { all, around_lights }
}

/// Whether a material may absorb what goes through the meshes that it covers.
fn absorbs(material: &Material) -> bool {
    material.absorption.iter().any(|x| *x > 0.0) || material.closures.iter().any(|closure| closure.input("transmission_depth").is_some())
}

/// Whether a body's bounds meet the box about a ball.
fn meets(body: &Body, (centre, radius): &([f32; 3], f32)) -> bool {
    let [min, max] = body.bounds;
    (0..3).all(|axis| centre[axis] + radius >= min[axis] && centre[axis] - radius <= max[axis])
}
