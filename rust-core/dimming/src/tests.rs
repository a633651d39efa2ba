//! Closed forms, and corners of small programs one by one.

mod colours;

use super::*;

fn group(name: &str, watts: f64) -> Group {
    Group { name: name.into(), watts, range: [0.0, 1.0] }
}

/// A problem whose points get so much of each group; the last number is fixed.
fn problem(watts: &[f64], points: &[&[f64]], targets: &[&str]) -> Problem {
    let point = |values: &&[f64]| {
        let all: Vec<Estimate> = values.iter().map(|value| Estimate::new(*value, 0.0)).collect();
        let (fixed, of_groups) = all.split_last().expect("a fixed part");
        Point { fixed: *fixed, of_groups: of_groups.to_vec() }
    };
    Problem {
        groups: watts.iter().enumerate().map(|(k, watts)| group(&format!("g{k}"), *watts)).collect(),
        areas: vec![Area { name: "/Room/Plane".into(), points: points.iter().map(point).collect(), colours: Vec::new() }],
        targets: targets.iter().map(|text| Target::parse(text).expect("a target")).collect(),
        goal: Goal::LeastPower,
        errors_kept: 0.0,
    }
}

fn close(found: &[f64], expected: &[f64]) {
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}, not {expected:?}");
}

#[test]
fn the_group_of_most_light_a_watt_comes_first() {
    // 400 lx for 20 W are better than 300 lx for 30 W: g0 whole, and 100 lx of g1.
    let found = problem(&[20.0, 30.0], &[&[400.0, 300.0, 0.0]], &["Plane.mean>=500"]).solve().expect("a dimming");
    close(&found.levels, &[1.0, 1.0 / 3.0]);
    close(&[found.watts, found.targets[0].reached], &[30.0, 500.0]);
    assert_eq!(found.targets[0].verdict, Verdict::Met);
    // Daylight does its part.
    let found = problem(&[20.0, 30.0], &[&[400.0, 300.0, 300.0]], &["Plane.mean>=500"]).solve().expect("a dimming");
    close(&found.levels, &[0.5, 0.0]);
}

#[test]
fn uniformity_is_linear_in_levels() {
    // Points get (4 a + b, a + 4 b) · 100, a costs less. min ≥ 0.8 mean: a + 4 b ≥ 2 (a + b), so b = a / 2; mean = 250 (a + b) = 300: a = 0.8,
    // b = 0.4.
    let points: [&[f64]; 2] = [&[400.0, 100.0, 0.0], &[100.0, 400.0, 0.0]];
    let found = problem(&[10.0, 20.0], &points, &["Plane.mean>=300", "Plane.uo>=0.8"]).solve().expect("a dimming");
    close(&found.levels, &[0.8, 0.4]);
    close(&[found.targets[1].reached], &[0.8]);
}

#[test]
fn the_least_and_the_greatest_point_are_limited() {
    let points: [&[f64]; 2] = [&[400.0, 100.0, 0.0], &[100.0, 400.0, 0.0]];
    // 100 a + 400 b ≥ 250 and 400 a + 100 b ≥ 250: a = b = 0.5.
    close(&problem(&[10.0, 10.0], &points, &["Plane.min>=250"]).solve().expect("a dimming").levels, &[0.5, 0.5]);
    // A mean of 250 (a + b) = 300 wants a + b = 1.2.
    let found = problem(&[10.0, 1.0], &points, &["Plane.mean>=300", "Plane.max<=440"]).solve().expect("a dimming");
    // 100 a + 400 b ≤ 440 leaves b ≤ 320 / 300, so that b = 1 is its own limit.
    close(&found.levels, &[0.2, 1.0]);
    // 100 a + 400 b ≤ 390 leaves b ≤ 0.9.
    let found = problem(&[10.0, 1.0], &points, &["Plane.mean>=300", "Plane.max<=390"]).solve().expect("a dimming");
    close(&found.levels, &[0.3, 0.9]);
}

#[test]
fn exact_values_and_ranges_are_kept() {
    let mut asked = problem(&[10.0, 10.0], &[&[400.0, 300.0, 0.0]], &["Plane.mean=500±10"]);
    close(&[asked.solve().expect("a dimming").targets[0].reached], &[490.0]);
    asked.groups[0].range = [0.25, 0.25];
    asked.groups[1].range = [0.1, 1.0];
    let found = asked.solve().expect("a dimming");
    close(&found.levels, &[0.25, 1.0]);
    close(&[found.targets[0].margin], &[-90.0]);
    assert!(!found.meets_all());
}

#[test]
fn targets_against_each_other_are_missed_least() {
    // 500 lx at least and 400 at most on one point: a share x of 500 is missed below, of 400 above; every lux above 400 costs 1/400 and saves 1/500.
    let found = problem(&[10.0], &[&[1000.0, 0.0]], &["Plane.mean>=500", "Plane.max<=400"]).solve().expect("a dimming");
    close(&found.levels, &[0.4]);
    assert_eq!([found.targets[0].verdict, found.targets[1].verdict], [Verdict::NotMet, Verdict::Met]);
    close(&[found.targets[0].margin], &[-100.0]);
    // Too little light is all of it.
    close(&problem(&[10.0], &[&[300.0, 50.0]], &["Plane.min>=500"]).solve().expect("a dimming").levels, &[1.0]);
}

