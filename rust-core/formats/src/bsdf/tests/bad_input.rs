//! Broken files: one error each, with a place.

use super::super::gbsdf::{self, Encoding};
use super::super::{Axis, Channels, Coordinates, Hemispheres, Layout, Mode, Table, merl, read, utia, xml, zemax};
use super::{klems, rgl, trees};
use crate::error::Place;

/// The error of bytes that are no sound file.
fn error(bytes: &[u8]) -> crate::FormatError {
    read(bytes, "broken").expect_err("expected an error")
}

fn table(coordinates: Coordinates) -> Table {
    let axis = |n: usize| Axis::uniform(0.0, 1.2, n, Mode::Linear).unwrap();
    let axes = coordinates.axis_names().iter().map(|_| axis(3)).collect();
    let (channels, hemispheres) = (Channels::Luminance, Hemispheres::ReflectionFront);
    let layout = Layout { coordinates, axes, channels, hemispheres, reciprocal: false, bilateral: true };
    let count = layout.value_count().unwrap();
    Table::new(layout, vec![0.25; count]).unwrap()
}

/// A small file of each format.
fn files() -> Vec<Vec<u8>> {
    let merl = merl::layout([2, 3, 4]).unwrap();
    let merl = Table::new(merl, vec![0.1; 72]).unwrap();
    vec![
        gbsdf::write(&[table(Coordinates::Isotropic)], "a title", Encoding::Text),
        gbsdf::write(&[table(Coordinates::Isotropic)], "a title", Encoding::Binary),
        merl::write(&merl).unwrap(),
        rgl::small().write(),
        zemax::write(&table(Coordinates::Specular)).unwrap().into_bytes(),
        xml::write_patches(&klems::blind(), "a blind").into_bytes(),
        xml::write_tree(&trees::material(3), "a tree").into_bytes(),
    ]
}

#[test]
fn truncated_files() {
    for file in files() {
        read(&file, "whole").unwrap();
        for i in 0..40 {
            // All lengths near the beginning, some of the rest; the last byte may be white space.
            let length = if i < 20 { i * 7 } else { (file.len() - 8) * (i - 19) / 20 };
            error(&file[..length.min(file.len() - 8)]);
        }
    }
}

#[test]
fn changed_bytes_never_panic() {
    let mut random = super::Random(59);
    for file in files() {
        for _ in 0..100 {
            let mut broken = file.clone();
            for _ in 0..1 + (4.0 * random.next()) as usize {
                let at = (random.next() * broken.len().min(4000) as f64) as usize;
                broken[at] = (256.0 * random.next()) as u8;
            }
            drop(read(&broken, "broken.binary"));
        }
    }
}

#[test]
fn unknown_files() {
    for bytes in [&b""[..], b"\0", b"GIF89a", b"tensor_fil", &[0xff; 100], b"some text"] {
        assert!(error(bytes).problem.contains("not a measured material"));
    }
    assert_eq!(error(b"tensor_file\0\x02\0\0\0\0\0").place, Some(Place::Byte(12)));
    assert!(merl::read(&[1, 2, 3]).is_err());
    assert!(utia::read(&[0; 8]).is_err());
    assert!(read(&[0; 100], "x.binary").unwrap_err().to_string().starts_with("byte 0: lengths [0, 0, 0] do not fit 100 bytes"));
}

