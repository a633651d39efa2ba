//! Colours, size factors, odd lights and odd places.

use super::harness::{NO_IMAGES, draw, eval_hit, light, numbers, seeing_all, turned};
use super::shape::element;
use crate::vector::length;
use crate::{LightKind, LightRecord, LightTable, LightTexture, Shaping, Spot, blackbody_rgb, size_factor};
use gonio_simd::{Execution, Lanes, One, Vec3};
use std::f64::consts::PI;

#[test]
fn blackbody_is_usdlux() {
    // `UsdLux.BlackbodyTemperatureAsRgb` of usd-core 26.11.
    let known = [
        (1000.0, [4.3055043, 0.11835831, 0.0]),
        (1250.0, [3.6882439, 0.3020331, 0.0]),
        (2700.0, [1.9353238, 0.80356574, 0.19168955]),
        (4000.0, [1.4140282, 0.92403907, 0.5333078]),
        (6500.0, [1.0433334, 0.98362446, 1.0346133]),
        (6750.0, [1.0240439, 0.9856011, 1.0718325]),
        (10000.0, [0.8718413, 0.9946879, 1.4299959]),
        (20000.0, [0.8718413, 0.9946879, 1.4299959]),
    ];
    for (kelvin, expected) in known {
        let got = blackbody_rgb(kelvin);
        for k in 0..3 {
            assert!((got[k] - expected[k]).abs() <= 5e-4 * expected[k].max(0.1), "{kelvin} K: {got:?} for {expected:?}");
        }
    }
    assert!(blackbody_rgb(f32::NAN).iter().all(|x| x.is_finite()));
}

fn area_by_quadrature(record: &LightRecord) -> f64 {
    let count = 800;
    let sum: f64 = (0..count * count)
        .map(|i| length(element(record, ((i / count) as f64 + 0.5) / count as f64, ((i % count) as f64 + 0.5) / count as f64).1))
        .sum();
    sum / (count * count) as f64
}

#[test]
fn size_factors_are_areas() {
    let axes =
        [turned([0.8, 0.5, 1.3], [0.3, 0.2, 0.5]), [[0.7, 0.2, 0.1], [0.4, 0.6, -0.1], [0.05, 0.1, 0.9]], turned([2.0; 3], [0.0; 3])];
    for axes in axes {
        for (kind, tolerance) in [
            (LightKind::Rectangle, 1e-6),
            (LightKind::Disk, 1e-6),
            (LightKind::Triangle, 1e-6),
            (LightKind::Cylinder, 1e-5),
            // Thomsen's formula itself is up to 1.42 % off.
            (LightKind::Sphere, 0.0143),
        ] {
            let got = size_factor(kind, axes.map(|a| a.map(f64::from)), 0.0);
            let expected = area_by_quadrature(&light(kind, axes, [0.0; 3]));
            assert!((got / expected - 1.0).abs() < tolerance, "{kind:?} {axes:?}: {got} for {expected}");
        }
    }
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let distant = |degrees: f64| size_factor(LightKind::Distant, unit, degrees.to_radians());
    assert_eq!(distant(0.0), 1.0);
    assert!((distant(180.0) - PI).abs() < 1e-12 && (distant(360.0) - 2.0 * PI).abs() < 1e-12 && (distant(60.0) - PI / 4.0).abs() < 1e-12);
    assert_eq!(size_factor(LightKind::Dome, unit, 0.0), 1.0);
    let flat = |z: f64| size_factor(LightKind::Cylinder, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, z]], 0.0);
    assert!((flat(0.0) - 8.0).abs() < 1e-12 && (flat(1.0) - 4.0 * PI).abs() < 1e-12);
}

