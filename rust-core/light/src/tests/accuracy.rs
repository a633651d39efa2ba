//! The estimate of the illuminance against quadrature, for every kind of shape, many poses and shapings.

use super::harness::NO_IMAGES;
use super::harness::{draw, estimate, light, numbers, turned};
use super::shape::illuminance;
use crate::vector::{Vector, narrow, unit_or};
use crate::{LightKind, LightRecord, LightTable, Shaping, Spot};
use gonio_simd::Execution;

/// Two-sided 1 − 1e-6; the tests make some 600 comparisons.
const DEVIATIONS: f64 = 4.9;

/// Compares an estimate from `count` samples with quadrature on `grid`² elements whose own error is below `relative`.
fn check(name: &str, record: &LightRecord, p: Vector, n: Vector, count: usize, grid: usize, relative: f64) {
    let table = LightTable::build(std::slice::from_ref(record), NO_IMAGES, &[]);
    let expected = illuminance(record, p, n, grid);
    let drawn = draw(Execution::best(), &table, narrow(p), narrow(n), &numbers(7, count));
    let (mean, error) = estimate(&drawn, n, count);
    for k in 0..3 {
        let allowed = DEVIATIONS * error[k] + relative * expected[k].abs() + 1e-9;
        assert!(
            (mean[k] - expected[k]).abs() <= allowed,
            "{name}, channel {k}: {} ± {}, by quadrature {} ({:+.2} %)",
            mean[k],
            error[k],
            expected[k],
            100.0 * (mean[k] / expected[k] - 1.0)
        );
        // Shaping is not part of the sampling, so only plain lights promise little noise.
        let plain = record.shaping == Shaping::default() && record.spot.is_none() && record.spread >= std::f32::consts::PI;
        let noisy = error[k] > 0.02 * expected[k] + 1e-9 && plain;
        assert!(!noisy, "{name}, channel {k}: error {} of {} is large", error[k], expected[k]);
    }
}

/// Points on a surface below the light, near, far, oblique and behind it.
fn points() -> Vec<(&'static str, Vector, Vector)> {
    vec![
        ("below", [0.3, -0.2, -2.0], [0.0, 0.0, 1.0]),
        ("oblique", [3.0, 1.5, -0.7], unit_or([-0.8, -0.3, 0.5], [0.0; 3])),
        ("far", [40.0, -25.0, -120.0], unit_or([-0.3, 0.2, 1.0], [0.0; 3])),
        ("close", [0.2, 0.1, -0.35], [0.0, 0.0, 1.0]),
        ("sideways", [0.6, -4.0, -0.4], unit_or([0.1, 1.0, 0.3], [0.0; 3])),
        ("beside", [1.0, -0.6, -0.3], unit_or([-0.5, 0.3, 1.0], [0.0; 3])),
        ("behind", [0.2, 0.3, 3.0], [0.0, 0.0, -1.0]),
    ]
}

fn shapes() -> Vec<(&'static str, LightRecord)> {
    let square = turned([0.8, 0.5, 1.0], [0.0; 3]);
    let leaning = turned([0.9, 0.3, 2.0], [0.3, -0.2, 0.7]);
    let mirrored = turned([-0.6, 0.8, 0.5], [0.1, 0.3, -0.4]);
    let sheared = [[0.7, 0.2, 0.1], [0.4, 0.6, -0.1], [0.05, 0.1, 0.9]];
    let small = turned([0.2, 0.2, 0.2], [0.2, 0.1, 0.5]);
    let slender = turned([0.8, 0.1, 0.15], [0.1, 0.2, 0.3]);
    let mut all = Vec::new();
    for (kind, name) in [(LightKind::Rectangle, "rectangle"), (LightKind::Disk, "disk"), (LightKind::Triangle, "triangle")] {
        // The triangle emits to the side of x × y, +z: half the points see it.
        for axes in [square, leaning, mirrored, sheared] {
            all.push((name, light(kind, axes, [0.0; 3])));
        }
    }
    for axes in [small, turned([0.1, 0.3, 0.2], [0.3, -0.2, 0.7]), [[0.2, 0.05, 0.0], [0.1, 0.25, -0.05], [0.0, 0.1, 0.3]]] {
        all.push(("sphere", light(LightKind::Sphere, axes, [0.0; 3])));
    }
    for axes in [small, turned([0.25; 3], [0.3, -0.2, 0.7])] {
        all.push(("facing disk", light(LightKind::FacingDisk, axes, [0.0; 3])));
    }
    for axes in [slender, turned([-0.8, 0.12, 0.12], [0.0; 3]), [[0.7, 0.1, 0.1], [0.1, 0.2, -0.05], [0.0, 0.1, 0.15]]] {
        all.push(("cylinder", light(LightKind::Cylinder, axes, [0.0; 3])));
    }
    all
}

#[test]
fn illuminance_matches_quadrature() {
    for (shape, mut record) in shapes() {
        record.radiance = [3.0, 1.0, 0.5];
        for (place, p, n) in points() {
            check(&format!("{shape} {:?} {place}", record.to_world), &record, p, n, 1 << 16, 400, 3e-4);
        }
    }
}

