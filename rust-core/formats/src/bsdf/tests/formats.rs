//! Files of tables, written and read back.

use core::f64::consts::{PI, TAU};

use super::super::gbsdf::{self, Encoding};
use super::super::{Axis, Channels, Coordinates, Hemispheres, Layout, Measured, Mode, Table, merl, read, utia, zemax};
use super::Random;
use super::models::Ggx;

/// The table that `docs/bsdf-formats.md` shows.
const DOCUMENT: &str = include_str!("../../../../../docs/bsdf-formats.md");

fn degrees(list: &[f64], mode: Mode) -> Axis {
    Axis::new(list.iter().map(|d| d.to_radians()).collect(), mode).unwrap()
}

/// A coloured surface on given axes.
fn surface(coordinates: Coordinates, axes: Vec<Axis>, channels: Channels, bilateral: bool) -> Table {
    let ggx = Ggx { diffuse: 0.2, ..Ggx::ISOTROPIC };
    let hemispheres = Hemispheres::ReflectionFront;
    let layout = Layout { coordinates, axes, channels, hemispheres, reciprocal: true, bilateral };
    let fill = |wi, wo, out: &mut [f32]| out.iter_mut().zip(ggx.brdf(wi, wo)).for_each(|(out, v)| *out = v as f32);
    Table::from_function(layout, fill).unwrap()
}

fn isotropic() -> Table {
    let theta = degrees(&[0.0, 7.5, 20.0, 45.0, 80.0], Mode::Linear);
    let phi = degrees(&[0.0, 30.0, 170.0, 180.0, 250.0], Mode::Periodic { period: TAU });
    surface(Coordinates::Isotropic, vec![theta.clone(), theta, phi], Channels::Rgb, false)
}

/// The tables of bytes that [`read`] understands.
fn tables(bytes: &[u8]) -> Vec<Table> {
    match read(bytes, "a file") {
        Ok(Measured::Tables(tables)) => tables,
        other => panic!("expected tables, found {other:?}"),
    }
}

/// The same values, and the same axes to the last digits that degrees have in a file.
fn assert_same(a: &Table, b: &Table, tolerance: f32) {
    let (x, y) = (a.layout(), b.layout());
    assert_eq!((x.coordinates, &x.channels, x.hemispheres), (y.coordinates, &y.channels, y.hemispheres));
    for (x, y) in x.axes.iter().zip(&y.axes) {
        assert_eq!(x.knots().len(), y.knots().len());
        assert!(x.knots().iter().zip(y.knots()).all(|(x, y)| (x - y).abs() < 1e-9), "{x:?} {y:?}");
    }
    let near = |x: f32, y: f32| x.is_nan() && y.is_nan() || (x - y).abs() <= tolerance * x.abs();
    assert!(a.values().iter().zip(b.values()).all(|(&x, &y)| near(x, y)));
}

#[test]
fn our_own_files_come_back() {
    let mut values = isotropic().values().to_vec();
    values[3..6].fill(f32::NAN);
    let front = Table::new(isotropic().layout().clone(), values).unwrap();
    let back =
        Table::new(Layout { hemispheres: Hemispheres::TransmissionBack, ..front.layout().clone() }, front.values().to_vec()).unwrap();
    for encoding in [Encoding::Text, Encoding::Binary] {
        let file = gbsdf::write(&[front.clone(), back.clone()], "two\nsides", encoding);
        let found = tables(&file);
        assert_eq!(found.len(), 2);
        for (found, table) in found.iter().zip([&front, &back]) {
            assert_same(found, table, 0.0);
            assert_eq!((found.layout().reciprocal, found.layout().bilateral), (true, false));
        }
    }
}

#[test]
fn bands_and_other_modes_come_back() {
    let theta = degrees(&[0.0, 60.0], Mode::Nearest);
    let phi = degrees(&[0.0, 90.0, 180.0], Mode::Linear);
    let channels = Channels::bands(vec![400.0, 555.5]).unwrap();
    let table = surface(Coordinates::Isotropic, vec![theta.clone(), theta, phi], channels, true);
    let found = tables(&gbsdf::write(std::slice::from_ref(&table), "", Encoding::Text));
    assert_same(&found[0], &table, 0.0);
    assert_eq!(found[0].layout().axes[0].mode(), Mode::Nearest);
    assert!(found[0].layout().bilateral);
}

#[test]
fn the_documents_example_is_a_file() {
    let example = DOCUMENT.split("```gbsdf\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let found = tables(example.as_bytes());
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].layout().hemispheres, Hemispheres::ReflectionFront);
    assert_eq!(found[0].layout().channels, Channels::Rgb);
    assert_eq!(found[0].invalid_cells(), 1);
    assert_eq!(found[1].layout().hemispheres, Hemispheres::TransmissionFront);
}

