//! `sample`, `eval_hit` and the levels agree.

use super::harness::{NO_IMAGES, draw, eval_hit, light, numbers, seeing_all, turned};
use super::shape::{facing_axes, seen};
use crate::vector::{Vector, dot, length, narrow, widen};
use crate::{LightKind, LightRecord, LightTable, OpeningPart, ProjectedArea, Shaping, Spot};
use gonio_simd::{Column, Execution, Lanes, One, Vec3};

fn lights() -> Vec<LightRecord> {
    let at = [0.2, 0.1, 2.0];
    let mut all = Vec::new();
    for kind in [LightKind::Rectangle, LightKind::Disk, LightKind::Sphere, LightKind::Cylinder] {
        all.push(light(kind, turned([0.8, 0.5, 0.6], [0.0; 3]), at));
        all.push(light(kind, turned([0.9, 0.3, 0.5], [0.3, -0.2, 0.7]), at));
        all.push(light(kind, [[0.7, 0.2, 0.1], [0.4, 0.6, -0.1], [0.05, 0.1, 0.9]], at));
    }
    let flipped = [[0.7, 0.2, 0.1], [-0.4, -0.6, 0.1], [0.05, 0.1, 0.9]];
    all.push(light(LightKind::Triangle, flipped, at));
    all.push(LightRecord { two_sided: true, ..light(LightKind::Rectangle, turned([0.8, 0.5, 0.6], [0.0, 3.0, 0.0]), at) });
    all.push(light(LightKind::FacingDisk, turned([0.2; 3], [0.3, -0.2, 0.7]), at));
    for axes in [turned([0.8, 0.5, 0.6], [0.0; 3]), [[0.7, 0.2, 0.1], [0.4, 0.6, -0.1], [0.05, 0.1, 0.9]]] {
        for kind in [LightKind::Rectangle, LightKind::Disk] {
            for spread in [2.4, 1.6, 0.55] {
                all.push(LightRecord { spread, ..light(kind, axes, at) });
            }
        }
    }
    all.extend(luminaires(at));
    for record in &mut all {
        record.spot = Some(Spot { angle: 2.8, blend: 0.6, stretch: [1.2, 0.9] });
        record.shaping = Shaping { cone_angle: 1.3, softness: 0.5, focus: 2.0, focus_tint: [0.2, 0.1, 0.0] };
    }
    all
}

/// Parts of luminaires: the radiance is an intensity over what the whole shows.
fn luminaires(at: [f32; 3]) -> Vec<LightRecord> {
    let faces = ProjectedArea::of_faces(&[(0, [0.0, 0.0, -1.6]), (0, [0.0, 0.0, 1.6]), (1, [0.4, 0.0, 0.0])]);
    let wide = |axes: [[f32; 3]; 3]| axes.map(widen);
    [
        (LightKind::Rectangle, turned([0.8, 0.5, 0.6], [0.0; 3]), faces),
        (
            LightKind::Cylinder,
            turned([0.8, 0.3, 0.2], [0.2, 0.4, -0.3]),
            ProjectedArea::of_cylinder(wide(turned([0.8, 0.3, 0.2], [0.2, 0.4, -0.3]))),
        ),
        (
            LightKind::Sphere,
            turned([0.3, 0.5, 0.2], [0.2, 0.4, -0.3]),
            ProjectedArea::of_ellipsoid(wide(turned([0.3, 0.5, 0.2], [0.2, 0.4, -0.3]))),
        ),
    ]
    .map(|(kind, axes, area)| {
        let part = OpeningPart { area, share: 0.5, axes: turned([1.0; 3], [0.1, 0.2, 0.3]) };
        LightRecord { opening: Some(part), ..light(kind, axes, at) }
    })
    .into()
}

const POINTS: [[f32; 3]; 5] = [[0.0, 0.0, 0.0], [0.3, 0.2, 0.9], [0.4, 0.2, 1.75], [1.3, -0.4, 1.7], [5.0, 7.0, -30.0]];

