//! Roads whose light is known in closed form.

use super::{close, luminaire, road, row};
use crate::{
    Side,
    illuminance::{Measurand, illuminance},
    line::Line,
};
use std::f64::consts::PI;

#[test]
fn one_isotropic_lamp() {
    let road = road(vec![crate::Row { spacing: 500.0, ..row(luminaire(|_, _| 1000.0), Side::Right) }]);
    let lines = Line::all(&road);
    let at = |measurand| illuminance(&lines, &road.reach, [6.0, 4.0], measurand) / 0.8;
    // The lamp stands 6 m behind, 3 m to the right, 8 m and 6.5 m above.
    let (flat, square) = (45.0_f64.sqrt(), 45.0_f64 + 64.0);
    close(at(Measurand::Horizontal), 1000.0 * 8.0 / square.powf(1.5), 1e-12);
    close(at(Measurand::Hemispherical), 1000.0 * (1.0 + 8.0 / square.sqrt()) / 4.0 / square, 1e-12);
    let square = 45.0_f64 + 6.5 * 6.5;
    for (facing, towards) in [(1.0, -6.0), (-1.0, 6.0)] {
        close(at(Measurand::Semicylindrical(facing)), 1000.0 * (flat + towards) / PI / square.powf(1.5), 1e-12);
    }
    assert_eq!(at(Measurand::Vertical(1.0)), 0.0);
    close(at(Measurand::Vertical(-1.0)), 1000.0 * 6.0 / square.powf(1.5), 1e-12);
}

#[test]
fn a_lambertian_road_has_luminance_by_its_illuminance() {
    let skew = luminaire(|c, gamma| 300.0 + 2.0 * gamma + 100.0 * (c.to_radians() + 0.3).sin());
    let road = road(vec![crate::Row { spacing: 40.0, tilt: 10.0, ..row(skew, Side::Staggered) }]);
    let lines = Line::all(&road);
    let seen = road.seen(&lines, &road.surface, [-60.0, 1.75]);
    // With 5 heights ahead in the place of 12 the same luminaires count for both.
    let near = crate::Reach { luminance: [5.0, 5.0, 5.0], ..road.reach };
    let near = crate::luminance::Seen { reach: &near, ..seen };
    for [x, y] in [[10.0, 0.5], [12.0, 6.0], [27.0, 3.0]] {
        let lux = illuminance(&lines, &road.reach, [x, y], Measurand::Horizontal);
        let [maintained, initial] = near.luminance([x, y]);
        close(maintained, 0.2 * lux / PI, 1e-12);
        close(initial, maintained / 0.8, 1e-12);
    }
}

#[test]
fn an_endless_row_lights_as_a_line() {
    let mut road = road(vec![crate::Row { spacing: 10.0, ..row(luminaire(|_, _| 1000.0), Side::Right) }]);
    road.reach.illuminance = 400.0;
    let results = road.evaluate();
    // Along a line, I H / S ∫ dx / (x² + a² + H²)^(3/2) = 2 I H / S / (a² + H²).
    let line = |y: &f64| 0.8 * 2.0 * 1000.0 * 8.0 / 10.0 / ((y - 1.0).powi(2) + 64.0);
    for (y, values) in results.illuminance_y.iter().zip(&results.illuminance) {
        close(values.iter().sum::<f64>() / values.len() as f64, line(y), 1e-5);
    }
    close(results.illuminances.e_av, results.illuminance_y.iter().map(line).sum::<f64>() / 5.0, 1e-5);
}

#[test]
fn points_are_as_many_as_the_norm_says() {
    for (spacing, along) in [(10.0, 10), (30.0, 10), (30.1, 11), (33.0, 11), (48.0, 16), (50.0, 17)] {
        let road = road(vec![crate::Row { spacing, ..row(luminaire(|_, _| 1000.0), Side::Right) }]);
        let results = road.evaluate();
        assert_eq!((results.field.along, results.field.across), (along, 6));
        assert_eq!(results.illuminance_y.len(), 5);
        close(results.x[0], spacing / along as f64 / 2.0, 1e-12);
        close(results.luminance_y[1], 1.75, 1e-12);
    }
}

#[test]
fn the_drivers_view_has_the_same_numbers() {
    let road = road(vec![row(luminaire(|_, _| 1000.0), Side::Opposite)]);
    let results = road.evaluate();
    let view = crate::sheet::view(&road, &results, 2);
    for value in results.observers[1].luminance.iter().flatten() {
        assert!(view.contains(&format!(">{}</text>", gonio_formats::short_number(*value))), "{value}");
    }
    assert_eq!(view.matches("<polygon").count(), 1 + results.field.along * results.field.across);
    assert!(!view.contains("NaN") && !view.contains("inf"));
    assert!(!crate::sheet::view(&road, &results, 9).contains("<polygon"));
}

#[test]
fn the_first_class_that_is_met_is_told() {
    use crate::{Class, Requirement};
    let mut road = road(vec![row(luminaire(|_, _| 1000.0), Side::Opposite)]);
    let [l_av, ti] = [road.evaluate().l_av, road.evaluate().ti.expect("glare")];
    let class = |name: &str, l_av: f64, ti: f64| {
        let required = vec![Requirement { key: "l_av", value: l_av }, Requirement { key: "ti", value: ti }];
        Class { name: name.into(), required }
    };
    road.classes = vec![class("A", 1.1 * l_av, ti), class("B", l_av, 0.9 * ti), class("C", l_av, ti), class("D", 0.5 * l_av, ti)];
    let results = road.evaluate();
    assert_eq!(results.class.as_deref(), Some("C"));
    assert_eq!(results.classes.iter().map(|class| class.met).collect::<Vec<_>>(), [false, false, true, true]);
    // Classes are no requirement.
    assert_eq!(results.met, None);
    let lines = crate::text::lines(&results);
    assert!(lines.contains(&"class: C".to_owned()) && lines.iter().any(|line| line.starts_with("class B: ti")), "{lines:?}");
}

#[test]
fn power_and_energy() {
    let mut road = road(vec![row(luminaire(|_, _| 1000.0), Side::Opposite)]);
    road.periods = vec![crate::Period { hours: 2000.0, level: 1.0 }, crate::Period { hours: 2000.0, level: 0.5 }];
    let results = road.evaluate();
    let energy = results.energy.expect("power is known");
    close(energy.power_w_per_km, 4000.0, 1e-12);
    close(energy.pdi.expect("there is light"), 1000.0 * 120.0 / (210.0 * results.illuminances.e_av), 1e-12);
    close(energy.aeci, 120.0 * 3000.0 / 210.0 / 1000.0, 1e-12);
    road.rows[0].power = None;
    assert_eq!(road.evaluate().energy, None);
}