#[test]
fn merl_files_come_back() {
    // Half a turn of reciprocal data, and a full turn.
    for bins in [[9, 9, 18], [5, 6, 360]] {
        let layout = merl::layout(bins).unwrap();
        let table = surface(Coordinates::HalfDifference, layout.axes.clone(), Channels::Rgb, false);
        let table = Table::new(layout, table.values().to_vec()).unwrap();
        assert!(table.invalid_cells() > 0);
        let file = merl::write(&table).unwrap();
        assert_eq!(file.len(), 12 + 24 * bins.iter().product::<usize>());
        assert_same(&tables(&file)[0], &table, 1e-6);

        // The same numbers in single precision.
        let mut single = file[..12].to_vec();
        file[12..].chunks_exact(8).for_each(|b| single.extend((f64::from_le_bytes(b.try_into().unwrap()) as f32).to_le_bytes()));
        assert_same(&tables(&single)[0], &table, 1e-6);
    }
}

#[test]
fn utia_files_come_back_and_go_on_to_the_horizon() {
    let table = surface(Coordinates::Anisotropic, utia::layout().unwrap().axes, Channels::Rgb, false);
    let table = Table::new(utia::layout().unwrap(), table.values().to_vec()).unwrap();
    let found = tables(&utia::write(&table).unwrap());
    let mut random = Random(13);
    let [a, b] = [table, found[0].clone()].map(|table| Measured::Tables(vec![table]));
    let below_75 = |d: [f64; 3]| d[2] > 75_f64.to_radians().cos();
    let mut compared = 0;
    while compared < 500 {
        let (wi, wo) = (random.direction(), random.direction());
        if below_75(wi) && below_75(wo) {
            let (x, y) = (a.eval_luminance(wi, wo), b.eval_luminance(wi, wo));
            assert!((x - y).abs() <= 1e-5 * x, "{x} {y}");
            compared += 1;
        }
    }
    // The straight line through the last two angles.
    let at = |theta: f64| {
        let wi = super::super::direction::spherical(f64::to_radians(theta), 0.0);
        b.eval_luminance(wi, [0.0, 0.0, 1.0]) / wi[2]
    };
    let line = at(75.0) + (at(75.0) - at(60.0)) * 10.0 / 15.0;
    assert!((at(85.0) - line.max(0.0)).abs() < 1e-4 * at(75.0), "{} and {line}", at(85.0));
}

#[test]
fn zemax_files_come_back() {
    let radial = || degrees(&[0.0, 1.0, 3.0, 10.0, 40.0, 90.0, 180.0], Mode::Linear);
    let theta = || degrees(&[0.0, 15.0, 60.0], Mode::Linear);
    let half = degrees(&[0.0, 45.0, 180.0], Mode::Linear);
    let turn = degrees(&[0.0, 90.0, 180.0, 270.0], Mode::Periodic { period: TAU });
    for (rotations, azimuth, channels, bilateral) in
        [(degrees(&[0.0], Mode::Linear), half, Channels::Luminance, true), (turn.clone(), turn, Channels::Xyz, false)]
    {
        let table = surface(Coordinates::Specular, vec![rotations, theta(), azimuth, radial()], channels, bilateral);
        let values = table.values().iter().map(|v| if v.is_nan() { 0.0 } else { *v }).collect();
        let table = Table::new(table.layout().clone(), values).unwrap();
        let text = zemax::write(&table).unwrap();
        let found = tables(text.as_bytes());
        assert_same(&found[0], &table, 0.0);
        assert_eq!(found[0].layout().axes, table.layout().axes);
        assert_eq!(found[0].layout().bilateral, bilateral);
    }
}

#[test]
fn zemax_angles_are_about_the_specular_direction() {
    // A lobe that is 1 at the specular direction, and at 20° from it only towards the normal.
    let text = "# a comment\nSource\tMeasured\nSymmetry\tPlaneSymmetrical\nSpectralContent\tMonochrome\nScatterType\tBTDF\n\
        SampleRotation\t1\n0\nAngleOfIncidence\t1\n30\nScatterAzimuth\t2\n0 180\nScatterRadial\t3\n0 20 90\n\nMonochrome\nDataBegin\n\
        TIS 0.5\n1 1 0\n1 0 0\nDataEnd\n";
    let material = Measured::Tables(tables(text.as_bytes()));
    let direction = |theta: f64, phi: f64| super::super::direction::spherical(f64::to_radians(theta), phi);
    let wi = direction(30.0, 0.4);
    for (theta, expected) in [(30.0, 1.0), (10.0, 1.0), (50.0, 0.0)] {
        let wo = super::super::direction::through(direction(theta, 0.4 + PI));
        let value = material.eval_luminance(wi, wo) / wi[2];
        assert!((value - expected).abs() < 1e-6, "{value} at {theta}°");
    }
}
