mod displace;
mod graph;
mod luminaire;
mod quantity;

use super::{compile, openings};
use crate::{
    light::{LightSampleContext, LightTable},
    scene::{Goniogram, Light, LightShape, Mesh, Opening, OpeningShape, Origin, PhotometricType, Scene, Transform},
};
use gonio_simd::{Lanes, One, Vec3};
use std::sync::{Arc, atomic::AtomicBool};

/// Uniform numbers in [0, 1): a counter through a 64-bit mixer (SplitMix64).
fn uniform(index: u64) -> f64 {
    let mut z = index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A light at a place that is turned and mirrored, so that no axis is left where it was.
fn placed(shape: LightShape, goniogram: Option<Arc<Goniogram>>) -> Light {
    let transform = Transform { columns: [[0.0, 0.6, 0.8], [1.0, 0.0, 0.0], [0.0, -0.8, 0.6], [0.3, -0.2, 0.5]] };
    Light { goniogram, ..Light::new(Origin::new("luminaire"), shape, transform) }
}

/// The light table of one light, and what was said of it.
fn table(light: Light) -> (Arc<LightTable>, Vec<String>) {
    let mut scene = Scene::default();
    scene.add_mesh(Mesh::default());
    scene.lights.push(light);
    let compiled = compile(&scene, None, &AtomicBool::new(false)).expect("the scene compiles");
    (compiled.tables.lights.clone(), compiled.diagnostics.iter().map(|d| d.message.clone()).collect())
}

/// Mean of the illuminance at a point that looks along `n`, and its standard error, from samples in strata.
fn illuminance(table: &LightTable, p: [f64; 3], n: [f64; 3], side: u64) -> [f64; 2] {
    let l = One;
    let splat = |v: [f64; 3]| Vec3::splat(l, v.map(|x| x as f32));
    let (mut sum, mut squares) = (0.0, 0.0);
    let count = side * side;
    // Numbers of the point's own, so that the errors of many points even out.
    let seed = p.iter().fold(0_u64, |seed, x| seed.rotate_left(21) ^ x.to_bits());
    for i in 0..count {
        let draw = |k: u64| uniform(seed.wrapping_add(3 * i + k));
        let u = [((i / side) as f64 + draw(1)) / side as f64, ((i % side) as f64 + draw(2)) / side as f64].map(|x| l.f(x as f32));
        let from = LightSampleContext { position: splat(p), normal: splat(n), receiver: l.u(0) };
        let s = table.sample_li(l, None, &from, l.f(draw(0) as f32), &u);
        let (pdf, luminance) = (s.pdf.to_array()[0], s.radiance.luminance().to_array()[0]);
        let cosine = s.wi.dot(splat(n)).to_array()[0];
        let value = if pdf > 0.0 { f64::from(luminance * cosine.max(0.0)) / f64::from(pdf) } else { 0.0 };
        sum += value;
        squares += value * value;
    }
    let m = count as f64;
    let mean = sum / m;
    [mean, ((squares / m - mean * mean).max(0.0) / m).sqrt()]
}

/// A goniogram of type C with values of its own at every knot, up to a polar angle.
fn goniogram(last_deg: f32) -> Arc<Goniogram> {
    let horizontal_deg: Vec<f32> = (0..=12).map(|k| 30.0 * k as f32).collect();
    let vertical_deg: Vec<f32> = (0..=12).map(|k| last_deg * k as f32 / 12.0).collect();
    let mut factors: Vec<f32> = Vec::new();
    for h in 0..13_u64 {
        // The circle closes, and the poles have one value.
        let plane = h % 12;
        factors.extend((0..13_u64).map(|v| if v % 12 == 0 { 300.0 } else { 100.0 + 400.0 * uniform(100 * plane + v) as f32 }));
    }
    Arc::new(Goniogram { photometric_type: PhotometricType::C, horizontal_deg, vertical_deg, factors, ..Goniogram::default() })
}

/// One of each form.
fn openings_of_all_forms() -> Vec<Opening> {
    use OpeningShape::*;
    let mut all: Vec<Opening> = [
        (Point, [0.0; 3]),
        (Rectangle, [1.2, 0.3, 0.0]),
        (Rectangle, [1.2, 0.0, 0.0]),
        (Box, [0.6, 0.4, 0.2]),
        (Box, [0.0, 0.4, 0.3]),
        (Disk, [0.4, 0.4, 0.0]),
        (Disk, [0.4, 0.2, 0.0]),
        (VerticalCylinder, [0.3, 0.2, 0.5]),
        (CylinderAlongX, [1.2, 0.1, 0.1]),
        (CylinderAlongY, [0.1, 1.2, 0.2]),
        (Ellipsoid, [0.3, 0.3, 0.3]),
        (Ellipsoid, [0.5, 0.2, 0.3]),
        (DiskFacingX, [0.0, 0.3, 0.4]),
        (DiskFacingY, [0.3, 0.0, 0.3]),
    ]
    .map(|(shape, size)| Opening::new(shape, size))
    .into();
    all.push(Opening { shape: Box, size: [0.6, 0.4, 0.2], heights: [0.2, 0.1, 0.05, 0.15] });
    all
}
