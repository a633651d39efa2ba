//! What rays carry in the mean is what the light sends.

use super::cases::{Case, finite, goniograms, infinite, table};
use super::harness::{mean, shoot, triple};
use crate::tests::shape::{element, shaping};
use crate::vector::{dot, scale, unit_or, widen};
use crate::{EmissionSampler, FarField, LightKind, LightRecord};
use gonio_simd::Execution;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const SCENE: ([f32; 3], f32) = ([0.5, -0.3, 0.2], 3.0);
const COUNT: usize = 1 << 16;

/// Two-point Gauss quadrature over the sphere about an axis, between the angles where something begins or ends.
fn over_sphere(edges: &[f64], axes: [[f64; 3]; 3], value: impl Fn([f64; 3]) -> [f64; 3]) -> [f64; 3] {
    let off = 0.5 / 3.0_f64.sqrt();
    let (pieces, turns) = (24, 96);
    let mut sum = [0.0; 3];
    for pair in edges.windows(2) {
        let width = (pair[1] - pair[0]) / f64::from(pieces);
        for k in 0..2 * pieces {
            let polar = pair[0] + width * (f64::from(k / 2) + 0.5 + if k % 2 == 0 { -off } else { off });
            for turn in 0..turns {
                let (sine, cosine) = (TAU * (f64::from(turn) + 0.5) / f64::from(turns)).sin_cos();
                let local = [polar.sin() * cosine, polar.sin() * sine, polar.cos()];
                let w = [0, 1, 2].map(|c| (0..3).map(|axis| axes[axis][c] * local[axis]).sum());
                let sent = value(w);
                (0..3).for_each(|c| sum[c] += sent[c] * polar.sin() * width * 0.5 * TAU / f64::from(turns));
            }
        }
    }
    sum
}

/// Orthonormal axes, the last along `z`.
fn about(z: [f64; 3]) -> [[f64; 3]; 3] {
    let z = unit_or(z, [0.0, 0.0, 1.0]);
    let x = unit_or(crate::vector::cross(z, if z[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }), [0.0; 3]);
    [x, crate::vector::cross(z, x), z]
}

/// Flux of a light without goniogram or opening, by its surface's elements.
fn by_elements(record: &LightRecord) -> [f64; 3] {
    let spot = record.spot.map_or(0.0, |spot| f64::from(spot.angle) / 2.0);
    let inner = record.spot.map_or(0.0, |spot| (spot_edge(spot.angle) + (1.0 - spot_edge(spot.angle)) * f64::from(spot.blend)).acos());
    let cone = f64::from(record.shaping.cone_angle);
    let spread = if record.kind.is_flat() { f64::from(record.spread) / 2.0 } else { PI };
    let mut edges = vec![0.0, FRAC_PI_2, PI, spot, inner, cone, cone * (1.0 - f64::from(record.shaping.softness)), spread];
    edges.retain(|edge| (0.0..=PI).contains(edge));
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| *a - *b < 1e-9);
    let side = 24;
    let place = |i: usize| ((i / side) as f64 + 0.5, (i % side) as f64 + 0.5);
    let normals: Vec<[f64; 3]> = match record.kind {
        LightKind::Point | LightKind::FacingDisk => Vec::new(),
        _ => (0..side * side).map(|i| element(record, place(i).0 / side as f64, place(i).1 / side as f64).1).collect(),
    };
    let pole = if spread < 3.0 { scale(element(record, 0.5, 0.5).1, 1.0) } else { scale(widen(record.to_world[2]), -1.0) };
    let image = record.texture.map_or([1.0; 3], |number| {
        let pixels = super::cases::textures()[number as usize].rgb.as_chunks::<3>().0.to_vec();
        [0, 1, 2].map(|k| pixels.iter().map(|pixel| f64::from(pixel[k])).sum::<f64>() / pixels.len() as f64)
    });
    over_sphere(&edges, about(pole), |w| {
        let shown = match record.kind {
            LightKind::Point => 1.0,
            LightKind::FacingDisk => PI * dot(widen(record.to_world[0]), widen(record.to_world[0])),
            _ => {
                let facing = |n: &[f64; 3]| if record.two_sided { dot(*n, w).abs() } else { dot(*n, w).max(0.0) };
                normals.iter().map(facing).sum::<f64>() / (side * side) as f64
            }
        };
        let factor = shaping(record, w);
        [0, 1, 2].map(|k| f64::from(record.radiance[k]) * factor[k] * shown * image[k])
    })
}

fn spot_edge(angle: f32) -> f64 {
    (f64::from(angle) / 2.0).cos()
}

fn luminance(c: [f64; 3]) -> f64 {
    gonio_image::colour::luminance(c)
}

/// Flux by component: of measured lights in proportion to their colour.
fn expected(record: &LightRecord) -> [f64; 3] {
    if record.goniogram.is_none() && record.opening.is_none() {
        return by_elements(record);
    }
    if record.two_sided {
        // The far field knows the front alone.
        return super::chi_square::flux(record);
    }
    let image = by_elements(&LightRecord { goniogram: None, opening: None, ..*record });
    let plain = by_elements(&LightRecord { goniogram: None, opening: None, texture: None, ..*record });
    let flux = FarField::new(&[*record], &goniograms()).flux();
    let radiance = widen(record.radiance);
    [0, 1, 2].map(|k| flux * radiance[k] / luminance(radiance) * image[k] / plain[k])
}

fn compare(case: &Case, expected: [f64; 3], relative: f64) {
    let table = table(&[case.record]);
    let sampler = EmissionSampler::new(&table, None, SCENE, &[]);
    let power = sampler.power(0);
    assert_eq!(power, sampler.total_power());
    let rays = shoot(Execution::best(), &sampler, &table, 7, COUNT);
    for k in 0..3 {
        assert!((power[k] / expected[k] - 1.0).abs() < relative, "{} {k}: power {} for {}", case.name, power[k], expected[k]);
        let [found, error] = mean((0..COUNT).map(|i| triple(&rays.flux, i)[k]), COUNT);
        assert!(
            (found - expected[k]).abs() < 4.0 * error + 1e-3 * expected[k],
            "{} {k}: flux {found} ± {error} for {}",
            case.name,
            expected[k]
        );
        // Rays are worth about the same, as far as the colours of what they are drawn by let them.
        let deviation = error * (COUNT as f64).sqrt();
        let most = if k == 1 && case.record.texture.is_none() { 0.6 } else { 2.0 };
        assert!(deviation < most * found, "{} {k}: deviation {deviation} of {found}", case.name);
    }
}

#[test]
fn finite_lights_send_their_flux() {
    for case in finite() {
        compare(&case, expected(&case.record), 3e-3);
    }
}

#[test]
fn infinite_lights_send_their_flux_through_the_scene() {
    for case in infinite() {
        let record = case.record;
        let disk = PI * f64::from(SCENE.1).powi(2);
        let solid = match record.kind {
            LightKind::Distant if record.angle == 0.0 => 1.0,
            LightKind::Distant => TAU * (1.0 - (f64::from(record.angle) / 2.0).cos()),
            _ => 4.0 * PI,
        };
        let mut whole = [solid * disk; 3];
        if record.texture.is_some() {
            // The image about its own axis: axes play no part in the sum.
            let table = table(&[LightRecord { radiance: [1.0; 3], ..record }]);
            whole = super::chi_square::dome_integral(&table, 1024).map(|x| x * disk);
        }
        compare(&case, [0, 1, 2].map(|k| f64::from(record.radiance[k]) * whole[k]), 1e-3);
    }
}
