//! How large what a picture shows is: how densely its pixels lie on surfaces.

use crate::{
    camera::sampler::{BATCH, TILE},
    compile::{CompiledScene, View},
    scene::Crop,
    transport::{LIGHT_BATCH, Start, Tracer},
};
use gonio_simd::{Lanes, One, Vec3};

/// Rays along each side of the picture.
const SIDE: usize = 64;
const _: () = assert!(SIDE * SIDE <= BATCH);

/// The area that as many pixels as a sample has light paths spread over, m², by the mean of their density; `otherwise` where nothing is seen.
///
/// It is across the view rather than along the surfaces, and mirrors count as if they were painted: a measure of how near the picture looks.
pub(super) fn area(scene: &CompiledScene, view: &View, otherwise: f64) -> f64 {
    let Crop { min, max } = view.window;
    let [columns, rows] = [0, 1].map(|axis| max[axis] - min[axis]);
    let mut places = [Vec::with_capacity(SIDE * SIDE), Vec::with_capacity(SIDE * SIDE)];
    for place in 0..SIDE * SIDE {
        let part = |at: usize, first: u32, pixels: u32| first as f32 + (at as f32 + 0.5) / SIDE as f32 * pixels as f32;
        places[0].push(part(place % SIDE, min[0], columns));
        places[1].push(part(place / SIDE, min[1], rows));
    }
    let slots: Vec<u32> = (0..(SIDE * SIDE) as u32).collect();
    let tracer = Tracer { tables: &scene.tables, start: Start::Camera(&view.camera, &view.placement), transport: view.transport.clone() };
    let mut workspace = scene.workspaces.take();
    workspace.prepare(&scene.tables, &tracer.transport, false);
    tracer.first_hits_at([&places[0], &places[1]], &slots, &mut workspace);
    let mut density = 0.0;
    let (slots, hits) = workspace.hits_by_slot();
    for (ray, slot) in slots.map(|slot| slot as usize).enumerate() {
        // Nothing, or a light, onto which no light path brings anything.
        if hits.instance[ray] < scene.tables.first_light_instance {
            density += pixels_per_area(view, [places[0][slot], places[1][slot]], hits.t[ray]);
        }
    }
    scene.workspaces.leave(workspace);
    let tiles = columns.div_ceil(TILE as u32) as usize * rows.div_ceil(TILE as u32) as usize;
    let area = (tiles * LIGHT_BATCH * SIDE * SIDE) as f64 / density;
    if area.is_finite() { area } else { otherwise }
}

/// Pixels a square metre across the ray through a place of the raster, some way off.
fn pixels_per_area(view: &View, raster: [f32; 2], way: f32) -> f64 {
    let ray = view.camera.ray(One, raster.map(|x| One.f(x)), [One.f(0.5); 2]);
    let Vec3 { x, y, z } = ray.direction.mul_add(One.f(way), ray.origin);
    view.camera.pixel_width([x.0, y.0, z.0]).map_or(0.0, |width| f64::from(width).powi(-2))
}
