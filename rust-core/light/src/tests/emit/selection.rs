//! Which lights send.

use super::cases::{AT, finite, infinite, table};
use super::harness::shoot;
use crate::tests::harness::{light, turned};
use crate::{EmissionSampler, LightKind, LightRecord};
use gonio_simd::Execution;

const SCENE: ([f32; 3], f32) = ([0.0; 3], 5.0);

#[test]
fn what_sends_nothing_is_never_chosen() {
    let good = light(LightKind::Point, turned([1.0; 3], [0.0; 3]), AT);
    let rectangle = light(LightKind::Rectangle, turned([1.0; 3], [0.0; 3]), AT);
    let records = [
        LightRecord { radiance: [0.0; 3], ..good },
        LightRecord { radiance: [f32::NAN; 3], ..good },
        LightRecord { portal: true, ..rectangle },
        LightRecord { visible_to_scattered: false, ..good },
        light(LightKind::Disk, [[0.0; 3]; 3], AT),
        LightRecord { to_world: [[f32::NAN; 3]; 4], ..rectangle },
        good,
    ];
    let table = table(&records);
    let sampler = EmissionSampler::new(&table, None, SCENE, &[]);
    assert!(!sampler.is_empty());
    let rays = shoot(Execution::best(), &sampler, &table, 1, 4096);
    assert!(rays.light.iter().all(|light| *light == 6) && rays.flux[1].iter().all(|x| *x > 0.0));
    for light in 0..6 {
        assert_eq!(sampler.power(light), [0.0; 3]);
    }
    let none = EmissionSampler::new(&table, Some(&[0, 1, 2, 3, 4, 5, 99]), SCENE, &[]);
    assert!(none.is_empty() && none.total_power() == [0.0; 3]);
    let rays = shoot(Execution::best(), &none, &table, 1, 64);
    assert!(rays.flux.iter().all(|column| column.iter().all(|x| *x == 0.0)));
}

#[test]
fn lights_are_chosen_by_power_and_the_weak_are_not_starved() {
    let lamp = |k: usize| {
        let strength = if k == 7 { 1e4 } else { 0.01 + (k % 5) as f32 };
        LightRecord { radiance: [strength; 3], ..light(LightKind::Point, turned([1.0; 3], [0.0; 3]), [k as f32, 0.0, 1.0]) }
    };
    let records: Vec<LightRecord> = (0..3000).map(lamp).collect();
    let table = table(&records);
    let wanted: Vec<u32> = (0..3000).step_by(7).collect();
    let count = 1 << 17;
    for lights in [None, Some(&wanted[..])] {
        let sampler = EmissionSampler::new(&table, lights, SCENE, &[]);
        let rays = shoot(Execution::best(), &sampler, &table, 1, count);
        let mut sent = vec![0.0; 3000];
        for i in 0..count {
            assert!(lights.is_none_or(|lights| lights.contains(&rays.light[i])));
            sent[rays.light[i] as usize] += f64::from(rays.flux[1][i]) / count as f64;
        }
        let (total, expected) = (sent.iter().sum::<f64>(), sampler.total_power()[1]);
        assert!((total / expected - 1.0).abs() < 0.02, "{total} for {expected}");
        assert!((sent[7] / sampler.power(7)[1] - 1.0).abs() < 0.02, "the strong one: {} for {}", sent[7], sampler.power(7)[1]);
        let weak: f64 = sent.iter().enumerate().filter(|(k, _)| *k != 7).map(|(_, x)| x).sum();
        let expected = expected - sampler.power(7)[1];
        assert!((weak / expected - 1.0).abs() < 0.05, "the weak ones: {weak} for {expected}");
    }
}

#[test]
fn rays_start_on_the_right_side() {
    for case in finite().iter().chain(&infinite()) {
        let table = table(&[case.record]);
        for targets in [&[][..], &[([0.4f32, 0.3, 0.7], 0.5f32)][..]] {
            let sampler = EmissionSampler::new(&table, None, SCENE, targets);
            let rays = shoot(Execution::best(), &sampler, &table, 9, 2048);
            for i in (0..2048).filter(|i| rays.flux[1][*i] > 0.0) {
                let [o, n, w] = [&rays.origin, &rays.normal, &rays.direction].map(|v| super::harness::triple(v, i));
                let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                let has_normal = !matches!(case.record.kind, LightKind::Point | LightKind::Distant | LightKind::Dome);
                assert!((dot(w, w) - 1.0).abs() < 1e-5, "{}", case.name);
                assert!((dot(n, n) - if has_normal { 1.0 } else { 0.0 }).abs() < 1e-5, "{}: normal {n:?}", case.name);
                assert!(!has_normal || dot(n, w) > 0.0, "{}: {n:?} {w:?}", case.name);
                assert!(!case.record.kind.is_infinite() || dot(o, o) > 25.0, "{}: starts inside", case.name);
                assert!(rays.clear[i] == 0.0 || case.record.kind == LightKind::FacingDisk, "{}", case.name);
            }
        }
    }
}
