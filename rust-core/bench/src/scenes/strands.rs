//! A head of hair: a ball with strands that fall, lit by one lamp.

use super::{
    build::{aimed, layered, light, look, place},
    shapes::superellipsoid,
};
use crate::numbers::Random;
use gonio::scene::{
    CurveBasis, CurveShape, CurveWrap, Curves, Geometry, Instances, LightShape, Origin, Primvar, PrimvarInterpolation, Scene, Transform,
};
use std::f32::consts::TAU;

const STRANDS: usize = 20_000;
/// Straight pieces of a strand.
const PIECES: usize = 10;
/// Metres.
const HEAD: f32 = 0.1;
const LENGTH: f32 = 0.05;

/// 200 thousand round pieces, twenty times as thick as hair so that the picture's rays meet them.
pub(crate) fn strands() -> Scene {
    let mut scene = Scene::default();
    let skin = layered([0.6, 0.45, 0.35], &[]);
    place(&mut scene, superellipsoid(48, 40, [HEAD; 3], [1.0; 2]), skin, Transform::IDENTITY);
    let (mut random, mut points) = (Random(3), Vec::with_capacity(STRANDS * (PIECES + 1)));
    for _ in 0..STRANDS {
        points.extend(strand(&mut random));
    }
    let widths = Primvar {
        name: "widths".into(),
        interpolation: PrimvarInterpolation::Constant,
        components: 1,
        values: [2e-4].into(),
        indices: None,
    };
    let curves = Curves {
        origin: Origin::new("bench"),
        points: points.into(),
        counts: vec![PIECES as u32 + 1; STRANDS].into(),
        basis: CurveBasis::Linear,
        wrap: CurveWrap::Nonperiodic,
        shape: CurveShape::Round,
        widths,
        ..Curves::default()
    };
    let curves = Geometry::Curves { curves: scene.add_curves(curves) };
    let material = scene.add_material(layered([0.2, 0.1, 0.05], &[]));
    scene.instances.push(Instances::new(Origin::new("bench"), curves, vec![material], vec![Transform::IDENTITY]));
    scene.lights.push(light(LightShape::Rectangle { width: 0.4, height: 0.4 }, 100.0, aimed([0.3, 0.5, 0.4], [0.0; 3])));
    look(&mut scene, [0.0, 0.05, 0.5], [0.0; 3], 32.0);
    scene
}

/// Points of a strand from the ball on.
fn strand(random: &mut Random) -> [[f32; 3]; PIECES + 1] {
    let mut direction = || {
        let (turn, z) = (TAU * random.unit(), 2.0 * random.unit() - 1.0);
        let ring = (1.0 - z * z).max(0.0).sqrt();
        [ring * turn.cos(), z, ring * turn.sin()]
    };
    let (root, wave) = (direction(), direction());
    let (mut at, mut way) = (root.map(|x| HEAD * x), root);
    let mut points = [at; PIECES + 1];
    for point in &mut points[1..] {
        way = [way[0] + 0.1 * wave[0], way[1] + 0.1 * wave[1] - 0.2, way[2] + 0.1 * wave[2]];
        let length = way.iter().map(|x| x * x).sum::<f32>().sqrt();
        way = way.map(|x| x / length);
        at = [0, 1, 2].map(|k| at[k] + way[k] * LENGTH / PIECES as f32);
        *point = at;
    }
    points
}
