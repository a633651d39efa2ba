//! Light paths bring to a surface what light sampling finds there.

use super::cases::{Case, finite, infinite, table};
use super::harness::{mean, shoot, triple};
use crate::tests::harness::{draw, estimate, light, numbers, turned};
use crate::vector::{add, cross, dot, scale, unit_or, widen};
use crate::{EmissionSampler, LightKind, LightRecord, LightTable};
use gonio_simd::Execution;

/// A square: its middle, unit normal, and half its side.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) middle: [f32; 3],
    pub(super) normal: [f32; 3],
    pub(super) half: f32,
}

impl Plane {
    fn axes(&self) -> [[f64; 3]; 3] {
        let n = unit_or(widen(self.normal), [0.0, 0.0, 1.0]);
        let x = unit_or(cross(n, if n[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }), [0.0; 3]);
        [x, cross(n, x), n]
    }
    /// The sphere around it.
    pub(super) fn sphere(&self) -> ([f32; 3], f32) {
        (self.middle, self.half * std::f32::consts::SQRT_2)
    }
    /// Mean illuminance and its standard error, by light sampling at places all over the square.
    pub(super) fn by_light_sampling(&self, table: &LightTable, side: usize, samples: usize) -> [f64; 2] {
        let [x, y, n] = self.axes();
        let half = f64::from(self.half);
        let (mut sum, mut variance) = (0.0, 0.0);
        for i in 0..side * side {
            let at = |k: usize| ((k as f64 + 0.5) / side as f64 * 2.0 - 1.0) * half;
            let p = add(widen(self.middle), add(scale(x, at(i / side)), scale(y, at(i % side))));
            let drawn = draw(Execution::best(), table, p.map(|x| x as f32), n.map(|x| x as f32), &numbers(100 + i as u64, samples));
            let (found, error) = estimate(&drawn, n, samples);
            sum += found[1];
            variance += error[1] * error[1];
        }
        let count = (side * side) as f64;
        [sum / count, variance.sqrt() / count]
    }
    /// The same by light paths.
    pub(super) fn by_paths(&self, table: &LightTable, sampler: &EmissionSampler, seed: u64, count: usize) -> [f64; 2] {
        let [x, y, n] = self.axes();
        let half = f64::from(self.half);
        let rays = shoot(Execution::best(), sampler, table, seed, count);
        let area = 4.0 * half * half;
        let arrives = |i: usize| {
            let (o, w) = (triple(&rays.origin, i), triple(&rays.direction, i));
            let from = add(o, scale(widen(self.middle), -1.0));
            let descent = -dot(w, n);
            let way = dot(from, n) / descent;
            let hit = add(from, scale(w, way));
            let met = descent > 0.0 && way > 0.0 && way >= f64::from(rays.clear[i]) && dot(hit, x).abs() < half && dot(hit, y).abs() < half;
            if met { f64::from(rays.flux[1][i]) / area } else { 0.0 }
        };
        mean((0..count).map(arrives), count)
    }
}

const PLANES: [Plane; 3] = [
    Plane { middle: [0.3, 0.2, 0.9], normal: [0.0, 0.0, 1.0], half: 0.4 },
    Plane { middle: [1.5, -0.4, 1.6], normal: [-1.0, 0.3, 0.2], half: 0.3 },
    Plane { middle: [0.1, 0.3, 3.4], normal: [0.1, 0.2, -1.0], half: 0.5 },
];

fn compare(case: &Case, scene: ([f32; 3], f32)) {
    let records = [LightRecord { visible_to_camera: true, ..case.record }];
    let table = table(&records);
    let whole = EmissionSampler::new(&table, None, scene, &[]).power(0)[1];
    for plane in PLANES {
        let [expected, spread] = plane.by_light_sampling(&table, 12, 256);
        for (targets, count) in [(vec![], 1 << 16), (vec![plane.sphere(), ([0.0, 0.0, 9.0], 0.3)], 1 << 15)] {
            let sampler = EmissionSampler::new(&table, None, scene, &targets);
            // Of a beam's faint rim too few rays tell anything.
            let share = expected * 4.0 * f64::from(plane.half).powi(2) / whole;
            if share < 1e-4 || share * (count as f64) < 50.0 && targets.is_empty() {
                continue;
            }
            let [found, error] = plane.by_paths(&table, &sampler, 3, count);
            let allowed = 4.0 * error.hypot(spread) + 4e-3 * expected;
            assert!(
                (found - expected).abs() < allowed,
                "{} at {:?}, {} targets: {found} ± {error} for {expected} ± {spread}",
                case.name,
                plane.middle,
                targets.len()
            );
        }
    }
}

#[test]
fn finite_lights_bring_by_paths_what_they_bring_by_light_sampling() {
    // A thin beam's spot of light is smaller than the grid of light sampling.
    for case in finite().into_iter().filter(|case| case.name != "thin spot") {
        compare(&case, ([0.0; 3], 5.0));
    }
}

#[test]
fn infinite_lights_bring_by_paths_what_they_bring_by_light_sampling() {
    for case in infinite() {
        compare(&case, ([0.5, 0.0, 2.0], 3.0));
    }
}

#[test]
fn lights_of_all_kinds_together_bring_the_same() {
    let skies = infinite().into_iter().map(|case| LightRecord { radiance: case.record.radiance.map(|x| 0.02 * x), ..case.record });
    let places = finite().into_iter().filter(|case| case.name != "thin spot").map(|case| case.record);
    let records: Vec<LightRecord> = places.chain(skies).collect();
    let table = table(&records);
    for plane in PLANES {
        let [expected, spread] = plane.by_light_sampling(&table, 12, 1024);
        for targets in [vec![], vec![plane.sphere(), ([0.0, 0.0, 9.0], 0.3)]] {
            let sampler = EmissionSampler::new(&table, None, ([0.5, 0.0, 2.0], 3.0), &targets);
            let [found, error] = plane.by_paths(&table, &sampler, 3, 1 << 18);
            let allowed = 4.0 * error.hypot(spread) + 2e-3 * expected;
            assert!((found - expected).abs() < allowed, "{}: {found} ± {error} for {expected} ± {spread}", targets.len());
        }
    }
}

#[test]
fn triangles_of_a_mesh_with_a_beam_are_tabulated_coarsely_and_lose_nothing() {
    // More looks than are tabulated finely.
    let triangle = |i: usize| {
        let axes = turned([0.3, 0.3, 1.0], [0.02 * i as f32, 0.013 * i as f32, 0.0]);
        let record = light(LightKind::Triangle, [axes[1], axes[0], [0.0, 0.0, 1.0]], [0.01 * i as f32 - 0.5, 0.1, 2.0]);
        LightRecord { goniogram: Some(0), ..record }
    };
    let records: Vec<LightRecord> = (0..100).map(triangle).collect();
    let table = table(&records);
    let plane = Plane { middle: [0.1, 0.2, 0.5], normal: [0.0, 0.0, 1.0], half: 0.8 };
    let [expected, spread] = plane.by_light_sampling(&table, 12, 1024);
    let sampler = EmissionSampler::new(&table, None, ([0.0; 3], 5.0), &[]);
    let [found, error] = plane.by_paths(&table, &sampler, 3, 1 << 17);
    assert!((found - expected).abs() < 4.0 * error.hypot(spread) + 2e-3 * expected, "{found} ± {error} for {expected} ± {spread}");
    let fine = EmissionSampler::new(&table, Some(&[99]), ([0.0; 3], 5.0), &[]).power(99)[1];
    let coarse = sampler.power(99)[1];
    assert!((coarse / fine - 1.0).abs() < 0.05, "{coarse} for {fine}");
}
