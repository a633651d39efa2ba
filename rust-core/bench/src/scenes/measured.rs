//! The room with one material on everything: an anisotropic table, or the GGX surface that it was made from.

use super::room;
use gonio::scene::{Closure, Distribution, Material, MeasuredBsdf, Model, Origin, Scene};
use gonio_formats::bsdf::{Axis, Channels, Coordinates, Direction, Hemispheres, Layout, Measured, Mode, Table};
use std::f64::consts::{PI, TAU};

/// Values along θi, φi, θo and φo: the anisotropic table whose lookup the paper on table lookups in four lanes measured.
const SIZE: [usize; 4] = [17, 7, 17, 13];
/// Roughness r.
const ROUGHNESS: f32 = 0.5;

/// GGX with height-correlated shadowing and Fresnel 1, 1/sr.
fn ggx(wi: Direction, wo: Direction) -> f64 {
    let alpha = f64::from(ROUGHNESS * ROUGHNESS);
    let sum = [wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]];
    let squared = sum.iter().map(|x| x * x).sum::<f64>();
    let slope = (sum[0].powi(2) + sum[1].powi(2)) / (squared * alpha * alpha) + sum[2].powi(2) / squared;
    let stretch = |d: Direction| (alpha * alpha * (1.0 - d[2] * d[2]) + d[2] * d[2]).sqrt();
    0.5 / (PI * alpha * alpha * slope * slope * (stretch(wi) * wo[2] + stretch(wo) * wi[2]))
}

/// The paper's table on uneven polar angles.
pub(crate) fn table() -> Option<Measured> {
    let polar = |count: usize| {
        let angle = |i: usize| 1.45 * (i as f64 / (count - 1) as f64).powf(0.8);
        Axis::new((0..count).map(angle).collect(), Mode::Linear).ok()
    };
    let turn = |count: usize| Axis::uniform(0.0, TAU * (count - 1) as f64 / count as f64, count, Mode::Periodic { period: TAU }).ok();
    let layout = Layout {
        coordinates: Coordinates::Anisotropic,
        axes: vec![polar(SIZE[0])?, turn(SIZE[1])?, polar(SIZE[2])?, turn(SIZE[3])?],
        channels: Channels::Rgb,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal: false,
        bilateral: false,
    };
    let fill = |wi: Direction, wo: Direction, out: &mut [f32]| out.fill(ggx(wi, wo) as f32);
    Table::from_function(layout, fill).ok().map(|table| Measured::Tables(vec![table]))
}

/// The room all in that table.
pub(crate) fn measured_room() -> Scene {
    let mut scene = room();
    let measured = table().map(|data| scene.add_measured(MeasuredBsdf::new(Origin::new("the paper's table"), data)));
    cover(&mut scene, &Closure { model: Model::Measured, measured, ..Closure::default() });
    scene
}

/// The room all in GGX.
pub(crate) fn glossy_room() -> Scene {
    let mut scene = room();
    cover(&mut scene, &Closure { model: Model::Glossy, distribution: Distribution::Ggx, ..Closure::default() });
    scene
}

fn cover(scene: &mut Scene, closure: &Closure) {
    for material in &mut scene.materials {
        let mut closure = closure.clone();
        closure.set_colour("base_color", [0.7; 3]);
        closure.set("specular_roughness", ROUGHNESS);
        *material = Material::of(Origin::new("bench"), closure);
    }
}
