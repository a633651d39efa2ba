//! Places and directions together are spread as the light sends: chi-square tests of the flux in cells of both.

use super::cases::{Case, finite, infinite, table};
use super::harness::{shoot, triple};
use crate::tests::agreement::bin_of;
use crate::tests::shape::element;
use crate::vector::{dot, unit_or};
use crate::{EmissionSampler, LightKind, LightRecord, LightTable};
use gonio_simd::{Execution, Lanes, One, Vec3};
use std::f64::consts::{PI, TAU};

/// Cells of place, along each axis; cells of direction, down and around.
const PLACES: usize = 3;
const DOWN: usize = 6;
const AROUND: usize = 8;
/// Points of the quadrature in each cell, along each axis.
const FINE: usize = 8;
const COUNT: usize = 1 << 17;

/// Luminance sent along `w` from a place in the texture.
fn sent(table: &LightTable, w: [f64; 3], uv: [f64; 2]) -> f64 {
    let l = One;
    let light = table.reader(l, l.u(0));
    let uv = [l.f(uv[0] as f32), l.f(uv[1] as f32)];
    f64::from(table.le(l, &light, Vec3::splat(l, w.map(|x| -x as f32)), uv).luminance().to_array()[0])
}

/// Components of a dome's radiance over the sphere.
pub(super) fn dome_integral(table: &LightTable, height: usize) -> [f64; 3] {
    let l = One;
    let light = table.reader(l, l.u(0));
    let mut sum = [0.0; 3];
    for i in 0..2 * height * height {
        let (x, y) = (((i % (2 * height)) as f64 + 0.5) / (2 * height) as f64, ((i / (2 * height)) as f64 + 0.5) / height as f64);
        let uv = [l.f(x as f32), l.f(y as f32)];
        let seen = table.le(l, &light, Vec3::splat(l, [0.0, 0.0, 1.0]), uv);
        let solid = (PI * y).sin() * PI * TAU / (2 * height * height) as f64;
        for (sum, x) in sum.iter_mut().zip([seen.r, seen.g, seen.b]) {
            *sum += f64::from(x.to_array()[0]) * solid;
        }
    }
    sum
}

/// The direction at a height and a turn, both in [0, 1), about +z, and the other way round.
fn direction(t: f64, turn: f64) -> [f64; 3] {
    let (cosine, (sine_turn, cosine_turn)) = (1.0 - 2.0 * t, (TAU * turn).sin_cos());
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    [sine * cosine_turn, sine * sine_turn, cosine]
}

fn direction_cell(w: [f64; 3]) -> usize {
    let cell = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
    cell((1.0 - w[2]) / 2.0, DOWN) * AROUND + cell((w[1].atan2(w[0]) / TAU).rem_euclid(1.0), AROUND)
}

/// Cells of place that a light has along an axis.
fn places(record: &LightRecord) -> usize {
    if matches!(record.kind, LightKind::Point | LightKind::FacingDisk) || record.kind.is_infinite() { 1 } else { PLACES }
}

/// Elements of the surface: cell, outward normal times area, place in the texture.
fn elements(record: &LightRecord) -> Vec<(usize, [f64; 3], [f64; 2])> {
    if places(record) == 1 {
        return vec![(0, [0.0; 3], [0.0; 2])];
    }
    let side = PLACES * FINE;
    let place = |i: usize| [(i / side) as f64 + 0.5, (i % side) as f64 + 0.5].map(|x| x / side as f64);
    (0..side * side)
        .map(|i| {
            let [s, t] = place(i);
            let (_, normal) = element(record, s, t);
            (i / side / FINE * PLACES + i % side / FINE, normal.map(|x| x / (side * side) as f64), [1.0 - s, 1.0 - t])
        })
        .collect()
}

/// Flux of a grey goniogram's light by component.
pub(super) fn flux(record: &LightRecord) -> [f64; 3] {
    let table = table(&[LightRecord { radiance: [1.0; 3], ..*record }]);
    let whole: f64 = expected(record, &table, 24).iter().sum();
    record.radiance.map(|x| f64::from(x) * whole)
}

/// Flux in each cell of place and direction.
fn expected(record: &LightRecord, table: &LightTable, fine: usize) -> Vec<f64> {
    let elements = elements(record);
    let (down, around) = (DOWN * fine, AROUND * fine);
    let mut cells = vec![0.0; places(record).pow(2) * DOWN * AROUND];
    for i in 0..down * around {
        let w = direction(((i / around) as f64 + 0.5) / down as f64, ((i % around) as f64 + 0.5) / around as f64);
        let solid = 4.0 * PI / (down * around) as f64;
        let even = if record.texture.is_none() { Some(sent(table, w, [0.0; 2])) } else { None };
        for (place, normal, uv) in &elements {
            let facing = dot(*normal, w);
            let shown = match record.kind {
                LightKind::Point => 1.0,
                LightKind::FacingDisk => PI * f64::from(record.to_world[0].iter().map(|x| x * x).sum::<f32>()),
                _ if record.two_sided => facing.abs(),
                _ => facing.max(0.0),
            };
            if shown > 0.0 {
                cells[place * DOWN * AROUND + direction_cell(w)] += even.unwrap_or_else(|| sent(table, w, *uv)) * shown * solid;
            }
        }
    }
    cells
}

