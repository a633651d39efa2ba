//! Figures by their names, in every kind of file.

use super::{grid, meter, one, road, year};
use crate::{Sheet, Verdict, lines};
use serde_json::{Value, json};

fn value(keys: &str, files: &[Value]) -> (f64, Option<f64>) {
    let found = one(&format!("{keys}; at_least = 0"), files).expect(keys);
    let reached = found.rows[0].reached.clone();
    let reached = reached.unwrap_or_else(|| panic!("{keys}: {:?}", lines(&found)));
    (reached.value, reached.standard_error)
}

fn told(sheet: &Sheet) -> String {
    lines(sheet).join("\n")
}

#[test]
fn grids_and_meters() {
    let files = [grid(), meter("2,3,1.2", "daylight-factor", "%", json!(3.5))];
    for (keys, expected) in [
        ("area = '/Office/Desk'; quantity = 'mean'", 510.0),
        ("area = 'Office/Desk'; quantity = 'average'", 510.0),
        ("area = 'desk'; quantity = 'illuminance'", 510.0),
        ("area = 'Desk'; quantity = 'min'", 400.0),
        ("area = 'Desk'; quantity = 'maximum'; of = 'illuminance'; unit = 'lux'", 640.0),
        ("area = '2,3,1.2'; quantity = 'daylight_factor'; unit = '%'", 3.5),
        ("area = '2,3,1.2'; quantity = 'daylight-factor'", 3.5),
    ] {
        assert!((value(keys, &files).0 - expected).abs() < 1e-12, "{keys}");
    }
}

/// A meter of one figure of colour has all of them; none is light, which falls as lamps age, and grids have no uniformity of them.
#[test]
fn colour_of_light() {
    let mut file = meter("desk", "ra", "", json!(84.8));
    file["meters"][0]["colour"] = json!({ "cct": 4102.5, "duv": -0.0007, "ra": 84.8, "rf": 85.3, "rg": null, "melanopic_edi_lx": 250.0,
        "standard_errors": { "cct": 2.0, "duv": 0.0001, "ra": 0.2, "rf": 0.3, "rg": null, "melanopic_edi_lx": 1.0 } });
    for (keys, expected) in
        [("ra", 84.8), ("rf", 85.3), ("cct'; unit = 'K", 4102.5), ("melanopic-edi'; unit = 'lx'; maintenance_factor = 0.8; of = '", 200.0)]
    {
        let keys = format!("area = 'desk'; quantity = '{keys}'").replace("; of = ''", "");
        assert!((value(&keys, &[file.clone()]).0 - expected).abs() < 1e-9, "{keys}");
    }
    assert_eq!(
        one("area = 'desk'; quantity = 'rg'; at_least = 90", &[file.clone()]).expect("a sheet").rows[0].verdict,
        Verdict::NotMeasured
    );
    let factor =
        one("area = 'desk'; quantity = 'cct'; at_least = 4000; maintenance_factor = 0.8", &[file]).expect_err("no light").to_string();
    assert!(factor.contains("not proportional to light"), "{factor}");
    let mut grid = grid();
    (grid["grids"][0]["quantity"], grid["grids"][0]["unit"]) = (json!("cct"), json!("K"));
    assert!((value("area = 'Desk'; quantity = 'min'; unit = 'K'", &[grid.clone()]).0 - 400.0).abs() < 1e-12);
    assert_eq!(
        one("area = 'Desk'; quantity = 'uniformity'; at_least = 0.4", &[grid]).expect("a sheet").rows[0].verdict,
        Verdict::NotMeasured
    );
}

/// A model's sensors have figures one by one and together.
#[test]
fn sensor_grids() {
    let mut file = meter("desks/0", "illuminance", "lx", json!(400.0));
    file["sensor_grids"] = json!([{ "name": "desks", "quantity": "illuminance", "unit": "lx", "points": 2,
        "average": { "value": 500.0, "standard_error": 2.0 }, "min": { "value": 400.0, "standard_error": 3.0 },
        "max": { "value": 600.0, "standard_error": 3.0 } }]);
    for (keys, expected) in [
        ("area = 'desks'; quantity = 'mean'", 500.0),
        ("area = 'desks'; quantity = 'uniformity'", 0.8),
        ("area = 'desks/0'; quantity = 'mean'", 400.0),
    ] {
        assert!((value(keys, &[file.clone()]).0 - expected).abs() < 1e-12, "{keys}");
    }
}

