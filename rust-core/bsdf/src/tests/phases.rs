//! The table of phase functions against the papers' own formulas in double precision: values, integrals, mean cosines, a chi-square test.

mod formulas;

use super::harness::random;
use crate::phase::{Phase, PhaseTable};
use formulas::{RAYLEIGH, all, exact, nearest};
use gonio_simd::{Execution, Lanes, U, Vec3, dispatch};
use std::f64::consts::TAU;

const SAMPLES: usize = 1 << 17;
/// Bins of equal probability by the cosine, of no number that divides the table's, and bins about the direction.
const RINGS: usize = 37;
const TURNS: usize = 8;
/// Steps of integrals.
const NODES: usize = 1 << 16;

/// A table of all of them, and their rows.
fn table(phases: &[Phase]) -> (PhaseTable, Vec<u32>) {
    let mut table = PhaseTable::default();
    let rows = phases.iter().map(|phase| table.add(*phase)).collect();
    (table, rows)
}

/// A direction by how far it is from straight up: 1 − cosine.
fn leaning(t: f64) -> [f32; 3] {
    [(t * (2.0 - t)).max(0.0).sqrt() as f32, 0.0, (1.0 - t) as f32]
}

/// Values for light that went straight up, by row and direction.
#[inline(always)]
fn values<L: Lanes>(l: L, table: &PhaseTable, asked: &[(u32, [f32; 3])], out: &mut Vec<f32>) {
    for chunk in asked.chunks(L::COUNT) {
        let (mut rows, mut columns) = ([0; 16], [[0.0; 16]; 3]);
        for (lane, (row, direction)) in chunk.iter().enumerate() {
            rows[lane] = *row;
            (0..3).for_each(|axis| columns[axis][lane] = direction[axis]);
        }
        let row: U<L> = l.load_integers(&rows, 0);
        let to = Vec3::load(l, [&columns[0], &columns[1], &columns[2]], 0);
        let found = table.value(l, row, Vec3::splat(l, [0.0, 0.0, 1.0]), to).to_array();
        out.extend(&found[..chunk.len()]);
    }
}

/// Directions and factors of light that goes straight up.
#[inline(always)]
fn draw<L: Lanes>(l: L, table: &PhaseTable, row: u32, numbers: &[[f32; 3]], out: &mut Vec<[f32; 4]>) {
    for chunk in numbers.chunks_exact(L::COUNT) {
        let (mut u, mut v) = ([0.0; 16], [0.0; 16]);
        for (lane, number) in chunk.iter().enumerate() {
            (u[lane], v[lane]) = (number[0], number[1]);
        }
        let (to, factor) = table.sample(l, l.u(row), Vec3::splat(l, [0.0, 0.0, 1.0]), [l.load(&u, 0), l.load(&v, 0)]);
        let [x, y, z, w] = [to.x.to_array(), to.y.to_array(), to.z.to_array(), factor.to_array()];
        out.extend((0..L::COUNT).map(|lane| [x[lane], y[lane], z[lane], w[lane]]));
    }
}

/// Places from straight on to straight back, finer towards both ends, with the solid angles about them.
fn places() -> impl Iterator<Item = (f64, f64)> {
    // Near straight on, Fournier and Forand's function goes as a power of the angle: a step is a part of the distance there.
    let near = (0..NODES).map(|node| (1e-11_f64.ln() * (1.0 - (node as f64 + 0.5) / NODES as f64)).exp());
    let width = -(1e-11_f64).ln() / NODES as f64;
    let near = near.map(move |t| (t, TAU * t * width));
    let far = (0..NODES).map(|node| {
        let x = (node as f64 + 0.5) / NODES as f64;
        (2.0 - x * x, TAU * 2.0 * x / NODES as f64)
    });
    near.chain(far)
}

#[test]
fn all_of_the_light_goes_somewhere_and_as_far_ahead_as_it_should() {
    let mut all = all();
    // So little goes back that no ring below is wide enough.
    all.push((Phase::FournierForand { ior: 1.1, backscatter: 0.005 }, 0.976967));
    all.push((Phase::FournierForand { ior: 2.0, backscatter: 0.005 }, 0.985274));
    let (table, rows) = table(&all.iter().map(|(phase, _)| *phase).collect::<Vec<_>>());
    let places: Vec<(f64, f64)> = places().collect();
    for ((phase, mean), row) in all.iter().zip(rows) {
        let asked: Vec<(u32, [f32; 3])> = places.iter().map(|(t, _)| (row, leaning(*t))).collect();
        let mut found = Vec::new();
        dispatch!(Execution::best(), l => values(l, &table, &asked, &mut found));
        let (mut whole, mut ahead, mut back) = (nearest(*phase), nearest(*phase), 0.0);
        for ((t, angle), value) in places.iter().zip(&found) {
            assert!(*value >= 0.0 && value.is_finite(), "{phase:?} at {t}: {value}");
            let part = f64::from(*value) * angle;
            (whole, ahead) = (whole + part, ahead + part * (1.0 - t));
            back += if *t > 1.0 { part } else { 0.0 };
        }
        assert!((whole - 1.0).abs() < 1e-4, "{phase:?}: {whole}");
        if let Phase::FournierForand { backscatter, .. } = phase {
            assert!((back - f64::from(*backscatter)).abs() < 1e-4, "{phase:?}: {back} goes back");
        }
        assert!((ahead - mean).abs() < 1e-4, "{phase:?}: mean cosine {ahead} for {mean}");
    }
}

