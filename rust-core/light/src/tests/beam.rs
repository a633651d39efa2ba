//! Spots, spreads and radii as Cycles has them. The figures were measured with the Cycles of Blender 5.0.1: a white Lambertian floor one metre below the
//! light, seen from above without bounces, pixels at x = (k + ½) / 4 m; they are the floor's radiance for an intensity of π W/sr on the axis.

use super::harness::NO_IMAGES;
use super::harness::{draw, estimate, light, numbers, turned};
use crate::{LightKind, LightRecord, LightTable, Spot};
use gonio_simd::Execution;
use std::f64::consts::PI;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Radiance of the floor at `x` under a light a metre above it.
fn floor(record: LightRecord, x: f64, count: usize) -> (f64, f64) {
    let record = LightRecord {
        to_world: {
            let [a, b, c, _] = record.to_world;
            [a, b, c, [0.0, 0.0, 1.0]]
        },
        ..record
    };
    let table = LightTable::build(&[record], NO_IMAGES, &[]);
    let drawn = draw(Execution::best(), &table, [x as f32, 0.0, 0.0], UP.map(|v| v as f32), &numbers(43, count));
    let (mean, error) = estimate(&drawn, UP, count);
    (mean[1] / PI, error[1] / PI)
}

fn place(k: usize) -> f64 {
    (k as f64 + 0.5) / 4.0
}

#[test]
fn spot_cones_are_those_of_cycles() {
    // Full angle in degrees, blend, stretch along x; radiances from x = 0.125 on.
    let measured: [(f32, f32, f32, &[f64]); 7] = [
        (60.0, 0.0, 1.0, &[0.976989, 0.820844, 0.0]),
        (60.0, 1.0, 1.0, &[0.967606, 0.440712, 0.0]),
        (120.0, 1.0, 1.0, &[0.976295, 0.784282, 0.474943, 0.216433, 0.074201]),
        (170.0, 0.7, 1.0, &[0.976989, 0.820844, 0.609763, 0.426253, 0.285503]),
        (178.0, 1.0, 1.0, &[0.976808, 0.810944, 0.570491, 0.358781, 0.213926]),
        (100.0, 0.5, 1.0, &[0.976989, 0.820844, 0.609763, 0.285206, 0.011776]),
        // An object scaled by a half along x.
        (100.0, 0.5, 0.5, &[0.976989, 0.788192, 0.0]),
    ];
    for (degrees, blend, across, radiances) in measured {
        let spot = Spot { angle: degrees.to_radians(), blend, stretch: [across, 1.0] };
        let record =
            LightRecord { spot: Some(spot), radiance: [PI as f32; 3], ..light(LightKind::Point, turned([1.0; 3], [0.0; 3]), [0.0; 3]) };
        for (k, expected) in radiances.iter().enumerate() {
            let (found, _) = floor(record, place(k), 16);
            // Cycles' pixels are 0.25 m wide with a filter that is a hundredth of that: places are known to a few millimetres.
            assert!((found - expected).abs() < 0.005, "{degrees}°, blend {blend}, pixel {k}: {found} for {expected}");
        }
    }
}

#[test]
fn spreads_are_those_of_cycles() {
    // Full angle in degrees; radiances over those of the light without spread, from x = 0.125 on.
    let measured: [(f32, &[f64]); 5] = [
        (179.0, &[1.012714, 1.010502, 1.00829, 1.006079]),
        (160.0, &[1.297355, 1.238876, 1.180402, 1.12194]),
        (120.0, &[2.346463, 1.981425, 1.616419, 1.251483]),
        (90.0, &[4.077003, 2.912065, 1.74723, 0.582619]),
        (60.0, &[8.414318, 3.76333, 0.0]),
    ];
    for kind in [LightKind::Rectangle, LightKind::Disk] {
        for (degrees, ratios) in measured {
            for (k, expected) in ratios.iter().enumerate() {
                let plain = light(kind, turned([1e-3, 1e-3, 1.0], [0.0; 3]), [0.0; 3]);
                let narrow = LightRecord { spread: degrees.to_radians(), ..plain };
                let (found, _) = floor(narrow, place(k), 4096);
                let ratio = found / floor(plain, place(k), 4096).0;
                assert!((ratio - expected).abs() < 2.5e-3 * ratios[0], "{kind:?} {degrees}°, pixel {k}: {ratio} for {expected}");
            }
        }
    }
}

#[test]
fn facing_disks_are_cycles_points_with_a_radius_and_soft_falloff() {
    let measured: [(f32, [f64; 8]); 2] = [
        (0.5, [0.78403, 0.673323, 0.516921, 0.373401, 0.264123, 0.187296, 0.134721, 0.098754]),
        (1.5, [0.303875, 0.276165, 0.232931, 0.187422, 0.147194, 0.114675, 0.089371, 0.070023]),
    ];
    for (radius, radiances) in measured {
        // Intensity π over the disk's area.
        let record =
            LightRecord { radiance: [radius.powi(-2); 3], ..light(LightKind::FacingDisk, turned([radius; 3], [0.0; 3]), [0.0; 3]) };
        for (k, expected) in radiances.into_iter().enumerate() {
            let (found, error) = floor(record, place(k), 1 << 16);
            assert!((found - expected).abs() < 4.9 * error + 5e-4 * expected, "{radius}, pixel {k}: {found} ± {error} for {expected}");
        }
    }
}

#[test]
fn spheres_shine_like_points_as_cycles_without_soft_falloff() {
    let (radius, far) = (0.5f32, 1.0);
    let record = LightRecord { radiance: [radius.powi(-2); 3], ..light(LightKind::Sphere, turned([radius; 3], [0.0; 3]), [0.0; 3]) };
    for k in 0..8 {
        let (found, error) = floor(record, place(k), 1 << 16);
        let cosine = far / (far * far + place(k) * place(k)).sqrt();
        assert!((found - cosine.powi(3)).abs() < 4.9 * error + 1e-5, "pixel {k}: {found} ± {error}");
    }
}
