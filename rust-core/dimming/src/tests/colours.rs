//! Correlated colour temperatures of mixed light.

use super::{super::*, problem};

/// Warm, cool and green light of a chromaticity x, y.
fn light(lux: f64, [x, y]: [f64; 2]) -> Light {
    let exact = |value: f64| Estimate::new(value, 0.0);
    Light { lux: exact(lux), x: exact(x / y), z: exact((1.0 - x - y) / y) }
}

#[test]
fn two_lamps_mix_to_a_colour_temperature() {
    // Blackbodies of 2700 and 6500 K. For the mixture's chromaticity: tristimulus values add up.
    let [warm, cool] = [[0.4599, 0.4106], [0.3135, 0.3236]];
    let mut asked = problem(&[10.0, 10.0], &[&[800.0, 800.0, 0.0]], &["Plane.mean=600+-0.001", "Plane.cct=4000+-1"]);
    asked.areas[0].colours = vec![Colour { fixed: Light::default(), of_groups: vec![light(800.0, warm), light(800.0, cool)] }];
    let found = asked.solve().expect("a dimming");
    let [a, b] = [found.levels[0], found.levels[1]];
    assert!((a + b - 0.75).abs() < 1e-5 && (found.targets[1].reached - 4000.0).abs() < 1.1, "{found:?}");
    let xyz = |[x, y]: [f64; 2], level: f64| [x / y, 1.0, (1.0 - x - y) / y].map(|part| part * level * 800.0);
    let sum: [f64; 3] = std::array::from_fn(|k| xyz(warm, a)[k] + xyz(cool, b)[k]);
    let (kelvin, _) = gonio_spectrum::cct_of_xyz(sum).expect("white light");
    assert!((kelvin - found.targets[1].reached).abs() < 1e-6 && found.meets_all());
    // Warm light that stays takes its part; limits to one side.
    asked.areas[0].colours[0].fixed = light(100.0, warm);
    asked.areas[0].points[0].fixed = Estimate::new(100.0, 0.0);
    asked.targets[1] = Target::parse("Plane.cct>=4000").expect("a target");
    let found = asked.solve().expect("a dimming");
    assert!(found.levels[0] < a && found.targets[1].reached > 3999.9, "{found:?}");
    asked.targets[1] = Target::parse("Plane.cct<=2000").expect("a target");
    let found = asked.solve().expect("a dimming");
    assert_eq!(found.targets[1].verdict, Verdict::NotMet);
}

#[test]
fn light_that_is_not_white_has_no_temperature() {
    let mut asked = problem(&[10.0], &[&[800.0, 0.0]], &["Plane.mean>=600", "Plane.cct>=3000"]);
    assert!(asked.solve().expect_err("no colour").to_string().contains("was not measured"));
    asked.areas[0].colours = vec![Colour { fixed: Light::default(), of_groups: vec![light(800.0, [0.2, 0.7])] }];
    let found = asked.solve().expect("a dimming");
    assert!(found.targets[1].reached.is_nan() && found.targets[1].verdict == Verdict::NotMet);
}

#[test]
fn errors_of_amounts_and_of_colours_make_those_of_temperatures() {
    let [warm, cool] = [[0.4599, 0.4106], [0.3135, 0.3236]];
    let noisy = |chromaticity, error| Light { lux: Estimate::new(400.0, error), ..light(400.0, chromaticity) };
    let mut asked = problem(&[10.0, 10.0], &[&[400.0, 400.0, 0.0]], &["Plane.cct>=2000"]);
    asked.areas[0].colours = vec![Colour { fixed: Light::default(), of_groups: vec![noisy(warm, 4.0), noisy(cool, 0.0)] }];
    let of = |problem: &Problem| problem.at(vec![1.0, 1.0]).expect("levels").targets[0].clone();
    let (found, shift) = (of(&asked), {
        let mut more = asked.clone();
        more.areas[0].colours[0].of_groups[0].lux.value += 4.0;
        of(&more)
    });
    // One standard error more of the warm light shifts the temperature by one of its own.
    assert!(((found.reached - shift.reached) / found.error - 1.0).abs() < 0.02, "{found:?} {shift:?}");
}

#[test]
fn temperatures_are_read() {
    assert_eq!(Target::parse("Desk.cct=4000+-100").map(|target| target.limit), Ok(Limit::Cct(4000.0, 100.0)));
    for (text, told) in [("Desk.cct=4000", "tolerance"), ("Desk.cct>=500", "from 1000 to 25000 K")] {
        assert!(Target::parse(text).expect_err(text).to_string().contains(told));
    }
}