#[test]
fn values_are_those_of_the_papers() {
    let all: Vec<Phase> = all().into_iter().map(|(phase, _)| phase).filter(|phase| exact(*phase, 0.3).is_some()).collect();
    let (table, rows) = table(&all);
    for (phase, row) in all.iter().zip(rows) {
        // Between 1e-6 and straight back.
        let places: Vec<f64> =
            (1..2000).map(|i| 2e-6_f64.powf(1.0 - f64::from(i) / 2000.0)).chain((1..200).map(|i| f64::from(i) / 100.0)).collect();
        let asked: Vec<(u32, [f32; 3])> = places.iter().map(|t| (row, leaning(*t))).collect();
        let mut found = Vec::new();
        dispatch!(Execution::best(), l => values(l, &table, &asked, &mut found));
        for (value, (_, to)) in found.iter().zip(&asked) {
            let t = (f64::from(to[0]).powi(2) + (1.0 - f64::from(to[2])).powi(2)) / 2.0;
            let Some(right) = exact(*phase, 1.0 - t) else { continue };
            assert!((f64::from(*value) / right - 1.0).abs() < 2e-4, "{phase:?} at {t}: {value} for {right}");
        }
    }
}

/// Bounds of rings of equal probability, in 1 − cosine.
fn rings(table: &PhaseTable, row: u32) -> Vec<f64> {
    let places: Vec<(f64, f64)> = (0..NODES * 4)
        .map(|node| {
            let x = (node as f64 + 0.5) / (NODES * 4) as f64;
            (2.0 * x.powi(12), TAU * 24.0 * x.powi(11) / (NODES * 4) as f64)
        })
        .collect();
    let asked: Vec<(u32, [f32; 3])> = places.iter().map(|(t, _)| (row, leaning(*t))).collect();
    let mut found = Vec::new();
    dispatch!(Execution::best(), l => values(l, table, &asked, &mut found));
    let mut sum = 0.0;
    let sums: Vec<f64> = places
        .iter()
        .zip(&found)
        .map(|((_, angle), value)| {
            sum += f64::from(*value) * angle;
            sum
        })
        .collect();
    let at = |ring: usize| sums.partition_point(|below| *below < sum * ring as f64 / RINGS as f64);
    (1..RINGS).map(|ring| places[at(ring)].0).collect()
}

#[test]
fn directions_are_drawn_as_often_as_the_functions_say() {
    let all: Vec<Phase> = all().into_iter().map(|(phase, _)| phase).collect();
    let (table, rows) = table(&all);
    let numbers = random(SAMPLES, 11);
    for (phase, row) in all.iter().zip(rows) {
        let bounds = rings(&table, row);
        let mut found = Vec::new();
        dispatch!(Execution::best(), l => draw(l, &table, row, &numbers, &mut found));
        let mut bins = vec![0.0; RINGS * TURNS];
        let mut factors = 0.0;
        for [x, y, z, factor] in &found {
            let [x, y, z] = [*x, *y, *z].map(f64::from);
            let t = (x * x + y * y + (1.0 - z) * (1.0 - z)) / 2.0;
            let turn = (y.atan2(x) / TAU).rem_euclid(1.0) * TURNS as f64;
            bins[bounds.partition_point(|bound| *bound < t) * TURNS + (turn as usize).min(TURNS - 1)] += 1.0;
            assert!(*factor >= 0.0 && *factor < 5.0, "{phase:?} at {t}: {factor}");
            factors += f64::from(*factor);
        }
        let expected = found.len() as f64 / bins.len() as f64;
        let chi_square: f64 = bins.iter().map(|count| (count - expected) * (count - expected) / expected).sum();
        let freedom = (bins.len() - 1) as f64;
        assert!(chi_square < freedom + 4.0 * (2.0 * freedom).sqrt(), "{phase:?}: {chi_square} of {freedom}");
        let mean = factors / found.len() as f64;
        assert!((mean - 1.0).abs() < 1e-3, "{phase:?}: factors are {mean} in the mean");
    }
}

#[test]
fn all_levels_agree() {
    let all: Vec<Phase> = all().into_iter().map(|(phase, _)| phase).collect();
    let (table, rows) = table(&all);
    let numbers = random(512, 5);
    let asked: Vec<(u32, [f32; 3])> =
        numbers.iter().enumerate().map(|(i, u)| (rows[i % rows.len()], leaning(2.0 * f64::from(u[2]).powi(3)))).collect();
    let (mut right, mut drawn) = (Vec::new(), Vec::new());
    values(gonio_simd::One, &table, &asked, &mut right);
    rows.iter().for_each(|row| draw(gonio_simd::One, &table, *row, &numbers, &mut drawn));
    for execution in Execution::all() {
        let (mut found, mut own) = (Vec::new(), Vec::new());
        dispatch!(execution, l => values(l, &table, &asked, &mut found));
        for row in &rows {
            dispatch!(execution, l => draw(l, &table, *row, &numbers, &mut own));
        }
        for (found, right) in found.iter().zip(&right) {
            assert!((found / right - 1.0).abs() < 1e-4, "{execution:?}: {found} for {right}");
        }
        for (found, right) in own.iter().flatten().zip(drawn.iter().flatten()) {
            assert!((found - right).abs() < 1e-4, "{execution:?}: {found} for {right}");
        }
    }
}

#[test]
fn phase_functions_that_are_alike_share_a_row_and_one_alone_needs_no_table() {
    let mut table = PhaseTable::default();
    assert_eq!(table.add(Phase::default()), table.add(Phase::HenyeyGreenstein { g: 0.0 }));
    assert!(!table.is_varied());
    assert_eq!((table.add(RAYLEIGH), table.add(Phase::Mie { diameter: 8.0 }), table.add(RAYLEIGH)), (1, 2, 1));
    assert!(table.is_varied());
}
