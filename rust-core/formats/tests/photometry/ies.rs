//! LM-63's own ways.

use crate::{close, ies_text, type_c};
use gonio_formats::photometry::{OpeningShape, PhotometricType, Symmetry, ies, read, read_with};

fn candela(version: &str, factors: &str) -> f64 {
    let text = ies_text(version, "2 1000 1.5 V H 1 2 0 0 0", factors, &[0.0, 90.0], &[0.0], |_, _| 10.0);
    ies::read(text.as_bytes()).unwrap().peak()
}

#[test]
fn factors_apply_by_revision() {
    for (version, last) in [("no version line", true), ("IESNA91", true), ("IESNA:LM-63-1995", false), ("IESNA:LM-63-2002", false)] {
        close(candela(version, "0.9 0.8 20"), 10.0 * 1.5 * 0.9 * if last { 0.8 } else { 1.0 }, 1e-12);
    }
    // The code for how a file of 2019 was made is no factor.
    close(candela("IES:LM-63-2019", "0.9 1.10010 20"), 10.0 * 1.5 * 0.9, 1e-12);
    close(candela("IESNA95", "1 0.8 20"), 15.0, 1e-12);
}

#[test]
fn lamps_never_scale() {
    let read = |head: &str| {
        let text = ies_text("IESNA:LM-63-2002", head, "1 1 20", &[0.0, 90.0], &[0.0], |_, _| 10.0);
        ies::read(text.as_bytes()).unwrap()
    };
    let (relative, absolute) = (read("3 1000 1 V H 1 2 0 0 0"), read("3 -1 1 V H 1 2 0 0 0"));
    assert_eq!(relative.intensities, absolute.intensities);
    assert_eq!(relative.lamps().unwrap().flux, Some(3000.0));
    assert!(absolute.lamps().unwrap().absolute && absolute.lamps().unwrap().flux.is_none());
}

#[test]
fn horizontal_ranges_tell_the_symmetry() {
    let about = |horizontal: &[f64]| type_c(&[0.0, 90.0], horizontal, |c, _| 200.0 + c);
    for (horizontal, symmetry, warnings) in [
        (vec![0.0], Symmetry::Rotational, 0),
        (vec![205.0], Symmetry::Rotational, 1),
        (vec![0.0, 30.0, 90.0], Symmetry::Quadrants, 0),
        (vec![0.0, 30.0, 180.0], Symmetry::AboutC0, 0),
        (vec![90.0, 100.0, 270.0], Symmetry::AboutC90, 0),
        (vec![-90.0, 10.0, 90.0], Symmetry::AboutC90, 1),
        (vec![180.0, 190.0, 360.0], Symmetry::AboutC0, 1),
        (vec![0.0, 120.0, 240.0, 360.0], Symmetry::None, 1),
        (vec![0.0, 120.0, 240.0], Symmetry::None, 1),
        (vec![-180.0, 0.0, 120.0, 180.0], Symmetry::None, 1),
    ] {
        let goniogram = about(&horizontal);
        assert_eq!((goniogram.symmetry, goniogram.warnings.len()), (symmetry, warnings), "{horizontal:?} {:?}", goniogram.warnings);
        if horizontal.len() > 1 && horizontal[0] != -180.0 {
            for c in &horizontal[..horizontal.len() - 1] {
                close(goniogram.intensity_at(*c, 45.0), 200.0 + c, 1e-12);
            }
        }
    }
    // Between the last plane and the first, where 360 is missing.
    close(about(&[0.0, 120.0, 240.0]).intensity_at(300.0, 45.0), 320.0, 1e-12);
}

#[test]
fn a_file_about_c90_is_mirrored_and_not_turned() {
    let goniogram = type_c(&[0.0, 90.0], &[90.0, 180.0, 270.0], |c, _| c);
    for (c, stored) in [(0.0, 180.0), (90.0, 90.0), (180.0, 180.0), (270.0, 270.0), (45.0, 135.0), (315.0, 225.0)] {
        close(goniogram.intensity_at(c, 90.0), stored, 1e-12);
    }
}

#[test]
fn anything_may_stand_before_the_tilt_line() {
    let text = "Arnold says so\r\nIESNA:LM-63-1995\r\n[MANUFAC] Gr\u{fc}n\r\nloose text\r\n  TILT = NONE\r\n\
                1,-1,1,2,1,1,1,\r\n1,2 ,0\r\n1 1 5\r\n0\r\n90\r\n0\r\n7 3\r\n";
    let bytes: Vec<u8> = [0xef, 0xbb, 0xbf].into_iter().chain(text.chars().map(|c| c as u8)).collect();
    let goniogram = read(&bytes, "odd.txt").unwrap();
    assert_eq!(goniogram.text("manufac"), Some("Grün"));
    assert_eq!(goniogram.intensities, [7.0, 3.0]);
    assert_eq!(goniogram.opening.shape, OpeningShape::Rectangle);
    close(goniogram.opening.size[0], 2.0 * 0.3048, 1e-12);
    close(goniogram.opening.size[1], 0.3048, 1e-12);
}

