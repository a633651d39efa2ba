//! Figures and drawings of known surfaces.

use core::f64::consts::PI;

use super::super::{Axis, Channels, Coordinates, Figures, Hemispheres, Layout, Measured, Mode, Table, lobe_diagram, lobe_map};
use super::klems::blind;

/// An isotropic table of angles in degrees with one value for each pair of polar angles, from light's and view's number.
fn flat(hemispheres: Hemispheres, theta: &[f64], value: impl Fn(usize, usize) -> f32) -> Table {
    let theta = || Axis::new(theta.iter().map(|t| t.to_radians()).collect(), Mode::Linear).unwrap();
    let axes = vec![theta(), theta(), Axis::new(vec![0.0], Mode::Nearest).unwrap()];
    let values = (0..axes[0].knots().len()).flat_map(|i| (0..axes[1].knots().len()).map(move |o| (i, o)));
    let values = values.map(|(i, o)| value(i, o)).collect();
    let channels = Channels::Luminance;
    let layout = Layout { coordinates: Coordinates::Isotropic, axes, channels, hemispheres, reciprocal: false, bilateral: false };
    Table::new(layout, values).unwrap()
}

fn figures(tables: Vec<Table>) -> Figures {
    Measured::Tables(tables).figures()
}

#[test]
fn a_lambertian_surface_has_its_albedo_and_no_problem() {
    let found = figures(vec![flat(Hemispheres::ReflectionFront, &[0.0, 90.0], |_, _| (0.5 / PI) as f32)]);
    assert!(found.problems.is_empty(), "{:?}", found.problems);
    assert_eq!(found.albedo.len(), 7);
    for row in &found.albedo {
        assert!((row.reflected.luminance - 0.5).abs() < 1e-3 && row.transmitted.luminance == 0.0, "{row:?}");
        assert!(row.from_front && (row.reflected.rgb[2] - 0.5).abs() < 1e-3);
    }
    assert!(found.reciprocity.unwrap().largest_difference < 1e-9);
}

#[test]
fn problems_are_told() {
    // Brighter for slanted light than for slanted view, beyond all energy, with a hole, up to 60°.
    let value = |i: usize, o: usize| if (i, o) == (0, 0) { f32::NAN } else { 0.4 + 0.3 * i as f32 };
    let problems = figures(vec![flat(Hemispheres::TransmissionFront, &[0.0, 30.0, 60.0], value)]).problems;
    let all = problems.join("\n");
    for part in ["more light leaves than arrives", "1 of 9 cells", "theta_i ends at 60.0°", "theta_o ends at 60.0°"] {
        assert!(all.contains(part), "{part} in {all}");
    }
    let value = |i: usize, _: usize| 0.1 + 0.1 * i as f32;
    let reflection = figures(vec![flat(Hemispheres::ReflectionFront, &[0.0, 90.0], value)]).problems;
    assert!(reflection[0].contains("not reciprocal"), "{reflection:?}");
    let black = figures(vec![flat(Hemispheres::ReflectionFront, &[0.0, 90.0], |_, _| 0.0)]).problems;
    assert_eq!(black, ["nothing scatters"]);
}

#[test]
fn matrices_are_told_for_both_sides_and_azimuths() {
    let found = Measured::Patches(blind()).figures();
    assert_eq!(found.albedo.len(), 2 * 2 * 7);
    let back = found.albedo.iter().find(|row| !row.from_front).unwrap();
    assert!(back.reflected.luminance == 0.0 && back.transmitted.luminance > 0.0);
}

#[test]
fn drawings_are_documents_with_their_scales() {
    let front = flat(Hemispheres::ReflectionFront, &[0.0, 90.0], |_, o| 2.0 + o as f32);
    let back = flat(Hemispheres::TransmissionFront, &[0.0, 90.0], |_, _| 0.001);
    let dark = flat(Hemispheres::ReflectionFront, &[0.0, 90.0], |_, _| 0.0);
    for tables in [vec![front.clone()], vec![front, back], vec![dark]] {
        let material = Measured::Tables(tables);
        for svg in [lobe_diagram(&material, "a <b>"), lobe_map(&material, "a <b>")] {
            roxmltree::Document::parse(&svg).unwrap();
            assert!(svg.contains("a &lt;b&gt;") && svg.contains("light at 75°"));
            // Up to 3 /sr: the scale ends at the next power of ten.
            assert!(!material.has(Hemispheres::TransmissionFront) || svg.contains(">10<") && svg.contains(">0.01<"), "{svg}");
        }
    }
}
