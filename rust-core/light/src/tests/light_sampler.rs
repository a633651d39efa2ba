//! Light selection.

use super::harness::NO_IMAGES;
use super::harness::{draw, light, numbers, seeing_all, turned, uniform};
use crate::{LightKind, LightRecord, LightTable, Shaping, Spot};
use gonio_simd::{Column, Execution, Lanes, One, Vec3, dispatch};

fn crowd(count: usize) -> Vec<LightRecord> {
    let kinds = [
        LightKind::Rectangle,
        LightKind::Disk,
        LightKind::Sphere,
        LightKind::Cylinder,
        LightKind::Point,
        LightKind::Distant,
        LightKind::Dome,
        LightKind::FacingDisk,
    ];
    (0..count)
        .map(|i| {
            let random = |k: u64| uniform(17, 16 * i as u64 + k);
            let axes = turned([0.1 + random(0), 0.1 + random(1), 0.2], [6.0 * random(2), 6.0 * random(3), 6.0 * random(4)]);
            let origin = [10.0 * random(5) - 5.0, 10.0 * random(6) - 5.0, 3.0 * random(7) + 0.5];
            let mut record = light(kinds[i % kinds.len()], axes, origin);
            record.angle = 0.1;
            record.radiance = [random(8) * random(9) * 10.0; 3];
            if i % 3 == 0 {
                record.shaping = Shaping { cone_angle: 0.7, softness: 0.5, ..Shaping::default() };
            }
            if i % 4 == 1 {
                record.spread = 0.4 + 2.0 * random(10);
            }
            if i % 5 == 2 {
                record.spot = Some(Spot { angle: 0.5 + 3.0 * random(11), blend: random(12), stretch: [1.0, 0.5 + random(13)] });
            }
            record
        })
        .collect()
}

#[inline(always)]
fn probabilities<L: Lanes>(l: L, table: &LightTable, points: &[Column; 3], sums: &mut Column) {
    for at in (0..sums.len()).step_by(L::COUNT) {
        let p = Vec3::load(l, [&points[0], &points[1], &points[2]], at);
        let from = seeing_all(l, [p, Vec3::splat(l, [0.0, 0.0, 1.0])]);
        let mut sum = l.f(0.0);
        for light in 0..table.len() as u32 {
            sum += table.light_pmf(l, None, &from, l.u(light));
        }
        sum.store(sums, at);
    }
}

#[test]
fn probabilities_add_up_to_one() {
    for count in [1, 2, 7, 40, 64, 65, 300] {
        let table = LightTable::build(&crowd(count), NO_IMAGES, &[]);
        let points = numbers(23, 64);
        let mut sums = Column::new(64);
        for execution in Execution::all() {
            dispatch!(execution, l => probabilities(l, &table, &points, &mut sums));
            for sum in sums.iter() {
                // A few lights may all look away from a point, and so may the parts of a set that as a whole does not.
                let lost = if count > 64 { 0.1 } else { 0.0 };
                assert!((1.0 - lost - 2e-5..1.0 + 2e-5).contains(sum) || (*sum == 0.0 && count < 7), "{count} lights: {sum}");
            }
        }
    }
}

#[test]
fn lights_are_drawn_as_often_as_their_probability_says() {
    for lights in [7usize, 64, 100] {
        let table = LightTable::build(&crowd(lights), NO_IMAGES, &[]);
        let count = 1 << 16;
        let drawn = draw(Execution::best(), &table, [0.5, 0.5, 0.0], [0.0, 0.0, 1.0], &numbers(29, count));
        let mut observed = vec![0.0f64; lights];
        for i in 0..count {
            observed[drawn.light[i] as usize] += 1.0;
        }
        let probability = |light: usize| {
            #[inline(always)]
            fn one<L: Lanes>(l: L, table: &LightTable, light: u32) -> f32 {
                let from = seeing_all(l, [[0.5, 0.5, 0.0], [0.0, 0.0, 1.0]].map(|v| Vec3::splat(l, v)));
                table.light_pmf(l, None, &from, l.u(light)).to_array()[0]
            }
            f64::from(one(One, &table, light as u32))
        };
        for (light, seen) in observed.iter().enumerate() {
            let p = probability(light);
            let deviation = (count as f64 * p * (1.0 - p)).sqrt();
            // A draw that found no light names any light, with probability 0.
            if p == 0.0 {
                continue;
            }
            assert!(
                (seen - count as f64 * p).abs() < 5.0 * deviation + 3.0,
                "light {light} of {lights}: {seen} drawn, {} expected",
                count as f64 * p
            );
        }
    }
}

#[test]
fn many_lights_give_the_sum_of_their_illuminances() {
    let n = [0.0, 0.0, 1.0];
    let p = [0.5, -0.7, 0.0];
    for count in [20, 90] {
        let records: Vec<LightRecord> = crowd(count)
            .into_iter()
            .filter(|r| matches!(r.kind, LightKind::Rectangle | LightKind::Disk | LightKind::Sphere | LightKind::Cylinder))
            .collect();
        let expected: f64 = records.iter().map(|r| super::shape::illuminance(r, p.map(f64::from), n.map(f64::from), 200)[1]).sum();
        let table = LightTable::build(&records, NO_IMAGES, &[]);
        let samples = 1 << 18;
        let drawn = draw(Execution::best(), &table, p, n, &numbers(31, samples));
        let (mean, error) = super::harness::estimate(&drawn, n.map(f64::from), samples);
        assert!((mean[1] - expected).abs() < 4.9 * error[1] + 2e-3 * expected, "{count}: {} ± {} for {expected}", mean[1], error[1]);
    }
}

/// Small lamps in rows under a ceiling.
pub(super) fn hall(rows: usize) -> Vec<LightRecord> {
    let lamp = |i: usize| {
        light(
            LightKind::Rectangle,
            [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 1.0]],
            [2.0 * (i % rows) as f32, 2.0 * (i / rows) as f32, 3.0],
        )
    };
    (0..rows * rows).map(lamp).collect()
}

/// Relative variance of the illuminance that one sample gives, with nothing in the way.
fn relative_variance(records: &[LightRecord], p: [f32; 3]) -> f64 {
    let samples = 1 << 16;
    let drawn = draw(Execution::best(), &LightTable::build(records, NO_IMAGES, &[]), p, [0.0, 0.0, 1.0], &numbers(37, samples));
    let (mean, error) = super::harness::estimate(&drawn, [0.0, 0.0, 1.0], samples);
    (error[1] / mean[1]).powi(2) * samples as f64
}

#[test]
fn a_tree_of_many_lamps_leaves_little_noise() {
    let lamps = hall(60);
    for p in [[59.3, 59.1, 0.0], [58.2, 60.9, 1.0], [75.0, 51.0, 0.7]] {
        // Each lamp as likely as the next would give more than a hundred.
        assert!(relative_variance(&lamps, p) < 1.0, "{p:?}: {}", relative_variance(&lamps, p));
    }
}
