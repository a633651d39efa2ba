//! Written and read again.

use crate::ldt::Text;
use crate::{close, ies_text, steps, type_c};
use gonio_formats::photometry::{Goniogram, PhotometricType, Symmetry, ies, ldt};

fn all() -> Vec<Goniogram> {
    let odd = |c: f64, gamma: f64| 1234.567 + 300.0 * (c.to_radians() * 3.0 + 0.3).sin() + gamma / 7.0;
    let vertical = [0.0, 4.0, 11.1, 37.0, 90.0, 113.0, 180.0];
    let ranges = [vec![0.0], vec![0.0, 13.0, 90.0], vec![0.0, 50.0, 77.0, 180.0], vec![90.0, 170.0, 270.0], steps(0.0, 360.0, 12)];
    ranges.iter().map(|horizontal| type_c(&vertical, horizontal, odd)).collect()
}

/// Directions all over, none of them tabulated.
fn same_everywhere(a: &Goniogram, b: &Goniogram, relative: f64) {
    for c in steps(1.0, 355.3, 20) {
        for gamma in steps(0.7, 178.3, 20) {
            let direction = PhotometricType::C.direction(c, gamma);
            close(b.intensity(direction), a.intensity(direction), relative);
        }
    }
    close(b.flux(), a.flux(), relative);
}

#[test]
fn ies_keeps_everything() {
    for goniogram in all() {
        let again = ies::read(&ies::write(&goniogram)).unwrap();
        assert_eq!((again.symmetry, &again.horizontal, &again.vertical), (goniogram.symmetry, &goniogram.horizontal, &goniogram.vertical));
        assert_eq!(again.text("LUMINAIRE"), goniogram.text("LUMINAIRE"));
        assert_eq!((again.opening, again.lamps()), (goniogram.opening, goniogram.lamps()));
        assert_eq!(again.warnings, []);
        same_everywhere(&goniogram, &again, 1e-6);
        assert_eq!(ies::write(&again), ies::write(&goniogram));
    }
}

#[test]
fn eulumdat_keeps_everything() {
    for goniogram in all() {
        let again = ldt::read(&ldt::write(&goniogram)).unwrap();
        assert_eq!((again.symmetry, again.text("LUMINAIRE")), (goniogram.symmetry, goniogram.text("LUMINAIRE")));
        assert_eq!(again.warnings, []);
        same_everywhere(&goniogram, &again, 1e-6);
        let bytes = ldt::write(&again);
        same_everywhere(&again, &ldt::read(&bytes).unwrap(), 1e-6);
    }
}

#[test]
fn eulumdat_becomes_ies_and_comes_back() {
    let area = ["1200", "300", "10", "20", "10", "20"];
    let sets = vec![["2", "LED", "1000", "3000", "80", "20"]];
    let stored: Vec<f64> = (9..=15).map(|index| f64::from(index) * 30.0).collect();
    let text =
        Text { symmetry: 3, area, sets, ..Text::default() }.write(&stored, |c, gamma| 60.0 + c.rem_euclid(360.0) / 10.0 + gamma / 10.0);
    let first = ldt::read(text.as_bytes()).unwrap();
    let ies = ies::read(&ies::write(&first)).unwrap();
    assert_eq!(ies.symmetry, Symmetry::AboutC90);
    assert_eq!(ies.opening.size, first.opening.size);
    assert_eq!(ies.lamps().unwrap().flux, Some(1000.0));
    same_everywhere(&first, &ies, 1e-6);
    let back = ldt::read(&ldt::write(&ies)).unwrap();
    same_everywhere(&first, &back, 1e-6);
    let again = ldt::read(&ldt::write(&first)).unwrap();
    assert_eq!((&again.lamp_sets, again.opening, again.body), (&first.lamp_sets, first.opening, first.body));
    assert_eq!(again.stated.direct_ratios, first.stated.direct_ratios);
}

#[test]
fn floodlights_stay_what_they_are_in_ies_and_become_type_c_in_eulumdat() {
    let text =
        ies_text("IESNA:LM-63-2002", "1 -1 1 V H 2 2 0.3 0.2 0", "1 1 20", &steps(-90.0, 90.0, 60), &steps(0.0, 90.0, 30), |h, v| {
            1000.0 * (-(h * h + (v - 10.0) * (v - 10.0)) / 800.0).exp()
        });
    let floodlight = ies::read(text.as_bytes()).unwrap();
    let again = ies::read(&ies::write(&floodlight)).unwrap();
    assert_eq!(again.photometric_type, PhotometricType::B);
    same_everywhere(&floodlight, &again, 1e-6);
    let converted = ldt::read(&ldt::write(&floodlight)).unwrap();
    assert_eq!(converted.symmetry, Symmetry::AboutC0);
    close(converted.flux(), floodlight.flux(), 1e-6);
}

#[test]
fn tilt_is_written() {
    let text = "IESNA:LM-63-1995\nTILT=INCLUDE\n2\n3\n0 45 90\n1 0.9 0.8\n1 1000 1 2 1 1 2 0 0 0\n1 1 20\n0 90\n0\n10 10\n";
    let goniogram = ies::read(text.as_bytes()).unwrap();
    assert_eq!(ies::read(&ies::write(&goniogram)).unwrap().tilt, goniogram.tilt);
}
