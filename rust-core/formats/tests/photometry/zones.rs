//! CIE flux codes and the luminaire classification system's zones against closed forms.

use crate::{close, ies_text, steps, type_c};
use gonio_formats::photometry::{Bug, Goniogram, Zones, ies};
use std::f64::consts::PI;

/// 1000 lm that leave by Lambert's law.
fn lambertian() -> Goniogram {
    type_c(&steps(0.0, 90.0, 900), &[0.0], |_, gamma| 1000.0 / PI * gamma.to_radians().cos())
}

#[test]
fn flux_codes_of_a_cosine() {
    // sin² of 41.4° (cos 3/4), 60° and 75.5° (cos 1/4): 7/16, 3/4, 15/16.
    let codes = lambertian().flux_codes().unwrap();
    for (found, expected) in codes.iter().zip([7.0 / 16.0, 0.75, 15.0 / 16.0, 1.0, 1.0]) {
        close(*found, expected, 1e-5);
    }
    let globe = type_c(&[0.0, 180.0], &[0.0], |_, _| 100.0).flux_codes().unwrap();
    for (found, expected) in globe.iter().zip([0.25, 0.5, 0.75, 0.5, 1.0]) {
        close(*found, expected, 1e-9);
    }
    assert_eq!(type_c(&[0.0, 90.0], &[0.0], |_, _| 0.0).flux_codes(), None);
    let relative = ies_text("IESNA:LM-63-2002", "1 2000 1 V H 1 2 0 0 0", "1 1 20", &[0.0, 180.0], &[0.0], |_, _| 1000.0 / (4.0 * PI));
    close(ies::read(relative.as_bytes()).unwrap().flux_codes().unwrap()[4], 0.5, 1e-9);
}

#[test]
fn zones_of_a_cosine() {
    let zones = lambertian().zones(0.0);
    // Half of 1000 lm · (sin² of the one end − sin² of the other).
    let share = |from: f64, to: f64| 500.0 * (to.to_radians().sin().powi(2) - from.to_radians().sin().powi(2));
    for (k, [from, to]) in [[0.0, 30.0], [30.0, 60.0], [60.0, 80.0], [80.0, 90.0]].into_iter().enumerate() {
        close(zones.forward[k], share(from, to), 1e-4);
        close(zones.back[k], share(from, to), 1e-4);
    }
    assert_eq!(zones.up, [0.0; 2]);
    // 125, 250, 110, 15 lm: low 125 is rating 1, mid 250 is 1; very high 15 is 1.
    assert_eq!(zones.rating(false), Bug { backlight: 1, uplight: 0, glare: 1 });
    assert_eq!(zones.rating(true).to_string(), "B1 U0 G1");
}

#[test]
fn front_and_back_are_told_apart() {
    // All light within 90° of C0, and so of C90 turned by a quarter.
    let c0 = |c: f64, _: f64| if c.to_radians().cos() > 1e-9 { 100.0 * c.to_radians().cos() } else { 0.0 };
    let goniogram = type_c(&[0.0, 45.0, 90.0], &steps(0.0, 360.0, 72), c0);
    let zones = goniogram.zones(0.0);
    assert!(zones.back.iter().all(|lumens| lumens.abs() < 1e-9) && zones.forward[1] > 10.0);
    let turned = goniogram.rotated(90.0).zones(90.0);
    (0..4).for_each(|k| close(turned.forward[k], zones.forward[k], 1e-9));
    let behind = goniogram.zones(180.0);
    (0..4).for_each(|k| close(behind.back[k], zones.forward[k], 1e-9));
    let all: f64 = zones.forward.iter().chain(&zones.back).chain(&zones.up).sum();
    close(all, goniogram.flux(), 1e-9);
    assert!(!goniogram.is_square() && lambertian().is_square());
}

#[test]
fn ratings_are_those_of_the_worst_zone() {
    let quiet = Zones::default();
    let rated = |zones: Zones| zones.rating(false);
    assert_eq!(rated(quiet), Bug { backlight: 0, uplight: 0, glare: 0 });
    assert_eq!(rated(Zones { back: [0.0, 2500.0, 0.0, 0.0], ..quiet }).backlight, 2);
    assert_eq!(rated(Zones { back: [0.0, 8501.0, 0.0, 0.0], ..quiet }).backlight, 5);
    assert_eq!(rated(Zones { up: [0.0, 0.2], ..quiet }).uplight, 1);
    assert_eq!(rated(Zones { up: [501.0, 0.0], ..quiet }).uplight, 4);
    assert_eq!(rated(Zones { forward: [0.0, 0.0, 7000.0, 90.0], ..quiet }).glare, 3);
    // Behind a street luminaire 1200 lm in the high zone are rating 3, of a symmetric one 1.
    let behind = Zones { back: [0.0, 0.0, 1200.0, 0.0], ..quiet };
    assert_eq!((behind.rating(false).glare, behind.rating(true).glare), (3, 1));
}
