//! Domes looked for through portals.

use super::harness::{NO_IMAGES, draw, eval_escaped, light, numbers, sample_li, seeing_all, turned, uniform};
use crate::{EscapedRay, LightKind, LightRecord, LightTable, LightTexture, power_heuristic};
use gonio_simd::{Column, Execution, F, Lanes, M, One, Vec3, dispatch};
use std::f64::consts::PI;

/// Two windows beside and above the origin, one of them sheared, and one that looks away.
fn portals() -> Vec<LightRecord> {
    let window = |axes, at| LightRecord { portal: true, ..light(LightKind::Rectangle, axes, at) };
    vec![
        window(turned([0.6, 0.4, 1.0], [0.2, 0.1, 0.3]), [0.3, -0.2, 1.5]),
        window([[0.0, 0.5, 0.1], [0.1, 0.2, 0.6], [1.0, 0.0, 0.0]], [2.0, 0.5, 0.7]),
        window(turned([1.0, 1.0, 1.0], [PI as f32, 0.0, 0.0]), [0.0, 0.0, 1.0]),
    ]
}

fn sky() -> LightTexture {
    let (width, height) = (64, 32);
    let rgb = (0..width * height).flat_map(|i| [0.5 + uniform(9, i as u64); 3]).collect();
    LightTexture { width, height, rgb }
}

fn table(textured: bool, with_portals: bool) -> LightTable {
    let dome = LightRecord { texture: textured.then_some(0), ..LightRecord::new(LightKind::Dome) };
    let mut records = vec![dome];
    if with_portals {
        records.extend(portals());
    }
    LightTable::build(&records, &[sky()], &[])
}

const NORMAL: [f32; 3] = [0.0, 0.0, 1.0];

/// Density of directions by the weight that `escaped` gives them: w = 1 / (1 + (pdf / b)²).
#[inline(always)]
fn density<L: Lanes>(l: L, table: &LightTable, wi: Vec3<L>) -> F<L> {
    let (from, n) = (Vec3::splat(l, [0.0; 3]), Vec3::splat(l, NORMAL));
    let portals = table.portals_at(l, from).expect("there are portals");
    let of_dome = n.dot(wi).max(0.0) * std::f32::consts::FRAC_1_PI;
    table.portal_density(l, &portals, from, wi, of_dome)
}

#[inline(always)]
fn densities<L: Lanes>(l: L, table: &LightTable, directions: &[Column; 3], out: &mut Column) {
    for at in (0..out.len()).step_by(L::COUNT) {
        density(l, table, Vec3::load(l, [&directions[0], &directions[1], &directions[2]], at)).store(out, at);
    }
}

