//! Roads and their mirror images; where a tilted luminaire points.

use super::{close, luminaire, road, row};
use crate::{Row, Side, line::Line};

/// The same on both sides of C90–C270, as street lanterns are; more to the street.
fn lantern(c: f64, gamma: f64) -> f64 {
    let across = c.to_radians().sin();
    200.0 + 3.0 * gamma * (1.5 + across) * f64::from(gamma < 80.0)
}

#[test]
fn what_stands_on_the_left_is_the_mirror_image() {
    let results = [Side::Right, Side::Left].map(|side| {
        let tilted = Row { tilt: 12.0, ..row(luminaire(lantern), side) };
        road(vec![tilted]).evaluate()
    });
    let [right, left] = &results;
    for (a, b) in [(right, left), (left, right)] {
        close(a.observers[0].l_av, b.observers[1].l_av, 1e-12);
        close(a.observers[0].veiling, b.observers[1].veiling, 1e-12);
        close(a.edges[0].ratio.expect("light"), b.edges[1].ratio.expect("light"), 1e-12);
        for (row, mirrored) in a.illuminance.iter().zip(b.illuminance.iter().rev()) {
            row.iter().zip(mirrored).for_each(|(value, other)| close(*value, *other, 1e-12));
        }
        for (row, mirrored) in a.observers[0].luminance.iter().zip(b.observers[1].luminance.iter().rev()) {
            row.iter().zip(mirrored).for_each(|(value, other)| close(*value, *other, 1e-12));
        }
    }
    close(right.l_av, left.l_av, 1e-12);
    assert_ne!(right.edges[0].ratio, right.edges[1].ratio);
}

#[test]
fn opposite_rows_are_even() {
    let results = road(vec![row(luminaire(lantern), Side::Opposite)]).evaluate();
    let [a, b] = &results.observers[..] else { panic!("two observers") };
    close(a.l_av, b.l_av, 1e-12);
    close(a.ul.expect("light"), b.ul.expect("light"), 1e-12);
    close(a.ti.expect("light"), b.ti.expect("light"), 1e-12);
    close(results.edges[0].outside, results.edges[1].outside, 1e-12);
}

#[test]
fn staggered_rows_are_two_rows_with_an_offset() {
    let staggered = road(vec![row(luminaire(lantern), Side::Staggered)]).evaluate();
    let left = Row { offset: 15.0, ..row(luminaire(lantern), Side::Left) };
    let two = road(vec![row(luminaire(lantern), Side::Right), left]).evaluate();
    assert_eq!(staggered.observers, two.observers);
    assert_eq!(staggered.illuminance, two.illuminance);
}

#[test]
fn tilt_turns_the_side_to_the_carriageway_up() {
    // Nothing goes to nadir, which a tilt by 30° moves to the carriageway.
    let hollow = luminaire(|_, gamma| gamma);
    for (side, y) in [(Side::Right, 1.0 + 8.0 * 30.0_f64.to_radians().tan()), (Side::Left, 6.0 - 8.0 * 30.0_f64.to_radians().tan())] {
        let road = road(vec![Row { tilt: 30.0, ..row(hollow.clone(), side) }]);
        let line = &Line::all(&road)[0];
        assert!(line.ray(0.0, [0.0, y, 0.0]).intensity < 1e-6);
        close(line.ray(0.0, [0.0, line.y, 0.0]).intensity, 30.0, 1e-9);
    }
}

#[test]
fn c0_lies_along_the_road_and_c90_across() {
    // A plane's number is its intensity: which plane points where.
    let planes = luminaire(|c, gamma| if gamma == 0.0 { 0.0 } else { 1.0 + c });
    let seen = |row: Row, to: [f64; 2]| {
        let road = road(vec![row]);
        let line = &Line::all(&road)[0];
        (line.ray(0.0, [to[0], line.y + to[1], 0.0]).intensity - 1.0).round()
    };
    let of = |side| Row { side, ..row(planes.clone(), side) };
    assert_eq!([[9.0, 0.0], [0.0, 9.0], [-9.0, 0.0], [0.0, -9.0]].map(|to| seen(of(Side::Right), to)), [0.0, 90.0, 180.0, 270.0]);
    assert_eq!([[9.0, 0.0], [0.0, 9.0], [-9.0, 0.0], [0.0, -9.0]].map(|to| seen(of(Side::Left), to)), [180.0, 270.0, 0.0, 90.0]);
    // An IES file's C0 faces the carriageway; a luminaire turned by 180° faces away from it.
    let front = |front, orientation| Row { front, orientation, ..of(Side::Right) };
    assert_eq!(seen(front(0.0, 0.0), [0.0, 9.0]), 0.0);
    assert_eq!(seen(front(90.0, 180.0), [0.0, 9.0]), 270.0);
    assert_eq!(seen(front(90.0, 30.0), [9.0, 0.0]), 330.0);
}