#[test]
fn shaped_illuminance_matches_quadrature() {
    let hard = Shaping { cone_angle: 0.6, ..Shaping::default() };
    let soft = Shaping { cone_angle: 1.4, softness: 0.6, ..Shaping::default() };
    let wide = Shaping { cone_angle: std::f32::consts::PI, softness: 1.0, ..Shaping::default() };
    let focused = Shaping { focus: 7.0, focus_tint: [0.1, 0.4, 0.0], ..Shaping::default() };
    let both = Shaping { cone_angle: 2.2, softness: 0.3, focus: 1.5, focus_tint: [0.0, 0.0, 1.0] };
    for (shape, record) in shapes() {
        for shaping in [hard, soft, wide, focused, both] {
            let record = LightRecord { shaping, ..record };
            for (place, p, n) in points().into_iter().step_by(2) {
                // The hard edge costs the midpoint rule digits.
                check(&format!("{shape} {:?} {shaping:?} {place}", record.to_world), &record, p, n, 1 << 14, 300, 8e-3);
            }
        }
    }
}

#[test]
fn spots_match_quadrature() {
    let hard = Spot { angle: 1.0, blend: 0.0, stretch: [1.0; 2] };
    let soft = Spot { angle: 2.2, blend: 0.7, stretch: [1.0; 2] };
    let flat = Spot { angle: 0.9, blend: 1.0, stretch: [2.5, 0.8] };
    let back = Spot { angle: 4.5, blend: 0.4, stretch: [1.0, 0.6] };
    for (shape, record) in shapes() {
        for spot in [hard, soft, flat, back] {
            let record = LightRecord { spot: Some(spot), ..record };
            for (place, p, n) in points().into_iter().step_by(2) {
                // The hard edge costs the midpoint rule digits.
                check(&format!("{shape} {:?} {spot:?} {place}", record.to_world), &record, p, n, 1 << 14, 300, 8e-3);
            }
        }
    }
}

#[test]
fn spread_matches_quadrature() {
    for (shape, record) in shapes().into_iter().filter(|(_, record)| record.kind.is_flat()) {
        for degrees in [175.0f32, 120.0, 60.0, 20.0, 5.0] {
            let record = LightRecord { spread: degrees.to_radians(), ..record };
            for (place, p, n) in points() {
                let grid = if degrees < 10.0 { 1500 } else { 500 };
                check(&format!("{shape} {:?} {degrees} {place}", record.to_world), &record, p, n, 1 << 14, grid, 5e-3);
            }
        }
    }
}

#[test]
fn spread_keeps_the_flux_and_little_noise() {
    let n = [0.0, 0.0, 1.0];
    for (shape, axes) in [(LightKind::Rectangle, turned([5.0, 4.0, 1.0], [0.0; 3])), (LightKind::Disk, turned([5.0, 4.5, 1.0], [0.0; 3]))] {
        for degrees in [0.2f32, 1.0, 5.0, 15.0, 33.0, 60.0] {
            let record = LightRecord { spread: degrees.to_radians(), ..light(shape, axes, [0.0; 3]) };
            let table = LightTable::build(&[record], NO_IMAGES, &[]);
            // So near a large light the whole beam is seen, and it carries what an endless plane of the radiance would.
            let drawn = draw(Execution::best(), &table, [0.4, -0.7, -2.0], narrow(n), &numbers(37, 1 << 14));
            let (mean, error) = estimate(&drawn, n, 1 << 14);
            let expected = std::f64::consts::PI;
            assert!(
                (mean[1] - expected).abs() < DEVIATIONS * error[1] + 1e-3 * expected,
                "{shape:?} {degrees}: {} ± {}",
                mean[1],
                error[1]
            );
            assert!(error[1] < 0.01 * expected, "{shape:?} {degrees}: error {}", error[1]);
        }
    }
}

#[test]
fn distant_light_matches_the_projected_solid_angle() {
    for angle in [0.53f64, 10.0, 60.0, 179.0] {
        let mut record =
            LightRecord { angle: angle.to_radians() as f32, ..light(LightKind::Distant, turned([1.0; 3], [0.4, 0.1, 0.3]), [0.0; 3]) };
        record.radiance = [2.0, 1.0, 0.25];
        let n = record.to_world[2].map(f64::from);
        let table = LightTable::build(&[record], NO_IMAGES, &[]);
        let drawn = draw(Execution::best(), &table, [1.0, 2.0, 3.0], narrow(n), &numbers(3, 1 << 16));
        let (mean, error) = estimate(&drawn, n, 1 << 16);
        for k in 0..3 {
            let expected = f64::from(record.radiance[k]) * std::f64::consts::PI * (angle.to_radians() / 2.0).sin().powi(2);
            assert!(
                (mean[k] - expected).abs() <= DEVIATIONS * error[k] + 2e-5 * expected,
                "{angle}°: {} ± {} for {expected}",
                mean[k],
                error[k]
            );
        }
    }
}

#[test]
fn parallel_light_and_points_are_exact() {
    let distant = light(LightKind::Distant, turned([1.0; 3], [0.4, 0.1, 0.3]), [0.0; 3]);
    // Angles that directions cannot resolve count as parallel and keep their illuminance.
    let narrow_cone = LightRecord { angle: 1e-5, radiance: [1e6; 3], ..distant };
    let point = LightRecord { radiance: [5.0; 3], ..light(LightKind::Point, turned([1.0; 3], [0.0; 3]), [0.0, 0.0, 4.0]) };
    for (record, expected) in [(distant, 1.0), (narrow_cone, 1e6 * std::f64::consts::PI * 25e-12), (point, 5.0 / 16.0)] {
        let table = LightTable::build(&[record], NO_IMAGES, &[]);
        let n = if record.kind == LightKind::Point { [0.0, 0.0, 1.0] } else { record.to_world[2] };
        let drawn = draw(Execution::best(), &table, [0.0; 3], n, &numbers(3, 16));
        for i in 0..16 {
            let got = drawn.colour(i)[0] / f64::from(drawn.pdf[i]);
            assert!((got / expected - 1.0).abs() < 1e-5, "{:?}: {got} for {expected}", record.kind);
        }
    }
}