/// Directions at the middles of equal cells in azimuth and height, and the cells' solid angle.
fn grid(width: usize, height: usize) -> ([Column; 3], f64) {
    let count = width * height;
    let mut columns = [Column::new(count), Column::new(count), Column::new(count)];
    for i in 0..count {
        let z = 2.0 * ((i / width) as f64 + 0.5) / height as f64 - 1.0;
        let (sine, cosine) = (2.0 * PI * ((i % width) as f64 + 0.5) / width as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        for (column, value) in columns.iter_mut().zip([r * cosine, r * sine, z]) {
            column[i] = value as f32;
        }
    }
    (columns, 4.0 * PI / count as f64)
}

#[test]
fn directions_are_distributed_by_their_density() {
    const BINS: [usize; 2] = [24, 12];
    const FINE: usize = 32;
    let table = table(false, true);
    let (directions, solid) = grid(BINS[0] * FINE, BINS[1] * FINE);
    let mut pdf = Column::new(directions[0].len());
    densities(One, &table, &directions, &mut pdf);
    let mut shares = vec![0.0; BINS[0] * BINS[1]];
    for (i, density) in pdf.iter().enumerate().take(BINS[0] * BINS[1] * FINE * FINE) {
        let (row, column) = (i / (BINS[0] * FINE) / FINE, i % (BINS[0] * FINE) / FINE);
        shares[row * BINS[0] + column] += f64::from(*density) * solid;
    }
    let total: f64 = shares.iter().sum();
    assert!((total - 1.0).abs() < 5e-3, "the density's integral is {total}");
    let count = 1 << 17;
    let drawn = draw(Execution::best(), &table, [0.0; 3], NORMAL, &numbers(47, count));
    let mut observed = vec![0.0; shares.len()];
    for i in 0..count {
        let [x, y, z] = drawn.direction(i);
        let cell = |t: f64, bins: usize| ((t * bins as f64) as usize).min(bins - 1);
        let turn = (y.atan2(x) / (2.0 * PI)).rem_euclid(1.0);
        observed[cell((z + 1.0) / 2.0, BINS[1]) * BINS[0] + cell(turn, BINS[0])] += 1.0;
    }
    let (mut chi, mut cells) = (0.0, 0.0);
    for (share, seen) in shares.iter().zip(&observed) {
        let expected = share / total * count as f64;
        if expected > 8.0 {
            // The expectation's own error, from the windows' edges.
            chi += (seen - expected).powi(2) / (expected + (0.02 * expected).powi(2));
            cells += 1.0;
        }
    }
    // Wilson and Hilferty's normal approximation; 1 − 1e-6 one-sided.
    let z = ((chi / cells).cbrt() - (1.0 - 2.0 / (9.0 * cells))) / (2.0f64 / (9.0 * cells)).sqrt();
    assert!(z < 4.75, "chi-square {chi} over {cells} cells (z = {z})");
}

/// Both halves of the estimate through openings: what does not pass a window is dark.
#[inline(always)]
fn through_windows<L: Lanes>(l: L, table: &LightTable, windows: &LightTable, u: &[Column; 3], out: &mut Column) {
    let p = Vec3::splat(l, [0.0; 3]);
    let from = seeing_all(l, [p, Vec3::splat(l, NORMAL)]);
    let never: M<L> = l.m(false);
    let open = |wi: Vec3<L>| {
        let portals = windows.portals_at(l, p).expect("there are portals");
        windows.portal_density(l, &portals, p, wi, l.f(0.0)).gt(0.0)
    };
    for at in (0..out.len()).step_by(L::COUNT) {
        let numbers: [F<L>; 3] = [l.load(&u[0], at), l.load(&u[1], at), l.load(&u[2], at)];
        let s = sample_li(l, table, None, &from, &numbers);
        let cosine = s.wi.z.max(0.0);
        let weight = power_heuristic(s.pdf, cosine * std::f32::consts::FRAC_1_PI);
        let by_light = (s.radiance.g * cosine * weight / s.pdf).keep_if(s.pdf.gt(0.0) & open(s.wi));
        let (sine, cosine) = numbers[2].sin_cos_turns();
        let r = numbers[1].sqrt();
        let wi = Vec3::new(r * cosine, r * sine, (1.0 - numbers[1]).safe_sqrt());
        let ray = EscapedRay { direction: wi, pdf: wi.z * std::f32::consts::FRAC_1_PI, first: never, delta: never, kind: l.u(0) };
        let by_bsdf = eval_escaped(l, table, &from, &ray).to_rgb().g * std::f32::consts::PI;
        (by_light + by_bsdf.keep_if(open(wi))).store(out, at);
    }
}

fn illuminance(table: &LightTable, windows: &LightTable) -> (f64, f64) {
    let count = 1 << 17;
    let u = numbers(53, count);
    let mut out = Column::new(count);
    dispatch!(Execution::best(), l => through_windows(l, table, windows, &u, &mut out));
    let (mut sum, mut square) = (0.0, 0.0);
    for x in &out[..count] {
        sum += f64::from(*x);
        square += f64::from(*x).powi(2);
    }
    let mean = sum / count as f64;
    (mean, ((square / count as f64 - mean * mean) / count as f64).sqrt())
}

#[test]
fn portals_change_the_noise_and_not_the_light() {
    for textured in [false, true] {
        let windows = table(textured, true);
        let (with, error) = illuminance(&windows, &windows);
        let (without, plain_error) = illuminance(&table(textured, false), &windows);
        let allowed = 4.9 * (error * error + plain_error * plain_error).sqrt();
        assert!((with - without).abs() < allowed, "textured {textured}: {with} ± {error} with portals, {without} ± {plain_error} without");
        assert!(error < 0.8 * plain_error, "textured {textured}: error {error} with portals, {plain_error} without");
    }
}

#[test]
fn portals_are_no_lights() {
    let table = LightTable::build(&portals(), NO_IMAGES, &[]);
    let drawn = draw(Execution::best(), &table, [0.0; 3], NORMAL, &numbers(59, 256));
    assert!(drawn.pdf.iter().all(|pdf| *pdf == 0.0));
}

#[test]
fn levels_agree_on_portals() {
    let table = table(true, true);
    let u = numbers(61, 4096);
    let scalar = draw(Execution::Scalar, &table, [0.1, 0.2, 0.0], NORMAL, &u);
    for execution in Execution::all() {
        let wide = draw(execution, &table, [0.1, 0.2, 0.0], NORMAL, &u);
        let close = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(1e-3);
        let differs = |i: &usize| !close(scalar.pdf[*i], wide.pdf[*i]) || (0..3).any(|k| !close(scalar.wi[k][*i], wide.wi[k][*i]));
        let different = (0..4096).filter(differs).count();
        // Roundings tip a choice here and there.
        assert!(different <= 16, "{}: {different} of 4096 samples differ", execution.name());
    }
}