#[test]
fn tilt_is_kept_and_not_applied() {
    let text = "IESNA:LM-63-1995\nTILT=INCLUDE\n2\n3\n0 45 90\n1 0.9 0.8\n1 1000 1 2 1 1 2 0 0 0\n1 1 20\n0 90\n0\n10 10\n";
    let goniogram = ies::read(text.as_bytes()).unwrap();
    let tilt = goniogram.tilt.as_ref().unwrap();
    assert_eq!((tilt.lamp_to_luminaire, tilt.factor(45.0)), (2, 0.9));
    close(tilt.factor(60.0), 0.9 - 0.1 / 3.0, 1e-12);
    assert_eq!([tilt.factor(-10.0), tilt.factor(100.0)], [1.0, 0.8]);
    assert_eq!(goniogram.peak(), 10.0);
}

/// A file that names another one for its tilt factors.
fn naming(tilt_file: &str) -> String {
    format!("IESNA:LM-63-1995\n[MANUFAC] test\nTILT={tilt_file}\n1 1000 1 2 1 1 2 0 0 0\n1 1 20\n0 90\n0\n10 10\n")
}

#[test]
fn tilt_factors_may_stand_in_a_file_beside() {
    for name in ["lamp.tlt", "C:\\TILTS\\lamp.tlt", "../../etc/lamp.tlt", "c:lamp.tlt"] {
        let mut asked = Vec::new();
        let mut beside = |name: &str| {
            asked.push(name.to_owned());
            Ok(b"2\r\n3\r\n0 45 90\r\n1 0.9 0.8\r\n\x1a".to_vec())
        };
        let goniogram = read_with(naming(name).as_bytes(), "lamp.ies", &mut beside).unwrap();
        assert_eq!(asked, ["lamp.tlt"]);
        assert_eq!(goniogram.warnings, []);
        assert_eq!(goniogram.tilted(45.0).unwrap().peak(), 9.0);
        assert_eq!(ies::read(&ies::write(&goniogram)).unwrap().tilt, goniogram.tilt);
    }
}

#[test]
fn without_its_tilt_file_a_luminaire_has_no_factors() {
    let warned = |name: &str, found: Result<&str, &str>| {
        let mut beside = |_: &str| found.map(|text| text.as_bytes().to_vec()).map_err(str::to_owned);
        let goniogram = read_with(naming(name).as_bytes(), "lamp.ies", &mut beside).unwrap();
        assert_eq!((goniogram.tilt, goniogram.intensities), (None, vec![10.0, 10.0]));
        assert_eq!(goniogram.warnings.len(), 1);
        goniogram.warnings[0].to_string()
    };
    assert_eq!(
        warned("lamp.tlt", Err("no such file")),
        "line 3: the TILT file 'lamp.tlt' cannot be read: no such file; TILT=NONE is taken"
    );
    for (text, problem) in [
        ("", "line 1: the file ends, expected the lamp-to-luminaire geometry"),
        ("1\n2\n0 90\n1 x\n", "line 4: 'x' was found, expected a tilt factor"),
        ("1\n2\n0 90\n1 -0.5\n", "line 4: a tilt factor is -0.5, expected 0 or more"),
        ("1\n2\n90 0\n1 1\n", "line 3: tilt angles do not increase"),
        (
            "1\n1000000000\n0 90\n1 1\n",
            "line 2: the number of tilt angles is 1000000000, expected a whole number from 1: the rest of the file has room for 5",
        ),
    ] {
        assert_eq!(warned("lamp.tlt", Ok(text)), format!("line 3: the TILT file 'lamp.tlt', {problem}; TILT=NONE is taken"));
    }
    for name in ["", "..", "tilts/", "/"] {
        assert!(warned(name, Ok("1\n1\n0\n1\n")).contains("this is no file's name"));
    }
    let from_memory = ies::read(naming("lamp.tlt").as_bytes()).unwrap();
    assert!(from_memory.warnings[0].to_string().contains("'lamp.tlt' cannot be read"), "{:?}", from_memory.warnings);
}

#[test]
fn types_are_told_apart() {
    for (code, photometric_type) in [(1, PhotometricType::C), (2, PhotometricType::B), (3, PhotometricType::A)] {
        let head = format!("1 -1 1 V H {code} 2 0 0 0");
        let text = ies_text("IESNA91", &head, "1 1 20", &[0.0, 90.0], &[0.0, 90.0], |_, _| 1.0);
        assert_eq!(ies::read(text.as_bytes()).unwrap().photometric_type, photometric_type);
    }
}

#[test]
fn lists_that_fall_or_repeat_are_mended_with_a_warning() {
    let falling = type_c(&[90.0, 45.0, 0.0], &[0.0], |_, gamma| gamma + 1.0);
    assert_eq!((falling.vertical, falling.intensities), (vec![0.0, 45.0, 90.0], vec![1.0, 46.0, 91.0]));
    let repeated = type_c(&[0.0, 45.0, 45.0, 90.0], &[0.0], |_, gamma| gamma + 1.0);
    assert_eq!((repeated.vertical.len(), repeated.intensities), (3, vec![1.0, 46.0, 91.0]));
    assert_eq!((falling.warnings.len(), repeated.warnings.len()), (1, 1));
}

#[test]
fn a_little_negative_light_is_none() {
    let goniogram = type_c(&[0.0, 45.0, 90.0], &[0.0], |_, gamma| if gamma == 90.0 { -0.5 } else { 100.0 });
    assert_eq!(goniogram.intensities[2], 0.0);
    assert_eq!(goniogram.warnings.len(), 1);
}