#[test]
fn eval_hit_gives_what_sample_gave() {
    let records = lights();
    let table = LightTable::build(&records, NO_IMAGES, &[]);
    let count = 1 << 14;
    for p in POINTS {
        let drawn = draw(Execution::best(), &table, p, [0.0, 0.0, 1.0], &numbers(11, count));
        let mut lit = 0;
        for i in 0..count {
            let pdf = f64::from(drawn.pdf[i]);
            if pdf <= 0.0 {
                continue;
            }
            lit += 1;
            let eval = f64::from(drawn.eval_pdf[i]);
            let record = &records[drawn.light[i] as usize];
            // The hit is rounded to single precision, which at grazing angles moves the density.
            assert!((eval / pdf - 1.0).abs() < 5e-3, "{:?} from {p:?}: {eval} for {pdf}", record.kind);
            for k in 0..3 {
                let (a, b) = (drawn.radiance[k][i], drawn.eval_radiance[k][i]);
                assert!((a - b).abs() <= 1e-5 * a.abs(), "{:?} from {p:?}: radiance {b} for {a}", record.kind);
            }
        }
        assert!(lit > count / 2, "{lit} of {count} samples carry light from {p:?}");
    }
}

#[inline(always)]
fn densities<L: Lanes>(l: L, table: &LightTable, p: [f32; 3], hits: &[Column; 3], pdf: &mut Column) {
    let p = Vec3::splat(l, p);
    let from = seeing_all(l, [p, Vec3::splat(l, [0.0, 0.0, 1.0])]);
    for at in (0..hits[0].len()).step_by(L::COUNT) {
        let hit = Vec3::load(l, [&hits[0], &hits[1], &hits[2]], at);
        let wi = (hit - p).normalize();
        eval_hit(l, table, None, &from, l.u(0), [wi, hit], l.m(true)).1.store(pdf, at);
    }
}

/// The place `(s, t)` of a direction's point on the surface: the element that lies nearest, by search over the bins' corners.
pub(super) fn bin_of(record: &LightRecord, from: Vector, point: Vector, bins: usize) -> usize {
    let columns = record.to_world.map(widen);
    let inverse = crate::vector::inverse_rows([columns[0], columns[1], columns[2]]).expect("shapes of the test are regular");
    let v = [0, 1, 2].map(|k| point[k] - columns[3][k]);
    let q = [0, 1, 2].map(|k| crate::vector::dot(inverse[k], v));
    let turn = |y: f64, x: f64| (y.atan2(x) / std::f64::consts::TAU).rem_euclid(1.0);
    let (s, t) = match record.kind {
        LightKind::Rectangle => ((q[0] + 1.0) / 2.0, (q[1] + 1.0) / 2.0),
        LightKind::Disk => (q[0] * q[0] + q[1] * q[1], turn(q[1], q[0])),
        LightKind::Triangle => ((1.0 - q[0]).powi(2), q[1] / (1.0 - q[0])),
        LightKind::Cylinder => ((q[0] + 1.0) / 2.0, turn(q[2], q[1])),
        LightKind::FacingDisk => {
            let [a, b] = facing_axes(record, from).map(|axis| dot(axis, v) / length(columns[0]));
            (a * a + b * b, turn(b, a))
        }
        _ => ((q[2] + 1.0) / 2.0, turn(q[1], q[0])),
    };
    let cell = |x: f64| ((x * bins as f64) as usize).min(bins - 1);
    cell(s) * bins + cell(t)
}

/// Expected share of each bin: the density `eval_hit` gives, integrated over the solid angle of the bin's surface; and how many of its elements are
/// drawn at all.
fn expected_shares(record: &LightRecord, table: &LightTable, p: [f32; 3], bins: usize, fine: usize) -> (Vec<f64>, usize) {
    let side = bins * fine;
    let mut hits = [Column::new(side * side), Column::new(side * side), Column::new(side * side)];
    let mut solid = vec![0.0; side * side];
    let origin = p.map(f64::from);
    for i in 0..side {
        for j in 0..side {
            let (wi, distance, angle) = seen(record, origin, (i as f64 + 0.5) / side as f64, (j as f64 + 0.5) / side as f64);
            solid[i * side + j] = angle / (side * side) as f64;
            for k in 0..3 {
                hits[k][i * side + j] = (origin[k] + wi[k] * distance) as f32;
            }
        }
    }
    let mut pdf = Column::new(side * side);
    densities(One, table, p, &hits, &mut pdf);
    let mut shares = vec![0.0; bins * bins];
    for i in 0..side {
        for j in 0..side {
            shares[i / fine * bins + j / fine] += f64::from(pdf[i * side + j]) * solid[i * side + j];
        }
    }
    let drawn_from = pdf.iter().zip(&solid).filter(|(pdf, solid)| **pdf * **solid as f32 > 0.0).count();
    (shares, drawn_from)
}

