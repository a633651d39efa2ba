//! What cannot be used is told with file and line.

use super::{grid, meter, one, road, sheet, year};
use crate::{Measured, Requirements};
use serde_json::{Value, json};
use std::path::Path;

const GOOD: &str = "title = 'Office'

[[require]]
area = 'Desk'
quantity = 'mean'
at_least = 500
unit = 'lx'
label = 'Em'
maintenance_factor = 0.8
";

#[test]
fn requirements() {
    for (from, to, expected) in [
        ("at_least", "at_lest", "office.toml:6: [[require]]: the key 'at_lest' is not known; did you mean 'at_least'?"),
        ("label", "xyz", "office.toml:8: [[require]]: the key 'xyz' is not known; known are area, "),
        ("title", "titel", "office.toml:1: the requirements: the key 'titel' is not known; did you mean 'title'?"),
        ("at_least = 500\n", "", "office.toml:3: [[require]]: at_least or at_most is missing"),
        ("unit = 'lx'", "at_most = 600", "office.toml:7: [[require]]: at_most stands beside at_least"),
        ("500", "nan", "office.toml:6: [[require]]: at_least is NaN, expected a number from 0"),
        ("500", "inf", "office.toml:6: [[require]]: at_least is inf"),
        ("500", "-1", "office.toml:6: [[require]]: at_least is -1"),
        ("500", "'500'", "office.toml:6: [[require]]: at_least is a string, expected a number"),
        ("'lx'", "'furlong'", "office.toml:7: [[require]]: unit is 'furlong', expected one of lx, cd/m², %"),
        ("'lx'", "'%'", "office.toml:3: unit is '%', but that of mean of illuminance is \"lx\""),
        ("0.8", "80", "office.toml:9: [[require]]: maintenance_factor is 80, expected a number above 0 and up to 1"),
        ("area = 'Desk'\n", "", "office.toml:3: [[require]]: area is missing"),
        ("'mean'", "''", "office.toml:5: [[require]]: quantity is not a text"),
        ("'mean'", "5", "office.toml:5: [[require]]: quantity is not a text"),
        ("[[require]]", "[require]", "office.toml:3: the requirements: require is not a list of tables, expected [[require]]"),
        ("[[require]]", "[[require", "office.toml:3: no TOML: "),
        ("'Office'", "'Office", "office.toml:1: no TOML: "),
    ] {
        let text = GOOD.replace(from, to);
        let error = sheet(&text, &[grid()]).expect_err(&text).to_string();
        assert!(error.starts_with(expected), "{from} -> {to}: {error}");
    }
    let error = sheet("title = 'Office'", &[grid()]).expect_err("no requirement").to_string();
    assert!(error.contains("require is missing, expected one [[require]] at least"), "{error}");
}

#[test]
fn limits_that_cannot_be_meant() {
    for (keys, file, expected) in [
        ("area = 'Desk'; quantity = 'sda_300_50'; at_least = 55", year(), "is a share from 0 to 1; write unit = \"%\""),
        ("area = 'Desk'; quantity = 'uniformity'; at_least = 120; unit = '%'", grid(), "no uniformity of illuminance is above 100 %"),
        ("area = 'Desk'; quantity = 'uniformity'; at_least = 0.6; maintenance_factor = 0.8", grid(), "maintenance_factor is for lx"),
        ("area = 'mill'; quantity = 'l_av'; at_least = 1; maintenance_factor = 0.8", road(), "its rows have their own"),
        ("area = 'mill'; quantity = 'ti'; at_most = 15; unit = 'lx'", road(), "but that of ti is \"%\""),
    ] {
        let error = one(keys, &[file]).expect_err(keys).to_string();
        assert!(error.starts_with("office.toml:1: ") && error.contains(expected), "{keys}: {error}");
    }
}

#[test]
fn a_name_of_two_areas_wants_more_of_the_path() {
    let mut two = grid();
    let other = two["grids"][0].clone();
    two["grids"].as_array_mut().expect("grids").push(other);
    two["grids"][1]["name"] = json!("/Annex/Desk");
    let error = one("area = 'Desk'; quantity = 'mean'; at_least = 1", &[two]).expect_err("two areas").to_string();
    assert!(
        error.contains("may be any of mean of illuminance of /Office/Desk (out/0.json); mean of illuminance of /Annex/Desk"),
        "{error}"
    );
}

fn measured(bytes: &[u8]) -> String {
    Measured::read(&[("out.json".into(), bytes.to_vec())]).expect_err("no measurement").to_string()
}

#[test]
fn measured_files() {
    let mut broken = grid();
    broken["grids"][0]["average"] = json!(5);
    let mut negative = grid();
    negative["grids"][0]["min"]["standard_error"] = json!(-1.0);
    for (bytes, expected) in [
        ("".to_owned(), "out.json: an empty file, expected what 'gonio measure'"),
        ("{\n\"grids\": NaN".to_owned(), "out.json:2: no JSON at column 10: expected value"),
        ("{\"a\": 1e999}".to_owned(), "out.json:1: no JSON at column "),
        ("[1, 2]".to_owned(), "out.json: no object of JSON"),
        ("{\"dgp\": 0.3}".to_owned(), "out.json: 'dgp' were found, expected what"),
        ("{}".to_owned(), "out.json: nothing was found, expected what"),
        ("{\"meters\": 1, \"grids\": []}".to_owned(), "out.json: 'meters' is not a list of objects"),
        ("{\"meters\": [{}], \"grids\": []}".to_owned(), "out.json: a meter has no 'name'"),
        (broken.to_string(), "out.json: the grid '/Office/Desk' has no 'average' with"),
        (negative.to_string(), "out.json: 'standard_error' is -1"),
    ] {
        let error = measured(bytes.as_bytes());
        assert!(error.starts_with(expected), "{bytes}: {error}");
    }
    assert!(measured(&[0xff, 0xfe, 0]).starts_with("out.json:1: no JSON"));
}

/// Every byte of good files is left out, doubled and replaced: there may be an error, but no panic.
#[test]
fn no_bytes_break_the_readers() {
    let wanted = GOOD.as_bytes();
    for bytes in changed(wanted) {
        let _ = Requirements::read(&bytes, Path::new("office.toml")).map(|read| sheet_of(&bytes, read, &[grid(), road(), year()]));
    }
    let read = Requirements::read(wanted, Path::new("office.toml")).expect("good requirements");
    for file in [grid(), meter("a", "ugr", "", json!(18.0)), road(), year()] {
        for bytes in changed(file.to_string().as_bytes()) {
            let _ = Measured::read(&[("a.json".into(), bytes)]).map(|found| crate::Sheet::new(read.clone(), wanted, found));
        }
    }
}

fn sheet_of(bytes: &[u8], read: Requirements, files: &[Value]) {
    let files: Vec<_> = files.iter().map(|file| ("a.json".into(), file.to_string().into_bytes())).collect();
    let found = Measured::read(&files).expect("good files");
    let _ = crate::Sheet::new(read, bytes, found).map(|sheet| crate::page(&sheet, gonio_page::Language::English, ""));
}

fn changed(bytes: &[u8]) -> impl Iterator<Item = Vec<u8>> {
    (0..bytes.len()).flat_map(move |at| {
        let with = |new: &[u8], skip: usize| [&bytes[..at], new, &bytes[at + skip..]].concat();
        [with(&[], 1), with(&[bytes[at]], 0), with(b"9", 1), with(b"\xff", 1), with(b"[", 1), with(b"-", 1), bytes[..at].to_vec()]
    })
}
