//! Goniograms: values at and between tabulated angles, orientation, and the illuminance they give.

use super::harness::{NO_IMAGES, draw, light, numbers, uniform};
use crate::{AngularType, Goniogram, LightKind, LightTable};
use gonio_simd::{Column, Execution, Lanes, Vec3, dispatch};
use std::sync::Arc;

#[inline(always)]
fn factors<L: Lanes>(l: L, goniogram: &Goniogram, directions: &[Column; 3], out: &mut Column) {
    for at in (0..out.len()).step_by(L::COUNT) {
        let direction = Vec3::load(l, [&directions[0], &directions[1], &directions[2]], at);
        goniogram.factor(l, direction).store(out, at);
    }
}

/// Factors in some directions, at every level.
fn at_directions(goniogram: &Goniogram, directions: &[[f64; 3]]) -> Vec<Vec<f32>> {
    let room = directions.len().next_multiple_of(16);
    let columns: [Column; 3] = std::array::from_fn(|k| {
        let mut column = Column::new(room);
        column.iter_mut().zip(directions).for_each(|(x, direction)| *x = direction[k] as f32);
        column
    });
    let of_level = |execution: Execution| {
        let mut out = Column::new(room);
        dispatch!(execution, l => factors(l, goniogram, &columns, &mut out));
        out[..directions.len()].to_vec()
    };
    Execution::all().into_iter().map(of_level).collect()
}

/// The direction of two angles in degrees.
fn direction(angular_type: AngularType, horizontal: f64, vertical: f64) -> [f64; 3] {
    angular_type.direction(horizontal.to_radians(), vertical.to_radians())
}

#[test]
fn tabulated_angles_have_the_tabulated_factors() {
    let (planes, polar) = ([0.0, 10.0, 95.0, 180.0, 300.0, 360.0], [0.0, 5.0, 42.5, 90.0, 117.0, 180.0]);
    let across = [-90.0, -35.0, -3.0, 0.0, 20.0, 90.0];
    for (angular_type, horizontal, vertical) in
        [(AngularType::C, planes, polar), (AngularType::B, across, across), (AngularType::A, across, across)]
    {
        let mut values: Vec<f32> = (0..36).map(|i| 100.0 * uniform(3, i)).collect();
        if angular_type == AngularType::C {
            let (first, last) = values.split_at_mut(30);
            last.copy_from_slice(&first[..6]);
        }
        let goniogram = Goniogram::new(angular_type, &horizontal, &vertical, &values).expect("a table");
        // Angles at the poles name one direction for all of the others.
        let inner = |h: usize, v: usize| match angular_type {
            AngularType::C => (1..5).contains(&v),
            AngularType::B => (1..5).contains(&h),
            AngularType::A => (1..5).contains(&v),
        };
        let cells: Vec<(usize, usize)> = (0..36).map(|i| (i / 6, i % 6)).filter(|(h, v)| inner(*h, *v)).collect();
        let directions: Vec<[f64; 3]> =
            cells.iter().map(|(h, v)| direction(angular_type, f64::from(horizontal[*h]), f64::from(vertical[*v]))).collect();
        for found in at_directions(&goniogram, &directions) {
            for ((h, v), factor) in cells.iter().zip(found) {
                let expected = values[h * 6 + v];
                // A direction in single precision is off by an angle of a few ten-millionths, on slopes of up to 100 in 3 degrees.
                assert!((factor - expected).abs() < 2e-3, "{angular_type:?} {h} {v}: {factor} for {expected}");
            }
        }
    }
}

#[test]
fn nothing_is_sent_beyond_the_vertical_range() {
    let goniogram = Goniogram::new(AngularType::C, &[0.0, 360.0], &[0.0, 60.0], &[1.0; 4]).expect("a table");
    let directions = [0.0, 59.9, 60.1, 180.0].map(|polar| direction(AngularType::C, 77.0, polar));
    for found in at_directions(&goniogram, &directions) {
        assert_eq!(found, [1.0, 1.0, 0.0, 0.0]);
    }
}

#[test]
fn a_point_light_has_the_intensities_of_its_goniogram() {
    // C0 is the light's +x, nadir its −z: twice as strong on the side of +x.
    let (planes, polar) = ([0.0, 90.0, 180.0, 270.0, 360.0], [0.0, 90.0, 180.0]);
    let factors: Vec<f32> = [200.0, 150.0, 100.0, 150.0, 200.0].iter().flat_map(|x| [150.0, *x, 0.0]).collect();
    let goniogram = Arc::new(Goniogram::new(AngularType::C, &planes, &polar, &factors).expect("a table"));
    let mut record = light(LightKind::Point, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 0.0, 2.0]);
    (record.goniogram, record.radiance) = (Some(0), [1.0; 3]);
    let plain = light(LightKind::Point, record.to_world[..3].try_into().expect("axes"), [0.0, 0.0, -50.0]);
    let table = LightTable::build(&[record, plain], NO_IMAGES, &[goniogram]);
    for (p, expected) in
        [([0.0, 0.0, 0.0], 150.0 / 4.0), ([2.0, 0.0, 2.0], 200.0 / 4.0), ([-2.0, 0.0, 2.0], 100.0 / 4.0), ([0.0, 2.0, 2.0], 150.0 / 4.0)]
    {
        for execution in Execution::all() {
            let drawn = draw(execution, &table, p, [0.0; 3], &numbers(5, 64));
            let chosen: Vec<usize> = (0..64).filter(|i| drawn.light[*i] == 0).collect();
            assert!(!chosen.is_empty());
            for i in chosen {
                let [illuminance, ..] = drawn.colour(i);
                assert!((illuminance - expected).abs() < 1e-4 * expected, "{p:?}: {illuminance} for {expected}");
            }
        }
    }
}