#[test]
fn samples_are_distributed_by_their_density() {
    const BINS: usize = 12;
    // Of what a beam's edge leaves less of, the grid is too coarse an image.
    const FEWEST_ELEMENTS: usize = 4000;
    let count = 1 << 16;
    for record in lights() {
        let record = LightRecord { shaping: Shaping::default(), spot: None, ..record };
        let table = LightTable::build(&[record], NO_IMAGES, &[]);
        for p in POINTS {
            // The expectation's own error: the edge of the visible side, or of the beam's foot.
            let edge = if record.spread < 3.0 { 0.03 } else { 0.01 };
            let (shares, elements) = expected_shares(&record, &table, p, BINS, 64);
            if elements > 0 && elements < FEWEST_ELEMENTS {
                continue;
            }
            let drawn = draw(Execution::best(), &table, p, [0.0, 0.0, 1.0], &numbers(5, count));
            let mut observed = vec![0.0; BINS * BINS];
            let mut alive = 0.0;
            for i in 0..count {
                if drawn.pdf[i] > 0.0 {
                    let (wi, distance) = (drawn.direction(i), f64::from(drawn.distance[i]));
                    let point = [0, 1, 2].map(|k| f64::from(p[k]) + wi[k] * distance);
                    observed[bin_of(&record, p.map(f64::from), point, BINS)] += 1.0;
                    alive += 1.0;
                }
            }
            let total: f64 = shares.iter().sum();
            // What is not drawn at all is drawn on the far side, which the density leaves out; the visible side's edge costs the expectation digits.
            let deviation = (total * (1.0 - total).max(0.0) / count as f64).sqrt();
            let case = format!("{:?} {:?} from {p:?}", record.kind, record.to_world);
            assert!(
                (alive / count as f64 - total).abs() < 5.0 * deviation + 0.5 * edge,
                "{case}: {} drawn, {total} expected",
                alive / count as f64
            );
            let (mut chi, mut cells) = (0.0, 0);
            for (share, seen) in shares.iter().zip(&observed) {
                let expected = share / total * alive;
                if expected > 8.0 {
                    chi += (seen - expected).powi(2) / (expected + (edge * expected).powi(2));
                    cells += 1;
                }
            }
            // Wilson and Hilferty's normal approximation; 1 − 1e-6 one-sided.
            let k = f64::from(cells.max(2));
            let z = ((chi / k).cbrt() - (1.0 - 2.0 / (9.0 * k))) / (2.0 / (9.0 * k)).sqrt();
            assert!(alive == 0.0 || z < 4.75, "{case}: chi-square {chi} over {cells} cells (z = {z})");
        }
    }
}

#[test]
fn all_levels_agree_with_the_scalar_one() {
    let mut records = lights();
    records.push(LightRecord { angle: 0.3, ..light(LightKind::Distant, turned([1.0; 3], [0.2, 0.1, 0.0]), [0.0; 3]) });
    records.push(LightRecord::new(LightKind::Dome));
    records.push(light(LightKind::Point, turned([1.0; 3], [0.0; 3]), [1.0, 1.0, 1.0]));
    let table = LightTable::build(&records, NO_IMAGES, &[]);
    let count = 1 << 12;
    let u = numbers(2, count);
    for p in POINTS {
        let scalar = draw(Execution::Scalar, &table, p, narrow([0.0, 0.0, 1.0]), &u);
        for execution in Execution::all() {
            let wide = draw(execution, &table, p, [0.0, 0.0, 1.0], &u);
            let mut different = 0;
            for i in 0..count {
                let close = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(1e-3);
                let same = wide.light[i] == scalar.light[i]
                    && close(scalar.pdf[i], wide.pdf[i])
                    && (0..3).all(|k| close(scalar.radiance[k][i], wide.radiance[k][i]) && close(scalar.wi[k][i], wide.wi[k][i]));
                different += usize::from(!same);
            }
            // Roundings tip a choice here and there.
            assert!(different <= count / 500, "{}: {different} of {count} samples differ from {p:?}", execution.name());
        }
    }
}
