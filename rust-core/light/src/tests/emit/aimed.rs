//! Aimed light paths: most of them arrive, and many targets are as good as few.

use super::cases::{AT, table};
use super::harness::{shoot, triple};
use super::planes::Plane;
use crate::tests::harness::{light, turned, uniform};
use crate::vector::{add, dot, scale, widen};
use crate::{EmissionSampler, LightKind, LightRecord};
use gonio_simd::Execution;

const SCENE: ([f32; 3], f32) = ([0.0; 3], 8.0);

fn lamps() -> Vec<LightRecord> {
    let kinds = [LightKind::Rectangle, LightKind::Disk, LightKind::Sphere, LightKind::Cylinder, LightKind::Point, LightKind::FacingDisk];
    let mut all: Vec<LightRecord> = kinds.iter().map(|kind| light(*kind, turned([0.2; 3], [0.0; 3]), AT)).collect();
    all.push(LightRecord { angle: 0.01, ..light(LightKind::Distant, turned([1.0; 3], [0.0; 3]), [0.0; 3]) });
    all.push(light(LightKind::Dome, turned([1.0; 3], [0.0; 3]), [0.0; 3]));
    all
}

/// Whether a ray meets a sphere.
fn meets(origin: [f64; 3], direction: [f64; 3], (centre, radius): ([f32; 3], f32)) -> bool {
    let to = add(widen(centre), scale(origin, -1.0));
    let along = dot(to, direction);
    along > 0.0 && dot(to, to) - along * along <= f64::from(radius).powi(2) * 1.001
}

#[test]
fn half_of_the_paths_meet_a_target() {
    let target = ([0.3f32, 0.4, -1.0], 0.05f32);
    for record in lamps() {
        let table = table(&[record]);
        let sampler = EmissionSampler::new(&table, None, SCENE, &[target]);
        let rays = shoot(Execution::best(), &sampler, &table, 4, 4096);
        let met =
            (0..4096).filter(|i| rays.flux[1][*i] > 0.0 && meets(triple(&rays.origin, *i), triple(&rays.direction, *i), target)).count();
        // Near the rim of what faces the target, a little shows its back.
        assert!(met > 1800, "{:?}: {met} of 4096", record.kind);
    }
}

#[test]
fn lamps_inside_a_target_waste_nothing() {
    for record in lamps().into_iter().filter(|record| matches!(record.kind, LightKind::Sphere | LightKind::Cylinder | LightKind::Point)) {
        let table = table(&[record]);
        let sampler = EmissionSampler::new(&table, None, SCENE, &[(AT, 1.0)]);
        let rays = shoot(Execution::best(), &sampler, &table, 4, 4096);
        let lit = rays.flux[1].iter().filter(|x| **x > 0.0).count();
        assert!(lit > 4080, "{:?}: {lit}", record.kind);
    }
}

#[test]
fn many_targets_are_kept_in_few_spheres() {
    let random = |i: usize, k: u64| uniform(3, 8 * i as u64 + k);
    let plane = Plane { middle: [0.3, 0.4, -1.0], normal: [0.0, 0.0, 1.0], half: 0.2 };
    let mut targets: Vec<([f32; 3], f32)> =
        (0..500).map(|i| ([4.0 * random(i, 0) - 2.0, 4.0 * random(i, 1) - 2.0, -1.0 - random(i, 2)], 0.01 + 0.02 * random(i, 3))).collect();
    targets.extend([plane.sphere(), ([f32::NAN; 3], 1.0), ([0.0; 3], 0.0), ([0.0; 3], f32::INFINITY)]);
    for record in lamps() {
        let table = table(&[record]);
        let sampler = EmissionSampler::new(&table, None, SCENE, &targets);
        let [expected, spread] = plane.by_light_sampling(&table, 8, 256);
        let [found, error] = plane.by_paths(&table, &sampler, 3, 1 << 17);
        assert!(
            (found - expected).abs() < 4.0 * error.hypot(spread) + 3e-3 * expected,
            "{:?}: {found} ± {error} for {expected}",
            record.kind
        );
    }
}
