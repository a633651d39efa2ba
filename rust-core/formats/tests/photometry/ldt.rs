//! EULUMDAT's own ways.

use crate::{close, steps, type_c};
use gonio_formats::photometry::{Goniogram, Opening, OpeningShape, Symmetry, ldt};

/// What a test varies of an EULUMDAT file.
pub(crate) struct Text {
    pub(crate) symmetry: u32,
    pub(crate) planes: Vec<f64>,
    pub(crate) area: [&'static str; 6],
    pub(crate) ratios: [&'static str; 3],
    pub(crate) sets: Vec<[&'static str; 6]>,
}

impl Default for Text {
    fn default() -> Self {
        let planes = (0..12).map(|index| f64::from(index) * 30.0).collect();
        Self { symmetry: 0, planes, area: ["0"; 6], ratios: ["50", "100", "1"], sets: vec![["1", "LED", "1000", "3000", "80", "20"]] }
    }
}

impl Text {
    /// The file, with an isotropic source's right flux where `cd_per_klm` gives 79.577.
    pub(crate) fn write(&self, stored: &[f64], cd_per_klm: impl Fn(f64, f64) -> f64) -> String {
        let gammas: Vec<f64> = (0..=12).map(|index| f64::from(index) * 15.0).collect();
        let mut lines: Vec<String> =
            vec!["company".into(), "1".into(), self.symmetry.to_string(), self.planes.len().to_string(), "30".into()];
        lines.extend([gammas.len().to_string(), "15".into()]);
        lines.extend(["report", "name", "number", "file", "date", "1250", "310", "50"].map(String::from));
        lines.extend(self.area.iter().chain(&self.ratios).map(ToString::to_string));
        lines.extend(["0".to_owned(), self.sets.len().to_string()]);
        lines.extend(self.sets.iter().flatten().map(ToString::to_string));
        lines.extend((0..10).map(|_| "0.5".to_owned()));
        lines.extend(self.planes.iter().chain(&gammas).map(f64::to_string));
        for c in stored {
            lines.extend(gammas.iter().map(|gamma| cd_per_klm(*c, *gamma).to_string()));
        }
        lines.join("\r\n")
    }

    fn read(&self, stored: &[f64], cd_per_klm: impl Fn(f64, f64) -> f64) -> Goniogram {
        ldt::read(self.write(stored, cd_per_klm).as_bytes()).unwrap()
    }
}

/// 1000 lm in all directions, in cd/klm.
const ISOTROPIC: f64 = 1000.0 / (4.0 * std::f64::consts::PI);

fn thirties(from: i32, to: i32) -> Vec<f64> {
    (from..=to).map(|index| f64::from(index) * 30.0).collect()
}

#[test]
fn an_empty_file_ends_in_its_first_line() {
    assert_eq!(ldt::read(b"").unwrap_err().to_string(), "line 1: the file ends, expected the company");
}

#[test]
fn every_symmetry_stores_its_planes() {
    let value = |c: f64, gamma: f64| 100.0 + c.rem_euclid(360.0) + gamma / 10.0;
    for (symmetry, stored, found) in [
        (0, thirties(0, 11), Symmetry::None),
        (1, vec![0.0], Symmetry::Rotational),
        (2, thirties(0, 6), Symmetry::AboutC0),
        (3, thirties(9, 15), Symmetry::AboutC90),
        (4, thirties(0, 3), Symmetry::Quadrants),
    ] {
        let goniogram = Text { symmetry, ..Text::default() }.read(&stored, value);
        assert_eq!(goniogram.symmetry, found);
        for c in &stored {
            close(goniogram.intensity_at(*c, 45.0), value(*c, 45.0), 1e-12);
        }
    }
}

#[test]
fn flux_and_share_below_are_checked() {
    let right = Text::default().read(&thirties(0, 11), |_, _| ISOTROPIC);
    close(right.flux(), 1000.0, 1e-12);
    assert_eq!(right.warnings, []);
    let wrong = Text { ratios: ["80", "90", "1"], ..Text::default() }.read(&thirties(0, 11), |_, _| ISOTROPIC);
    let problems: Vec<String> = wrong.warnings.iter().map(ToString::to_string).collect();
    assert!(problems[0].contains("90.0000 % of 1000 lm") && problems[1].contains("50.0 %"), "{problems:?}");
}

#[test]
fn lamp_sets_are_alternatives() {
    let sets = vec![["1", "one", "1000", "3000", "80", "20"], ["2", "two", "2500", "4000", "90", "45"]];
    let goniogram = Text { sets, ..Text::default() }.read(&thirties(0, 11), |_, _| ISOTROPIC);
    close(goniogram.flux(), 1000.0, 1e-12);
    let other = goniogram.with_lamp_set(1).unwrap();
    close(other.flux(), 2500.0, 1e-12);
    close(other.figures().efficacy.unwrap(), 2500.0 / 45.0, 1e-12);
    close(other.with_lamp_set(0).unwrap().flux(), 1000.0, 1e-12);
    assert!(goniogram.with_lamp_set(2).is_err());
    assert_eq!(other.lamps().unwrap().colour, "4000");
}

#[test]
fn numbers_of_lamps_do_not_multiply_and_negative_ones_are_absolute() {
    let sets = vec![["-4", "LED", "500,5", "3000 K", "80", "20"]];
    let goniogram = Text { sets, ratios: ["50", "100", "2,0"], ..Text::default() }.read(&thirties(0, 11), |_, _| ISOTROPIC / 2.0);
    close(goniogram.flux(), 500.5, 1e-12);
    assert!(goniogram.lamps().unwrap().absolute);
    assert_eq!(goniogram.lamps().unwrap().count, 4);
}

#[test]
fn openings_by_area_and_heights() {
    for (area, shape, size) in [
        (["0", "0", "0", "0", "0", "0"], OpeningShape::Point, [0.0, 0.0, 0.0]),
        (["1200", "300", "0", "0", "0", "0"], OpeningShape::Rectangle, [0.3, 1.2, 0.0]),
        (["1200", "300", "10", "20", "10", "20"], OpeningShape::Box, [0.3, 1.2, 0.02]),
        (["200", "0", "0", "0", "0", "0"], OpeningShape::Disk, [0.2, 0.2, 0.0]),
        (["200", "0", "50", "50", "50", "50"], OpeningShape::VerticalCylinder, [0.2, 0.2, 0.05]),
    ] {
        let goniogram = Text { area, ..Text::default() }.read(&thirties(0, 11), |_, _| ISOTROPIC);
        assert_eq!(goniogram.opening.shape, shape);
        goniogram.opening.size.iter().zip(size).for_each(|(found, expected)| close(*found, expected, 1e-12));
    }
}

#[test]
fn angles_that_are_all_zero_follow_the_stated_steps() {
    let planes = vec![0.0; 12];
    let goniogram = Text { planes, symmetry: 4, ..Text::default() }.read(&thirties(0, 3), |_, _| ISOTROPIC);
    assert_eq!(goniogram.horizontal, thirties(0, 3));
    assert_eq!(goniogram.warnings.len(), 1);
}

#[test]
fn the_kind_is_one_of_three_whatever_the_symmetry() {
    let kind = |goniogram: &Goniogram| String::from_utf8(ldt::write(goniogram)).unwrap().lines().nth(1).unwrap().to_owned();
    let gammas = steps(0.0, 90.0, 18);
    let lobe = |gamma: f64| 100.0 * gamma.to_radians().cos().max(0.0);
    let round = type_c(&gammas, &[0.0], |_, gamma| lobe(gamma));
    let quarter = type_c(&gammas, &[0.0, 45.0, 90.0], |c, gamma| lobe(gamma) * (1.0 + c / 90.0));
    let crooked = type_c(&gammas, &[0.0, 90.0, 180.0, 270.0], |c, gamma| lobe(gamma) * (1.0 + c / 90.0));
    assert_eq!(crooked.symmetry, Symmetry::None);
    for (goniogram, points) in [(&round, "1"), (&quarter, "3"), (&crooked, "3")] {
        assert_eq!(kind(goniogram), points);
        let mut long = goniogram.clone();
        // Rotational symmetry is that of a point source, however long the luminaire is.
        let linear = if points == "1" { "1" } else { "2" };
        for shape in [OpeningShape::Rectangle, OpeningShape::Box, OpeningShape::CylinderAlongY] {
            long.opening = Opening::new(shape, [0.1, 1.2, 0.1]);
            assert_eq!(kind(&long), linear, "{shape:?}");
        }
        // Without an opening the body tells.
        long.opening = Opening::default();
        long.body = [1.2, 0.1, 0.1];
        assert_eq!(kind(&long), linear);
        long.body = [1.2, 0.0, 0.1];
        assert_eq!(kind(&long), points);
    }
}

#[test]
fn ellipses_become_rectangles_of_their_area() {
    let mut goniogram = type_c(&steps(0.0, 90.0, 18), &[0.0, 90.0], |c, gamma| 100.0 * gamma.to_radians().cos().max(0.0) * (1.0 + c));
    goniogram.opening = Opening::new(OpeningShape::Disk, [0.2, 0.3, 0.0]);
    let again = ldt::read(&ldt::write(&goniogram)).unwrap();
    let down = [0.0, 0.0, -1.0];
    close(again.opening.projected_area(down), goniogram.opening.projected_area(down), 1e-9);
    close(again.opening.size[1] / again.opening.size[0], 1.5, 1e-9);
}