#[test]
fn claims_larger_than_the_file() {
    // Forty gigabytes in a hundred bytes, and products that overflow.
    let mut merl: Vec<u8> = [1400_i32, 1400, 850].iter().flat_map(|n| n.to_le_bytes()).collect();
    merl.resize(100, 0);
    assert!(read(&merl, "x.binary").unwrap_err().problem.contains("[1400, 1400, 850]"));
    for n in [i32::MAX, -1] {
        let mut merl: Vec<u8> = [n; 3].iter().flat_map(|n| n.to_le_bytes()).collect();
        merl.resize(100, 0);
        assert!(read(&merl, "x.binary").is_err());
    }
    for shape in [[1 << 40, 1], [u64::MAX, u64::MAX], [1 << 33, 1 << 33]] {
        let mut tensor = b"tensor_file\0\x01\0\x01\0\0\0\x01\0x\x02\0\x0a".to_vec();
        tensor.extend(0_u64.to_le_bytes());
        shape.iter().for_each(|n: &u64| tensor.extend(n.to_le_bytes()));
        assert!(matches!(error(&tensor).place, Some(Place::Byte(_))));
    }
    let text = "gbsdf 1\ntable reflection-front isotropic\naxis theta_i linear 99999999999\n0 1";
    assert_eq!(error(text.as_bytes()).place, Some(Place::Line(3)));
    let axis = "axis theta_i linear 2\n0 90\naxis theta_o linear 2\n0 90\naxis delta_phi linear 2\n0 180\n";
    for encoding in ["text", "f32", "f64"] {
        let text = format!("gbsdf 1\ntable reflection-front isotropic\n{axis}values {encoding}\n1 2 3");
        error(text.as_bytes());
    }
    let zemax = "Source Measured\nSymmetry PlaneSymmetrical\nSampleRotation 1\n0\nAngleOfIncidence 1e12\n0 1";
    assert_eq!(error(zemax.as_bytes()).place, Some(Place::Line(5)));
}

#[test]
fn axes_that_do_not_increase() {
    for knots in [vec![], vec![0.0, 0.0], vec![1.0, 0.5], vec![f64::NAN], vec![0.0, f64::INFINITY]] {
        assert!(Axis::new(knots, Mode::Linear).is_err());
    }
    assert!(Axis::new(vec![0.0, 6.0], Mode::Periodic { period: 5.5 }).is_err());
    assert!(Axis::new(vec![0.0, 1.0], Mode::Periodic { period: f64::NAN }).is_err());
    let good = String::from_utf8(gbsdf::write(&[table(Coordinates::Isotropic)], "", Encoding::Text)).unwrap();
    let broken = good.replacen("linear 3\n0 ", "linear 3\n60 ", 1);
    let error = error(broken.as_bytes());
    assert!(error.problem.contains("theta_i") && error.problem.contains("strictly increasing"), "{error}");
}

#[test]
fn values_that_are_none() {
    let good = String::from_utf8(gbsdf::write(&[table(Coordinates::Isotropic)], "", Encoding::Text)).unwrap();
    for (bad, problem) in [("-1.0", "expected zero or more"), ("inf", "expected zero or more"), ("x", "expected a value")] {
        let error = error(good.replacen("0.25", bad, 1).as_bytes());
        assert!(error.problem.contains(problem), "{error}");
    }
    assert!(read(good.replacen("0.25", "nan", 1).as_bytes(), "").is_ok());
    let mut rgl = rgl::small();
    rgl.spectra.data[5] = f32::NAN;
    assert!(matches!(error(&rgl.write()).place, Some(Place::Byte(_))));
    let mut merl = merl::write(&Table::new(merl::layout([1, 1, 1]).unwrap(), vec![0.1; 3]).unwrap()).unwrap();
    merl[20..28].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_eq!(error(&merl).place, Some(Place::Byte(20)));
}

#[test]
fn xml_that_lacks_something() {
    let good = xml::write_patches(&klems::blind(), "");
    let broken = [
        ("<Optical>", "<Opticals>"),
        ("</Layer>", ""),
        ("Columns", "Diagonals"),
        ("<ColumnAngleBasis>LBNL/Klems Full", "<ColumnAngleBasis>unheard of"),
        ("Reflection Back", "Reflection Sideways"),
        ("<nPhis>5", "<nPhis>-5"),
        ("<nPhis>5", "<nPhis>5e9"),
        ("<UpperTheta>60", "<UpperTheta>20"),
        ("<ScatteringData>\n", "<ScatteringData>\nx"),
        ("<ScatteringData>\n", "<ScatteringData>\n0 "),
    ];
    for (from, to) in broken {
        assert!(good.contains(from), "{from}");
        let error = error(good.replacen(from, to, 1).as_bytes());
        assert!(matches!(error.place, Some(Place::Line(_))), "{to}: {error}");
    }
    let tree = xml::write_tree(&trees::material(3), "");
    for (from, to) in [("LBNL/Shirley-Chiu", "LBNL/Klems Full"), ("{", ""), ("}", ""), ("{", "{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{{")] {
        let error = error(tree.replacen(from, to, 1).as_bytes());
        assert!(matches!(error.place, Some(Place::Line(_))), "{to}: {error}");
    }
}
