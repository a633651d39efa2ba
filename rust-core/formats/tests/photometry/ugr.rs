//! UGR tables against those that two lighting programs print, and rooms by hand.

use crate::{close, steps, type_c};
use gonio_formats::photometry::{CATALOGUE_SPACING, Opening, OpeningShape, ROOMS, UgrTable, read};
use std::path::Path;

/// A luminaire's table, and what the two programs print.
fn tables(number: &str) -> (UgrTable, [Vec<Vec<f64>>; 2]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/ugr-table");
    let name = format!("s{number}.ldt");
    let goniogram = read(&std::fs::read(folder.join(&name)).unwrap(), &name).unwrap();
    let numbers = |line: &str| line.split(',').map(|cell| cell.trim().parse().unwrap()).collect::<Vec<f64>>();
    let printed = |program: &str| {
        let text = std::fs::read_to_string(folder.join(format!("{number}.{program}.csv"))).unwrap();
        text.lines().map(numbers).collect::<Vec<_>>()
    };
    (goniogram.ugr_table(CATALOGUE_SPACING).unwrap(), ["Dialux", "Relux"].map(printed))
}

#[test]
fn tables_are_those_of_lighting_programs() {
    for number in ["02", "07"] {
        let (table, [first, second]) = tables(number);
        assert_eq!((first.len(), second.len()), (19, 19));
        for (row, values) in table.values.iter().enumerate() {
            for (column, value) in values.iter().enumerate() {
                let (a, b, value) = (first[row][column], second[row][column], value.unwrap());
                let beyond = (a.min(b) - value).max(value - a.max(b)).max(0.0);
                assert!(beyond <= 0.3, "luminaire {number}, room {:?}, column {column}: {value:.2}, printed {a} and {b}", ROOMS[row]);
            }
        }
    }
}

#[test]
fn ten_times_the_light_is_eight_more() {
    // L² grows with the square of the flux, the background with the flux.
    let lambertian = |peak: f64| {
        let mut goniogram = type_c(&steps(0.0, 90.0, 36), &[0.0], |_, gamma| peak * gamma.to_radians().cos());
        goniogram.opening = Opening::new(OpeningShape::Rectangle, [0.6, 0.6, 0.0]);
        goniogram.ugr_table(CATALOGUE_SPACING).unwrap()
    };
    let (dim, bright) = (lambertian(100.0), lambertian(1000.0));
    for (dim, bright) in dim.values.iter().flatten().zip(bright.values.iter().flatten()) {
        close(bright.unwrap() - dim.unwrap(), 8.0, 1e-9);
    }
    // A square luminaire of one curve all around is the same both ways.
    assert!(dim.values.iter().all(|row| (0..5).all(|k| (row[k].unwrap() - row[k + 5].unwrap()).abs() < 1e-9)));
    // Darker walls, more glare.
    assert!(dim.values.iter().all(|row| row[0] < row[1] && row[0] < row[2] && row[3] < row[4]));
}

#[test]
fn one_luminaire_in_the_smallest_room_by_hand() {
    // A cosine of 1 lm at all gives I0 = 1/π cd; spacing 2 in a room of 2 by 2 leaves one luminaire, H ahead: p = 7.0, r² = 2 H².
    let mut goniogram = type_c(&steps(0.0, 90.0, 900), &[0.0], |_, gamma| 1000.0 / std::f64::consts::PI * gamma.to_radians().cos());
    goniogram.opening = Opening::new(OpeningShape::Disk, [0.3, 0.3, 0.0]);
    let table = goniogram.ugr_table(2.0).unwrap();
    let area = std::f64::consts::PI * 0.3 * 0.3 / 4.0;
    let (luminance, shown) = (1000.0 / std::f64::consts::PI / area, area * 45f64.to_radians().cos());
    let sum = luminance * luminance * shown / 2.0 / 49.0;
    // Half of the flux of a cosine over the middle of 2 by 2 falls on the plane: the form factor from a point, 4 (2/(2 π)) (1/√2) atan(1/√2).
    let on_plane = 4.0 / std::f64::consts::PI * (0.5f64.sqrt() * 0.5f64.sqrt().atan());
    let on_walls = 1.0 - on_plane;
    // CIE 190's factors of that room with 70/50/20.
    let background = 1000.0 * (on_plane * 0.220 + on_walls * 0.422) / 8.0 / std::f64::consts::PI;
    let expected = 8.0 * (0.25 / background * sum).log10();
    assert!((table.values[0][0].unwrap() - expected).abs() < 0.02, "{:?} instead of {expected}", table.values[0][0]);
}

#[test]
fn what_has_no_table_says_why() {
    let point = type_c(&[0.0, 90.0], &[0.0], |_, _| 100.0);
    assert!(point.ugr_table(0.25).unwrap_err().to_string().contains("no luminous opening"));
    let mut panel = point.clone();
    panel.opening = Opening::new(OpeningShape::Rectangle, [0.6, 0.6, 0.0]);
    assert!(panel.ugr_table(f64::NAN).unwrap_err().to_string().contains("expected 0.1 to 2"));
    panel.intensities.fill(0.0);
    assert!(panel.ugr_table(0.25).unwrap_err().to_string().contains("no light"));
    // Light that goes up alone: nothing glares, and nothing is said.
    let mut up = type_c(&[90.0, 180.0], &[0.0], |_, gamma| gamma - 90.0);
    up.opening = Opening::new(OpeningShape::Disk, [0.3, 0.3, 0.0]);
    let table = up.ugr_table(0.25).unwrap();
    assert!(table.values.iter().flatten().all(Option::is_none));
    assert!(table.csv().starts_with(",,,,,,,,,\n"));
}
