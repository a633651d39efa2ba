//! Openings of places and directions that are known.

use super::{Departure, Opening};
use gonio_formats::photometry::OpeningShape;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Fractions without visible order: multiples of roots of two and three (Weyl).
fn fractions(i: usize) -> [f64; 4] {
    [2.0_f64, 3.0, 5.0, 7.0].map(|number| (i as f64 * number.sqrt()).fract())
}

/// A direction about a unit vector along z, by the cosine law.
fn lambertian([u, v]: [f64; 2]) -> [f64; 3] {
    let (sin, cos) = (u.sqrt(), (1.0 - u).sqrt());
    [sin * (TAU * v).cos(), sin * (TAU * v).sin(), cos]
}

/// Light from places that look down.
fn down(place: impl Fn([f64; 2]) -> Option<[f64; 3]>) -> Vec<Departure> {
    let one = |i: usize| {
        let [a, b, u, v] = fractions(i);
        let [x, y, z] = lambertian([u, v]);
        Some(Departure { place: place([a, b])?, direction: [x, y, -z] })
    };
    (1..30_000).filter_map(one).collect()
}

fn near(found: f64, expected: f64, share: f64) {
    assert!((found - expected).abs() <= share * expected.abs(), "{found} instead of {expected}");
}

#[test]
fn disks_are_round_and_squares_are_not() {
    let in_disk = |[a, b]: [f64; 2]| [0.5 * a.sqrt() * (TAU * b).cos(), 0.5 * a.sqrt() * (TAU * b).sin(), -0.5];
    let disk = Opening::of(&down(|place| Some(in_disk(place))));
    let [x, y, z] = disk.size();
    assert!(disk.is_round() && disk.shape.shape == OpeningShape::Disk && z == 0.0, "{disk:?}");
    near(x, 1.0, 0.03);
    near(y, 1.0, 0.03);
    near(disk.area, FRAC_PI_4, 0.03);
    let square = Opening::of(&down(|[a, b]| Some([2.0 * a - 1.0, 2.0 * b - 1.0, 0.2])));
    assert!(!square.is_round() && square.shape.shape == OpeningShape::Rectangle, "{square:?}");
    near(square.size()[0], 2.0, 0.01);
    near(square.centre()[2], 0.2, 1e-3);
    near(square.area, 4.0, 0.01);
}

#[test]
fn a_point_has_no_size() {
    let point = Opening::of(&down(|_| Some([0.1, 0.2, 0.3])));
    assert_eq!((point.size(), point.shape.shape), ([0.0; 3], OpeningShape::Point));
    near(point.centre()[1], 0.2, 1e-3);
    assert_eq!(Opening::of(&[]), Opening::default());
}

#[test]
fn light_from_within_leaves_by_the_mouth() {
    // From the back of a box whose one open side is 0.3 m below: what does not pass the mouth stays within.
    let passing = |departure: &Departure| {
        let way = (departure.place[2] + 0.3) / -departure.direction[2];
        (0..2).all(|k| (departure.place[k] + way * departure.direction[k]).abs() < 0.25)
    };
    // Some of the walls' light defines how far down they reach.
    let mut light = down(|[a, b]| Some([0.5 * a - 0.25, 0.5 * b - 0.25, 0.0]));
    light.retain(passing);
    light.extend(
        down(|[a, b]| Some([0.25 * (if a < 0.5 { -1.0 } else { 1.0 }), 0.5 * b - 0.25, -0.3 * (2.0 * a).fract()]))
            .into_iter()
            .filter(passing),
    );
    let opening = Opening::of(&light);
    assert_eq!((opening.shape.shape, opening.size()[2]), (OpeningShape::Rectangle, 0.0), "{opening:?}");
    near(opening.centre()[2], -0.3, 0.01);
    near(opening.area, 0.25, 0.02);
}

#[test]
fn a_ring_has_the_area_of_a_ring() {
    let ring = |[a, b]: [f64; 2]| {
        let radius = (0.16 + 0.09 * a).sqrt();
        [radius * (TAU * b).cos(), radius * (TAU * b).sin(), 0.0]
    };
    let opening = Opening::of(&down(|place| Some(ring(place))));
    near(opening.size()[0], 1.0, 0.02);
    near(opening.area, 0.09 * PI, 0.05);
    near(opening.shape.projected_area([0.0, 0.0, -1.0]), 0.09 * PI, 0.05);
}

#[test]
fn parts_are_counted_apart() {
    for gap in [0.2, 1.0] {
        let two = |[a, b]: [f64; 2]| Some([(2.0 * a).fract() * 0.3 + if a < 0.5 { 0.0 } else { 0.3 + gap }, 0.4 * b, 0.0]);
        let opening = Opening::of(&down(two));
        assert_eq!(opening.parts.len(), 2, "{opening:?}");
        near(opening.area, 0.24, 0.02);
        near(opening.size()[0], 0.6 + gap, 0.01);
    }
}

#[test]
fn strays_are_no_part() {
    let mut light = down(|[a, b]| Some([a, b, 0.0]));
    let stray = |i: usize| Departure { place: [0.5, 0.5, -2.0 - i as f64], direction: [1.0, 0.0, 0.0] };
    light.extend((0..20).map(stray));
    let opening = Opening::of(&light);
    assert_eq!(opening.parts.len(), 1);
    near(opening.area, 1.0, 0.03);
}

#[test]
fn light_that_goes_up_does_not_widen_what_is_seen_from_below() {
    let square = |side: f64, z: f64| down(move |[a, b]| Some([side * (a - 0.5), side * (b - 0.5), z]));
    let upwards = |light: Vec<Departure>| light.into_iter().map(|ray| Departure { direction: ray.direction.map(|x| -x), ..ray });
    let both: Vec<Departure> = square(0.2, 0.0).into_iter().chain(upwards(square(0.4, 0.1))).collect();
    let opening = Opening::of(&both);
    near(opening.area, 0.04, 0.03);
    near(opening.shape.projected_area([0.0, 0.0, -1.0]), 0.04, 0.03);
    // Up alone there is nothing else.
    let up = Opening::of(&upwards(square(0.4, 0.1)).collect::<Vec<_>>());
    near(up.area, 0.16, 0.03);
    near(up.centre()[2], 0.1, 0.01);
}