#[test]
fn odd_lights_and_odd_places_stay_finite() {
    let kinds = LightKind::ALL;
    let axes = [
        turned([1.0; 3], [0.0; 3]),
        turned([1e-4, 1e-4, 1e-4], [0.1, 0.2, 0.3]),
        turned([1e4, 1e4, 1e4], [0.1, 0.2, 0.3]),
        turned([0.0, 1.0, 1.0], [0.0; 3]),
        turned([1.0, 1.0, 0.0], [0.0; 3]),
        [[0.0; 3]; 3],
        [[f32::NAN; 3]; 3],
        turned([1.0, 1e-5, 1e3], [0.3, 0.2, 0.1]),
    ];
    let places = [
        [0.0; 3],
        [0.0, 0.0, -1.0],
        [1.0, 0.0, 0.0],
        [0.0, 0.0, 1e6],
        [1e-6, 0.0, -1e-6],
        [0.5, 0.5, 0.0],
        [0.0, -1e-20, -1e-20],
        [3e7, 1e8, -2e7],
    ];
    let mut u = numbers(41, 256);
    for (k, edge) in [0.0, 1.0 - f32::EPSILON / 2.0, 0.5].into_iter().enumerate() {
        for column in &mut u {
            column[k] = edge;
        }
    }
    for kind in kinds {
        for axes in axes {
            for shaping in [Shaping::default(), Shaping { cone_angle: 0.0, softness: 1.0, focus: 100.0, focus_tint: [0.0; 3] }] {
                let narrowed = shaping != Shaping::default();
                let spot = narrowed.then_some(Spot { angle: 0.0, blend: 0.0, stretch: [0.0, f32::NAN] });
                let spread = if narrowed { 0.0 } else { 3.0 };
                let record = LightRecord { shaping, spot, spread, angle: 0.01, ..light(kind, axes, [0.0; 3]) };
                let table =
                    LightTable::build(&[record, light(LightKind::Point, turned([1.0; 3], [0.0; 3]), [0.0, 0.0, -5.0])], NO_IMAGES, &[]);
                for p in places {
                    for n in [[0.0, 0.0, 1.0], [0.0; 3]] {
                        let drawn = draw(Execution::best(), &table, p, n, &u);
                        for i in 0..u[0].len() {
                            let values =
                                [drawn.pdf[i], drawn.distance[i], drawn.eval_pdf[i], drawn.radiance[0][i], drawn.eval_radiance[0][i]];
                            let fine = values.iter().all(|x| x.is_finite() && *x >= 0.0) && (length(drawn.direction(i)) - 1.0).abs() < 1e-4;
                            assert!(fine, "{kind:?} {axes:?} from {p:?}: {values:?}, wi {:?}", drawn.direction(i));
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn an_empty_table_sends_nothing() {
    let table = LightTable::build(&[], NO_IMAGES, &[]);
    let drawn = draw(Execution::best(), &table, [0.0; 3], [0.0, 0.0, 1.0], &numbers(1, 16));
    assert!(drawn.pdf.iter().all(|p| *p == 0.0));
}

#[test]
fn rectangle_images_are_upright_for_what_they_light() {
    let texture = LightTexture { width: 2, height: 2, rgb: vec![1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 4.0, 4.0, 4.0] };
    let record = LightRecord { texture: Some(0), ..light(LightKind::Rectangle, turned([1.0; 3], [0.0; 3]), [0.0; 3]) };
    let table = LightTable::build(&[record], &[texture], &[]);
    #[inline(always)]
    fn look<L: Lanes>(l: L, table: &LightTable, hit: [f32; 3]) -> f32 {
        let (from, hit) = (Vec3::splat(l, [0.0, 0.0, -2.0]), Vec3::splat(l, hit));
        let wi = (hit - from).normalize();
        let from = seeing_all(l, [from, Vec3::splat(l, [0.0, 0.0, 1.0])]);
        eval_hit(l, table, None, &from, l.u(0), [wi, hit], l.m(true)).0.r.to_array()[0]
    }
    let mut expected = 1.0;
    for hit in [[0.9, 0.9, 0.0], [-0.9, 0.9, 0.0], [0.9, -0.9, 0.0], [-0.9, -0.9, 0.0]] {
        let seen = look(One, &table, hit);
        assert!((seen - expected).abs() < 1e-5, "{hit:?}: {seen} for {expected}");
        expected += 1.0;
    }
    // What the samples carry is what the hits carry.
    let drawn = draw(Execution::best(), &table, [0.2, 0.3, -1.0], [0.0, 0.0, 1.0], &numbers(3, 4096));
    for i in 0..4096 {
        assert!(
            (drawn.radiance[0][i] - drawn.eval_radiance[0][i]).abs() < 1e-4,
            "{} and {}",
            drawn.radiance[0][i],
            drawn.eval_radiance[0][i]
        );
    }
}

#[test]
fn rays_to_triangles_tell_where_they_end() {
    let triangle = LightRecord {
        to_world: [[2.0, 0.5, 0.0], [-0.3, 1.0, 0.2], [0.0, 0.0, -1.0], [0.7, -1.0, 3.0]],
        radiance: [5.0; 3],
        two_sided: true,
        shaded: true,
        ..LightRecord::new(LightKind::Triangle)
    };
    let table = LightTable::build(&[LightRecord::new(LightKind::Sphere), triangle], NO_IMAGES, &[]);
    let l = One;
    assert!(!table.is_shaded(l, l.u(0)).any() && table.is_shaded(l, l.u(1)).all());
    for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.2, 0.7), (0.4, 0.1)] {
        let place = [0, 1, 2].map(|k| triangle.to_world[3][k] + u * triangle.to_world[0][k] + v * triangle.to_world[1][k]);
        let from = [1.0, 4.0, -2.0];
        let way = [0, 1, 2].map(|k| (place[k] - from[k]) / 3.0);
        let point = table.triangle_point(l, l.u(1), Vec3::splat(l, from), Vec3::splat(l, way));
        let found = [point.barycentric[0], point.barycentric[1], point.distance, point.mean].map(|x| x.to_array()[0]);
        for (found, right) in found.into_iter().zip([u, v, 3.0, 5.0]) {
            assert!((found - right).abs() < 1e-5, "{found} {right}");
        }
    }
}