/// What three quarters of the points have, and shares by each criterion and by all.
#[test]
fn views_out() {
    let shares = |minimum: f64, medium: f64| json!({ "minimum": minimum, "medium": medium, "high": 0.0 });
    let point = |angle: f64| json!({ "sight_angle_deg": angle, "distance_m": 25.0 });
    let file = json!({ "share_of_points": 0.75, "meters": [{ "name": "2,3,1.2", "sight_angle_deg": 41.5, "distance_m": 5000.0 }],
        "sensor_grids": [], "grids": [{ "name": "/Office/Floor", "sight_angle_deg": 30.0, "distance_m": 25.0,
        "shares": { "sight_angle": shares(0.9, 0.8), "distance": shares(1.0, 1.0), "layers": shares(1.0, 0.7), "all": shares(0.9, 0.6) },
        "columns": 2, "rows": 1, "spacing_m": [1.0, 1.0], "points": [point(30.0), null] }] });
    for (keys, expected) in [
        ("area = 'Floor'; quantity = 'sight_angle'; unit = '°'", 30.0),
        ("area = 'Floor'; quantity = 'distance'; unit = 'm'", 25.0),
        ("area = 'Floor'; quantity = 'view_medium'", 0.6),
        ("area = 'Floor'; quantity = 'view_medium'; unit = '%'", 60.0),
        ("area = 'Floor'; quantity = 'view_medium'; of = 'layers'", 0.7),
        ("area = 'Floor'; quantity = 'view_minimum'; of = 'sight_angle'", 0.9),
        ("area = '2,3,1.2'; quantity = 'sight_angle'", 41.5),
    ] {
        let (found, error) = value(keys, std::slice::from_ref(&file));
        assert!((found - expected).abs() < 1e-12 && error.is_none(), "{keys}");
    }
}

#[test]
fn years() {
    for (keys, expected, error) in [
        ("area = 'Desk'; quantity = 'sda_300_50'", 0.5, Some(0.01)),
        ("area = 'Desk'; quantity = 'sda_300_50'; unit = '%'", 50.0, Some(1.0)),
        ("area = 'Desk'; quantity = 'mean_lx'; unit = 'lx'", 800.0, Some(10.0)),
        ("area = 'Desk'; quantity = 'da_300'", 0.5, Some(0.02)),
        ("area = 'Desk'; quantity = 'minimum'; of = 'da_300'", 0.4, Some(0.01)),
        ("area = 'Desk'; quantity = 'maximum'; of = 'da_300'; unit = '%'", 60.0, Some(3.0)),
        ("area = 'Desk'; quantity = 'minimum'; of = 'daylight_hours_300'", 0.8, None),
        ("area = 'Desk'; quantity = 'hourly_area_300'", 0.9, Some(0.02)),
    ] {
        let found = value(keys, &[year()]);
        assert!((found.0 - expected).abs() < 1e-12, "{keys}: {found:?}");
        assert_eq!(found.1.map(|error| (error * 1e9).round()), error.map(|error| (error * 1e9f64).round()), "{keys}");
    }
    let missing = one("area = 'Desk'; quantity = 'ase_1000_250'; at_most = 0.1", &[year()]).expect("a sheet");
    assert_eq!(missing.rows[0].verdict, Verdict::NotMeasured);
}

#[test]
fn roads() {
    for (keys, expected) in [
        ("area = 'mill'; quantity = 'l_av'; unit = 'cd/m2'", 0.88),
        ("area = 'road'; quantity = 'uo'", 0.69),
        ("area = 'roads/mill.toml'; quantity = 'e_av'; unit = 'lx'", 12.5),
        ("area = 'mill'; quantity = 'pdi'", 15.3),
        ("area = 'north path'; quantity = 'e_min'", 5.8),
        ("area = 'lane 2'; quantity = 'ti'; unit = '%'", 11.0),
        ("area = 'right edge'; quantity = 'ratio'", 0.5),
    ] {
        assert_eq!(value(keys, &[road()]), (expected, None), "{keys}");
    }
}

#[test]
fn modelling_is_cylindrical_over_level_illuminance() {
    let files = [meter("a", "illuminance", "lx", json!(400.0)), meter("a", "cylindrical", "lx", json!(160.0))];
    let found = value("area = 'a'; quantity = 'modelling'", &files);
    assert!((found.0 - 0.4).abs() < 1e-12 && (found.1.expect("an error") - 0.4 * (0.2f64 / 400.0).hypot(0.2 / 160.0)).abs() < 1e-12);
}

#[test]
fn the_same_figure_of_two_files_wants_the_file() {
    let files = [grid(), grid()];
    let error = one("area = 'Desk'; quantity = 'mean'; at_least = 1", &files).expect_err("two figures").to_string();
    assert!(error.starts_with("office.toml:1: ") && error.contains("out/0.json") && error.contains("out/1.json"), "{error}");
    assert_eq!(value("area = 'Desk'; quantity = 'mean'; file = '1.json'", &files).0, 510.0);
    let error = one("area = 'Desk'; quantity = 'mean'; file = '2.json'; at_least = 1", &files).expect_err("no such file").to_string();
    assert!(error.contains("'2.json' is none of those given"), "{error}");
}

#[test]
fn noise_that_moves_least_points_is_told() {
    // The least point is 400 ± 30, 7.5 %; the greatest 640 ± 8, 1.25 %.
    let least = told(&one("area = 'Desk'; quantity = 'minimum'; at_least = 500", &[grid()]).expect("a sheet"));
    assert!(least.contains("7.5 %") && least.contains("noise moves a least point down"), "{least}");
    let greatest = told(&one("area = 'Desk'; quantity = 'maximum'; at_most = 500", &[grid()]).expect("a sheet"));
    assert!(!greatest.contains("noise moves"), "{greatest}");
}