#[test]
fn other_goals_come_before_power() {
    let mut asked = problem(&[10.0, 10.0], &[&[400.0, 300.0, 0.0]], &["Plane.mean>=350"]);
    asked.goal = Goal::Equal;
    close(&asked.solve().expect("a dimming").levels, &[0.5, 0.5]);
    // 0.2 and 0.6 bring 260 lx; both go up by 90 / 700.
    asked.goal = Goal::Near(vec![Some(0.2), Some(0.6)]);
    close(&asked.solve().expect("a dimming").levels, &[0.2 + 90.0 / 700.0, 0.6 + 90.0 / 700.0]);
    asked.goal = Goal::Near(vec![None, Some(0.5)]);
    close(&asked.solve().expect("a dimming").levels, &[0.5, 0.5]);
}

#[test]
fn errors_make_doubt_or_are_kept() {
    let mut asked = problem(&[10.0], &[&[1000.0, 0.0]], &["Plane.mean>=500"]);
    asked.areas[0].points[0].of_groups[0].error = 10.0;
    let found = asked.solve().expect("a dimming");
    close(&[found.targets[0].error], &[5.0]);
    assert_eq!(found.targets[0].verdict, Verdict::WithinError);
    // (1000 − 2 · 10) d = 500.
    asked.errors_kept = 2.0;
    let found = asked.solve().expect("a dimming");
    close(&found.levels, &[500.0 / 980.0]);
    assert_eq!(found.targets[0].verdict, Verdict::Met);
}

/// The least power of three groups by all corners of the program: wherever three of its planes meet within all others.
fn by_corners(rows: &[([f64; 3], f64)], watts: &[f64; 3]) -> f64 {
    let mut best = f64::INFINITY;
    for i in 0..rows.len() {
        for j in 0..i {
            for k in 0..j {
                let [a, b, c] = [rows[i], rows[j], rows[k]];
                let det = |m: [[f64; 3]; 3]| {
                    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
                };
                let whole = det([a.0, b.0, c.0]);
                if whole.abs() < 1e-9 {
                    continue;
                }
                let with = |column: usize| {
                    det([a, b, c].map(|(mut row, side)| {
                        row[column] = side;
                        row
                    })) / whole
                };
                let x = [with(0), with(1), with(2)];
                let inside = rows.iter().all(|(row, side)| row.iter().zip(&x).map(|(r, x)| r * x).sum::<f64>() >= side - 1e-7);
                if inside {
                    best = best.min(x.iter().zip(watts).map(|(x, w)| x * w).sum());
                }
            }
        }
    }
    best
}

#[test]
fn three_groups_agree_with_all_corners_of_the_program() {
    let mut state = 1_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let mut compared = 0;
    for _ in 0..60 {
        let points: Vec<[f64; 4]> =
            (0..6).map(|_| [100.0 + 400.0 * random(), 100.0 + 400.0 * random(), 100.0 + 400.0 * random(), 0.0]).collect();
        let watts = [10.0 + 10.0 * random(), 10.0 + 10.0 * random(), 10.0 + 10.0 * random()];
        let views: Vec<&[f64]> = points.iter().map(|point| point.as_slice()).collect();
        let found = problem(&watts, &views, &["Plane.mean>=300", "Plane.uo>=0.7", "Plane.max<=600"]).solve().expect("a dimming");
        let mean = [0, 1, 2].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / 6.0);
        let mut rows = vec![(mean, 300.0)];
        for point in &points {
            rows.push(([0, 1, 2].map(|k| point[k] - 0.7 * mean[k]), 0.0));
            rows.push(([0, 1, 2].map(|k| -point[k]), -600.0));
        }
        for k in 0..3 {
            let unit = |value: f64| [0, 1, 2].map(|other| if other == k { value } else { 0.0 });
            rows.extend([(unit(1.0), 0.0), (unit(-1.0), -1.0)]);
        }
        let expected = by_corners(&rows, &watts);
        assert_eq!(found.meets_all(), expected.is_finite());
        if expected.is_finite() {
            compared += 1;
            assert!((found.watts - expected).abs() < 1e-4 * expected, "{} W, not {expected}", found.watts);
        }
    }
    assert!(compared > 20, "{compared} of 60 have a dimming");
}

#[test]
fn what_is_wrong_is_told() {
    for text in [
        "Plane",
        "Plane.mean>500",
        "Plane.mean>=nan",
        "Plane.mean>=-1",
        "Plane.mean=500",
        "Plane.max>=5",
        "Plane.uo>=2",
        ".mean>=5",
        ">=5",
        "a=",
        "",
    ] {
        assert!(matches!(Target::parse(text), Err(DimmingError::Target { .. })), "{text}");
    }
    let told = |problem: Problem| problem.solve().expect_err("a problem").to_string();
    let plain = || problem(&[10.0], &[&[1000.0, 0.0]], &["Plane.mean>=500"]);
    assert!(told(problem(&[10.0], &[&[1000.0, 0.0]], &["Floor.mean>=500"])).contains("/Room/Plane"));
    assert!(told(problem(&[f64::NAN], &[&[1000.0, 0.0]], &["Plane.mean>=500"])).contains("g0"));
    assert!(told(problem(&[10.0], &[&[f64::NAN, 0.0]], &["Plane.mean>=500"])).contains("/Room/Plane"));
    assert!(told(Problem { errors_kept: -1.0, ..plain() }).contains("-1"));
    assert!(told(Problem { goal: Goal::Near(vec![Some(2.0)]), ..plain() }).contains("0 to 1"));
    assert!(told(Problem { groups: vec![Group { range: [0.5, 0.2], ..group("g", 1.0) }], ..plain() }).contains("0.5 to 0.2"));
}

#[test]
fn meters_are_named_by_their_places() {
    let target = Target::parse("2,3,1.2>=300").expect("a target");
    assert!(target.names("2,3,1.2") && target.limit == Limit::MeanAtLeast(300.0));
    assert!(Target::parse("Plane.min >= 200").expect("a target").names("/Room/Plane"));
}
