//! The threshold increment.

use super::{close, luminaire, road, row};
use crate::{
    Side,
    glare::{increment, veiling},
    line::Line,
};

#[test]
fn one_lamp_veils_by_the_formula() {
    let far = crate::Row { spacing: 500.0, overhang: 1.75, ..row(luminaire(|_, _| 1000.0), Side::Right) };
    let road = road(vec![far]);
    let field = crate::Field { along: 1, ..road.evaluate().field };
    let [found, x] = veiling(&Line::all(&road), &field, 1.75, 23.0);
    // The observer's first place, 2.75 × 6.5 m before the lamp; the next lamp is out of reach.
    close(x, -17.875, 1e-12);
    let angle = (6.5_f64 / 17.875).atan() + 1.0_f64.to_radians();
    let lux = 1000.0 * angle.cos() / (17.875_f64.powi(2) + 6.5 * 6.5);
    close(found, 9.86 * (1.0 + (23.0_f64 / 66.4).powi(4)) * lux / angle.to_degrees().powi(2), 1e-12);
}

#[test]
fn a_roof_screens_lamps_above_20_degrees() {
    let mut near = crate::Row { spacing: 500.0, ..row(luminaire(|_, _| 1000.0), Side::Right) };
    let seen = |row: &crate::Row, before: f64| {
        let road = road(vec![row.clone()]);
        let field = crate::Field { start: 0.0, length: 500.0, height: 1.5 + before / 2.75, along: 1, across: 6 };
        veiling(&Line::all(&road), &field, 1.75, 23.0)[0]
    };
    let limit = 6.5 / 20.0_f64.to_radians().tan();
    assert!(seen(&near, limit + 0.01) > 0.0);
    assert_eq!(seen(&near, limit - 0.01), 0.0);
    near.height = 5.0;
    assert!(seen(&near, limit - 0.01) > 0.0);
}

#[test]
fn increments_follow_the_luminance() {
    assert_eq!(increment(0.1, 0.05), None);
    close(increment(0.1, 1.0).expect("a formula"), 6.5, 1e-12);
    close(increment(0.1, 5.0).expect("a formula"), 6.5 / 5.0_f64.powf(0.8), 1e-12);
    close(increment(0.1, 10.0).expect("a formula"), 9.5 / 10.0_f64.powf(1.05), 1e-12);
}