#[test]
fn what_is_not_there_is_told_with_what_is() {
    let no_area = told(&one("area = 'Dseks'; quantity = 'mean'; at_least = 1", &[grid(), road()]).expect("a sheet"));
    assert!(no_area.contains("office.toml:1: nothing measured is called 'Dseks'. Did you mean '/Office/Desk'?"), "{no_area}");
    assert!(no_area.contains("north path"), "{no_area}");
    let swapped = told(&one("area = 'Desk'; quantity = 'maen'; at_least = 1", &[grid()]).expect("a sheet"));
    assert!(swapped.contains("Did you mean 'mean'?"), "{swapped}");
    let no_quantity = told(&one("area = 'Desk'; quantity = 'uniformty'; at_least = 1", &[grid()]).expect("a sheet"));
    assert!(no_quantity.contains("Did you mean 'uniformity'?") && no_quantity.contains("mean of illuminance"), "{no_quantity}");
}

/// What a command leaves out stands beside its figures: a glare that is met is not met of what nobody rated.
#[test]
fn what_is_left_out_is_told() {
    let mut glare = grid();
    (glare["grids"][0]["quantity"], glare["grids"][0]["unit"]) = (json!("ugr"), json!(""));
    glare["grids"][0]["values"][0] = Value::Null;
    glare["grids"][0]["ugr_coverage"] =
        json!([{ "left_out": 0, "share_left_out": 0.0, "behind_covers": 2 }, { "left_out": 0, "behind_covers": 0 }]);
    let sheet = told(&one("area = 'Desk'; quantity = 'ugr'; at_most = 1000", &[glare]).expect("a sheet"));
    assert!(sheet.contains("behind glass or covers is not rated at 1 points") && sheet.contains("1 point"), "{sheet}");
    let note = "2 of 3 eyes see luminaires through glass";
    let observer = json!({ "name": "Keeper", "gr": 30.0, "gr_error": 0.1 });
    let sports = json!({ "fields": [], "observers": [observer], "notes": [note] });
    let sheet = told(&one("area = 'Keeper'; quantity = 'gr'; at_most = 50", &[sports]).expect("a sheet"));
    assert!(sheet.contains(note), "{sheet}");
}

/// Grids of one figure of colour have the others of their points; grids of eyes the least eye and the shares that reach a target.
#[test]
fn eyes_and_colours_of_grids() {
    let mut file = grid();
    let colour = |rf: f64| json!({ "cct": 4000.0, "rf": rf, "rg": null, "melanopic_edi_lx": 3.0 * rf, "standard_errors": { "rf": 3.0, "rg": null } });
    let share = |share: f64, error: f64| json!({ "count": 6, "share": share, "standard_error": error, "share_within_error": 2.0 * error });
    let of = &mut file["grids"][0];
    (of["quantity"], of["unit"], of["colours"]) = (json!("cct"), json!("K"), json!([colour(80.0), colour(90.0)]));
    of["eyes"] = json!({ "facings": [[0, 1, 0]], "least": { "value": 390.0, "standard_error": 5.0 } });
    of["target"] = json!({ "value": 250.0, "points": share(0.75, 0.05), "points_all_ways": share(0.5, 0.0), "eyes": share(0.7, 0.02) });
    let close = |keys: &str, expected: (f64, Option<f64>)| {
        let found = value(&format!("area = 'Desk'; quantity = {keys}"), &[file.clone()]);
        let error = found.1.zip(expected.1).map_or(found.1 == expected.1, |(found, expected)| (found - expected).abs() < 1e-9);
        assert!((found.0 - expected.0).abs() < 1e-9 && error, "{keys}: {found:?}");
    };
    close("'rf'", (85.0, Some(4.5f64.sqrt())));
    close("'minimum'; of = 'rf'", (80.0, Some(3.0)));
    close("'mean'", (510.0, Some(4.0)));
    close("'melanopic_edi'; unit = 'lx'; maintenance_factor = 0.8", (204.0, None));
    close("'least_eye'; unit = 'K'", (390.0, Some(5.0)));
    close("'share_of_points'; unit = '%'", (75.0, Some(5.0)));
    close("'share_all_ways'", (0.5, Some(0.0)));
    close("'share_of_eyes'; unit = '%'", (70.0, Some(2.0)));
    let verdict = |least: u32| {
        let keys = format!("area = 'Desk'; quantity = 'share_of_points'; unit = '%'; at_least = {least}");
        let found = one(&keys, &[file.clone()]).expect("a sheet");
        (found.rows[0].verdict, told(&found))
    };
    assert_eq!([60, 80, 90].map(|least| verdict(least).0), [Verdict::Met, Verdict::WithinError, Verdict::NotMet]);
    assert!(verdict(60).1.contains("reach 250 K"), "{}", verdict(60).1);
}
