//! Openings in the wrong unit, and decimal commas.

use crate::close;
use crate::ldt::Text;
use gonio_formats::photometry::{Goniogram, OpeningShape, ies, ldt, read_with};

/// A downlight's file with these ten numbers behind the TILT line and these candela.
fn downlight(head: &str, candela: &str) -> String {
    format!("IESNA:LM-63-2002\n[TEST] t\n[MANUFAC] m\nTILT=NONE\n{head}\n1 1 10\n0 15 30 45 60 75 90\n0\n{candela}\n")
}

const CANDELA: &str = "1000 966 866 707 500 259 0";

fn opening(head: &str) -> Goniogram {
    ies::read(downlight(head, CANDELA).as_bytes()).unwrap()
}

fn same<const N: usize>(found: [f64; N], expected: [f64; N]) {
    found.into_iter().zip(expected).for_each(|(found, expected)| close(found, expected, 1e-12));
}

fn warnings(goniogram: &Goniogram) -> Vec<String> {
    goniogram.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn openings_in_millimetres_are_mended_and_told() {
    for (head, size) in [
        ("1 1000 1 7 1 1 2 600 600 80", [0.6, 0.6, 0.08]),
        ("1 1000 1 7 1 1 1 2400 1200 300", [1.2, 2.4, 0.3]),
        // A height that was left in metres, and a round opening.
        ("1 1000 1 7 1 1 2 300 1200 0.05", [1.2, 0.3, 0.05]),
        ("1 1000 1 7 1 1 2 -200 -200 0", [0.2, 0.2, 0.0]),
    ] {
        let found = opening(head);
        same(found.opening.size, size);
        let told = warnings(&found);
        assert!(told[0].starts_with("line 5: the opening is ") && told[0].ends_with("taken as millimetres"), "{told:?}");
    }
    let line = opening("1 -1 1 7 1 1 2 0.1 12 0.05");
    assert_eq!((line.opening.size[0], warnings(&line).len()), (12.0, 0));
    let nowhere = opening("1 1000 1 7 1 1 2 63800000 38 0");
    assert_eq!(nowhere.opening.shape, OpeningShape::Point);
    assert!(warnings(&nowhere)[0].ends_with("a point is taken"));
}

#[test]
fn a_luminous_area_ends_where_the_luminaire_does() {
    let planes: Vec<f64> = (0..12).map(|index| f64::from(index) * 30.0).collect();
    let with = |area, from: &str, to: &str| {
        let text = Text { area, ..Text::default() }.write(&planes, |_, _| 79.577).replace(from, to);
        ldt::read(text.as_bytes()).unwrap()
    };
    let found = with(["63800000", "38", "0", "0", "0", "0"], "\r\n1250\r\n310\r\n", "\r\n700\r\n43\r\n");
    same(found.opening.size, [0.038, 0.7, 0.0]);
    let told = warnings(&found);
    assert!(told.iter().any(|line| line.starts_with("line 17: the luminous area of 0.038 × 63800 × 0 m")), "{told:?}");
    // No body tells how long it is.
    let found = with(["63800000", "38", "0", "0", "0", "0"], "\r\n1250\r\n310\r\n", "\r\n0\r\n0\r\n");
    assert_eq!(found.opening.shape, OpeningShape::Point);
    let found = with(["600", "0", "400", "400", "400", "400"], "\r\n1250\r\n310\r\n", "\r\n300\r\n0\r\n");
    same(found.opening.size, [0.3, 0.3, 0.05]);
    same(found.opening.heights, [0.05; 4]);
}

#[test]
fn decimal_commas_are_understood() {
    let plain = opening("1 1000 1 7 1 1 2 0.1 0.1 0");
    for (head, candela) in [
        ("1 1000 1 7 1 1 2 0.1 0.1 0", "1000,5 966,1 866,0 707,1 500,0 259,0 0,0"),
        ("1 1000,0 1,0 7 1 1 2 0,1 0,1 0", "1000,5 966,1 866,0 707,1\n500,0 259,0 0"),
        ("1 1000 1 7 1 1 2 0.1 0.1 0", "1000,5, 966,1, 866,0, 707,1, 500,0, 259,0, 0"),
        ("1,1000,1,7,1,1,2,0.1,0.1,0", "1000,5 966,1 866,0 707,1 500,0 259,0 0"),
    ] {
        let found = ies::read(downlight(head, candela).as_bytes()).unwrap();
        assert_eq!(found.intensities, [1000.5, 966.1, 866.0, 707.1, 500.0, 259.0, 0.0], "{candela}");
        assert_eq!(found.opening, plain.opening);
        let told = warnings(&found);
        assert!(told.iter().any(|line| line.ends_with("decimal commas are read as points")), "{told:?}");
    }
}

#[test]
fn commas_between_numbers_stay_separators() {
    let plain = opening("1 1000 1 7 1 1 2 0.1 0.1 0");
    let found = ies::read(downlight("1,1000,1,7,1,1,2,0.1,0.1,0", "1000,966,866 707,500 259, 0").as_bytes()).unwrap();
    assert_eq!((found.intensities, found.warnings), (plain.intensities, plain.warnings));
}

#[test]
fn commas_that_fit_neither_way_are_refused_by_their_line() {
    let candela = "1000,5 966,1 866,0 707,1 500,0 259";
    let error = ies::read(downlight("1 1000 1 7 1 1 2 0.1 0.1 0", candela).as_bytes()).unwrap_err();
    assert_eq!(error.to_string(), "line 9: '1000,5' was found: its comma fits the counts neither as a separator nor as a decimal sign");
    let error = ies::read(downlight("1 1000 1 7 1 1 2 0.1 0.1 0", "1.000,5 966 866 707 500 259 0 1,2").as_bytes()).unwrap_err();
    assert!(error.to_string().starts_with("line 9: "), "{error}");
}

#[test]
fn long_lists_take_no_longer_than_their_length() {
    // A megabyte of separators and numbers without a blank: quadratic time would be minutes.
    for (list, is_read) in [("1,".repeat(500_000), true), (",".repeat(1_000_000), false), ("1,5 ".repeat(250_000), false)] {
        assert_eq!(ies::read(downlight("1 1000 1 7 1 1 2 0.1 0.1 0", &list).as_bytes()).is_ok(), is_read, "{}", &list[..8]);
    }
}

#[test]
fn tilt_factors_have_decimal_commas_too() {
    let text = downlight("1 -1 1 7 1 1 2 0.1 0.1 0", CANDELA).replace("TILT=NONE", "TILT=lamp.tlt");
    let mut beside = |_: &str| Ok(b"1\n3\n0 45 90\n1,0 0,95 0,9\n".to_vec());
    let found = read_with(text.as_bytes(), "a.ies", &mut beside).unwrap();
    assert_eq!(found.tilt.unwrap().factors, [1.0, 0.95, 0.9]);
    let included = text.replace("TILT=lamp.tlt", "TILT=INCLUDE\n1\n3\n0 45 90\n1,0 0,95 0,9");
    assert_eq!(ies::read(included.as_bytes()).unwrap().tilt.unwrap().factors, [1.0, 0.95, 0.9]);
}