/// Chi-square of the flux found in cells against that expected; z by Wilson and Hilferty's normal approximation.
fn z_value(case: &Case, table: &LightTable, sampler: &EmissionSampler, expected: &[f64], edge: f64) -> f64 {
    let rays = shoot(Execution::best(), sampler, table, 5, COUNT);
    let side = places(&case.record);
    let mut cells = vec![(0.0, 0.0, 0usize); expected.len()];
    for i in 0..COUNT {
        let flux = gonio_image::colour::luminance(triple(&rays.flux, i));
        if flux > 0.0 {
            let (origin, w) = (triple(&rays.origin, i), triple(&rays.direction, i));
            let place = if side == 1 { 0 } else { bin_of(&case.record, [0.0; 3], origin, side) };
            let cell = &mut cells[place * DOWN * AROUND + direction_cell(w)];
            *cell = (cell.0 + flux, cell.1 + flux * flux, cell.2 + 1);
        }
    }
    let (mut chi, mut used) = (0.0, 0);
    let total: f64 = expected.iter().sum();
    for ((sum, square, hits), expected) in cells.iter().zip(expected) {
        let mean = sum / COUNT as f64;
        let variance = (square / COUNT as f64 - mean * mean) / COUNT as f64;
        assert!(*hits > 0 || *expected < 2e-3 * total, "{}: nothing where {expected} of {total} is sent", case.name);
        if *hits >= 30 {
            chi += (mean - expected).powi(2) / (variance + (edge * expected).powi(2) + (1e-5 * total).powi(2));
            used += 1;
        }
    }
    let k = f64::from(used.max(2));
    ((chi / k).cbrt() - (1.0 - 2.0 / (9.0 * k))) / (2.0 / (9.0 * k)).sqrt()
}

/// How far the quadrature itself may be off: edges of beams cut its cells.
fn edge(record: &LightRecord) -> f64 {
    let hard = record.spot.is_some() || record.shaping.cone_angle.is_finite() || record.goniogram.is_some() || record.texture.is_some();
    if hard { 0.05 } else { 0.01 }
}

#[test]
fn places_and_directions_are_spread_as_the_light_sends() {
    let near = [([0.4f32, 0.3, 0.7], 0.5f32), ([-1.0, 0.4, 3.0], 0.4), ([0.2, 0.1, 2.1], 2.0)];
    for case in finite() {
        // Beams narrower than the cells are left to the other tests.
        let narrow = case.record.spread < 1.0 || case.record.spot.is_some_and(|spot| spot.angle < 0.1);
        if narrow {
            continue;
        }
        let table = table(&[case.record]);
        let expected = expected(&case.record, &table, FINE);
        for targets in [&[][..], &near[..]] {
            let sampler = EmissionSampler::new(&table, None, ([0.0; 3], 5.0), targets);
            let z = z_value(&case, &table, &sampler, &expected, edge(&case.record));
            assert!(z < 4.75, "{} with {} targets: z = {z}", case.name, targets.len());
        }
    }
}

#[test]
fn directions_of_skies_are_spread_as_they_send() {
    for case in infinite() {
        if case.record.angle < 0.1 && case.record.kind == LightKind::Distant {
            continue;
        }
        let table = table(&[case.record]);
        let (down, around) = (DOWN * 64, AROUND * 64);
        let mut expected = vec![0.0; DOWN * AROUND];
        let disk = PI * 25.0;
        let axes = case.record.to_world.map(|v| unit_or(v.map(f64::from), [0.0; 3]));
        for i in 0..down * around {
            let w = direction(((i / around) as f64 + 0.5) / down as f64, ((i % around) as f64 + 0.5) / around as f64);
            let local = [0, 1, 2].map(|k| -dot(axes[k], w));
            let (within, uv) = if case.record.kind == LightKind::Dome {
                let place = [0.5 - local[0].atan2(local[2]) / TAU, local[0].hypot(local[2]).atan2(local[1]) / PI];
                (true, place)
            } else {
                (local[2] >= (f64::from(case.record.angle) / 2.0).cos(), [0.0; 2])
            };
            if within {
                expected[direction_cell(w)] += sent(&table, w, uv) * disk * 4.0 * PI / (down * around) as f64;
            }
        }
        for targets in [&[][..], &[([0.4f32, 0.3, 0.7], 0.5f32), ([-1.0, 0.4, 3.0], 0.4)][..]] {
            let sampler = EmissionSampler::new(&table, None, ([0.0; 3], 5.0), targets);
            let z = z_value(&case, &table, &sampler, &expected, 0.02);
            assert!(z < 4.75, "{} with {} targets: z = {z}", case.name, targets.len());
        }
    }
}
