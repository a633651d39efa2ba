//! Tables: lookup, coordinates, albedo, reciprocity.

use core::f64::consts::{PI, TAU};

use super::super::direction::{spherical, through};
use super::super::{Axis, Channels, Coordinates, Grid, Hemispheres, Layout, Measured, Mode, Table, merl};
use super::Random;
use super::models::Ggx;

fn uniform(first_deg: f64, last_deg: f64, count: usize, mode: Mode) -> Axis {
    Axis::uniform(first_deg.to_radians(), last_deg.to_radians(), count, mode).unwrap()
}

/// Axes for coordinates, with uneven steps.
fn axes(coordinates: Coordinates) -> Vec<Axis> {
    let theta = || Axis::new([0.0, 10.0, 25.0, 45.0, 70.0, 90.0_f64].map(f64::to_radians).to_vec(), Mode::Linear).unwrap();
    let phi = || uniform(0.0, 330.0, 12, Mode::Periodic { period: TAU });
    match coordinates {
        Coordinates::Isotropic => vec![theta(), theta(), phi()],
        Coordinates::Anisotropic => vec![theta(), phi(), theta(), phi()],
        Coordinates::HalfDifference => vec![theta(), theta(), uniform(0.0, 165.0, 12, Mode::Periodic { period: PI })],
        Coordinates::Specular => vec![uniform(0.0, 0.0, 1, Mode::Linear), theta(), phi(), uniform(0.0, 180.0, 10, Mode::Linear)],
    }
}

fn layout(coordinates: Coordinates, channels: Channels, hemispheres: Hemispheres) -> Layout {
    Layout { coordinates, axes: axes(coordinates), channels, hemispheres, reciprocal: false, bilateral: false }
}

#[test]
fn coordinates_and_directions_are_inverse() {
    let mut random = Random(1);
    for coordinates in Coordinates::ALL {
        for _ in 0..1000 {
            let (wi, wo) = (random.direction(), random.direction());
            let (ti, to) = coordinates.directions(&coordinates.of(wi, wo, false));
            let [a, b] = [(wi, wo), (ti, to)].map(|(i, o)| [i[2], o[2], i[0] * o[0] + i[1] * o[1], i[0] * o[1] - i[1] * o[0]]);
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{coordinates:?}: {a:?} {b:?}");
        }
    }
}

#[test]
fn a_lambertian_table_has_its_albedo() {
    for coordinates in Coordinates::ALL {
        for hemispheres in Hemispheres::ALL {
            let table = Table::from_function(layout(coordinates, Channels::Rgb, hemispheres), |_, _, out| {
                out.copy_from_slice(&[0.2, 0.5, 0.8].map(|rho: f32| rho / core::f32::consts::PI));
            });
            let material = Measured::Tables(vec![table.unwrap()]);
            for theta in [0.0, 0.5, 1.2] {
                let up = spherical(theta, 0.7);
                let albedo = material.albedo(if hemispheres.is_from_front() { up } else { through(up) });
                let (some, none) = if hemispheres.is_reflection() {
                    (albedo.reflected, albedo.transmitted)
                } else {
                    (albedo.transmitted, albedo.reflected)
                };
                for (found, rho) in some.iter().zip([0.2, 0.5, 0.8]) {
                    assert!((found - rho).abs() < 1e-3, "{coordinates:?} {hemispheres:?} at {theta}: {found}, expected {rho}");
                }
                assert_eq!(none, [0.0; 3]);
            }
            let reciprocity = material.reciprocity();
            if hemispheres.is_reflection() {
                assert!(reciprocity.unwrap().largest_difference < 1e-6);
            } else {
                assert_eq!(reciprocity, None);
            }
        }
    }
}

#[test]
fn one_side_is_one_side() {
    let table =
        Table::from_function(layout(Coordinates::Isotropic, Channels::Luminance, Hemispheres::TransmissionBack), |_, _, out| out[0] = 1.0);
    let material = Measured::Tables(vec![table.unwrap()]);
    let (up, down) = (spherical(0.3, 0.0), through(spherical(0.4, 1.0)));
    assert!((material.eval_luminance(down, up) - 0.4_f64.cos()).abs() < 1e-9);
    for (wi, wo) in [(up, down), (up, up), (down, down)] {
        assert_eq!(material.eval_luminance(wi, wo), 0.0);
    }
}

#[test]
fn merl_is_exact_at_centres_and_linear_between() {
    let ggx = Ggx { diffuse: 0.1, ..Ggx::ISOTROPIC };
    let layout = merl::layout([12, 10, 16]).unwrap();
    let table = Table::from_function(layout.clone(), |wi, wo, out| {
        out.iter_mut().zip(ggx.brdf(wi, wo)).for_each(|(out, v)| *out = v as f32);
    });
    let table = merl::read(&merl::write(&table.unwrap()).unwrap()).unwrap();
    let material = Measured::Tables(vec![table]);
    let eval = |place: &[f64]| {
        let (wi, wo) = Coordinates::HalfDifference.directions(place);
        material.eval_rgb(wi, wo).map(|v| v / wi[2])
    };
    let knots = |axis: usize, i: usize| layout.axes[axis].knots()[i];
    for (h, d, p) in (0..6).flat_map(|h| (0..5).flat_map(move |d| (0..15).map(move |p| (h, d, p)))) {
        let at = |dh: f64, dp: f64| {
            [knots(0, h) + dh * (knots(0, h + 1) - knots(0, h)), knots(1, d), knots(2, p) + dp * (knots(2, p + 1) - knots(2, p))]
        };
        let (wi, wo) = Coordinates::HalfDifference.directions(&at(0.0, 0.0));
        if wi[2] < 0.5 || wo[2] < 0.5 {
            continue;
        }
        let (centre, next, beside, between) = (eval(&at(0.0, 0.0)), eval(&at(1.0, 0.0)), eval(&at(0.0, 1.0)), eval(&at(0.25, 0.0)));
        for c in 0..3 {
            let exact = ggx.brdf(wi, wo)[c];
            assert!((centre[c] / exact - 1.0).abs() < 1e-6, "{} at a centre, expected {exact}", centre[c]);
            let line = 0.75 * centre[c] + 0.25 * next[c];
            assert!((between[c] / line - 1.0).abs() < 1e-6, "{} between, expected {line}", between[c]);
            let line = 0.5 * (centre[c] + beside[c]);
            assert!((eval(&at(0.0, 0.5))[c] / line - 1.0).abs() < 1e-6);
        }
    }
}

#[test]
fn invalid_cells_are_left_out() {
    let axis = |n: usize| uniform(0.0, 80.0, n, Mode::Linear);
    let axes = vec![axis(2), axis(2), uniform(0.0, 0.0, 1, Mode::Linear)];
    let part = |reciprocal| Layout {
        coordinates: Coordinates::Isotropic,
        axes: axes.clone(),
        channels: Channels::Luminance,
        hemispheres: Hemispheres::ReflectionFront,
        reciprocal,
        bilateral: false,
    };
    let eval = |table: Table, ti: f64, to: f64| {
        let (wi, wo) = (spherical(f64::to_radians(ti), 0.0), spherical(f64::to_radians(to), 0.0));
        Measured::Tables(vec![table]).eval_luminance(wi, wo) / wi[2]
    };
    let table = |reciprocal| Table::new(part(reciprocal), vec![2.0, f32::NAN, 4.0, f32::NAN]).unwrap();
    assert_eq!(table(false).invalid_cells(), 2);
    // Halfway in both: the two valid corners with equal weights.
    assert!((eval(table(false), 40.0, 40.0) - 3.0).abs() < 1e-9);
    assert_eq!(eval(table(false), 0.0, 80.0), 0.0);
    // What one way was not measured is there the other way.
    assert!((eval(table(true), 0.0, 80.0) - 4.0).abs() < 1e-9);
}

#[test]
fn modes_of_an_axis() {
    let values = |mode: Mode, phi_deg: f64| {
        let axes = vec![uniform(0.0, 0.0, 1, Mode::Linear), uniform(0.0, 0.0, 1, Mode::Linear), uniform(0.0, 270.0, 4, mode)];
        let layout = Layout {
            coordinates: Coordinates::Isotropic,
            axes,
            channels: Channels::Luminance,
            hemispheres: Hemispheres::ReflectionFront,
            reciprocal: false,
            bilateral: false,
        };
        let material = Measured::Tables(vec![Table::new(layout, vec![0.0, 1.0, 2.0, 3.0]).unwrap()]);
        let (wi, wo) = (spherical(0.3, 0.4), spherical(0.3, 0.4 + phi_deg.to_radians()));
        material.eval_luminance(wi, wo) / wi[2]
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a}, expected {b}");
    near(values(Mode::Periodic { period: TAU }, 315.0), 1.5);
    near(values(Mode::Periodic { period: TAU }, -45.0), 1.5);
    near(values(Mode::Linear, 45.0), 0.5);
    // In the gap of an axis that is no full turn the nearer end holds.
    near(values(Mode::Linear, 300.0), 3.0);
    near(values(Mode::Linear, 350.0), 0.0);
    near(values(Mode::Nearest, 50.0), 1.0);
    near(values(Mode::Nearest, 40.0), 0.0);
}

#[test]
fn half_of_a_bilateral_material_is_enough() {
    let ggx = Ggx::ANISOTROPIC;
    let theta = || uniform(0.0, 85.0, 6, Mode::Linear);
    let whole = uniform(0.0, 345.0, 24, Mode::Periodic { period: TAU });
    let table = |phi: Axis, bilateral| {
        let layout = Layout {
            coordinates: Coordinates::Anisotropic,
            axes: vec![theta(), phi, theta(), whole.clone()],
            channels: Channels::Rgb,
            hemispheres: Hemispheres::ReflectionFront,
            reciprocal: false,
            bilateral,
        };
        let fill = |wi, wo, out: &mut [f32]| out.iter_mut().zip(ggx.brdf(wi, wo)).for_each(|(out, v)| *out = v as f32);
        Measured::Tables(vec![Table::from_function(layout, fill).unwrap()])
    };
    let (full, half) = (table(whole.clone(), false), table(uniform(0.0, 180.0, 13, Mode::Linear), true));
    let mut random = Random(3);
    for _ in 0..1000 {
        let (wi, wo) = (random.direction(), random.direction());
        let (a, b) = (full.eval_luminance(wi, wo), half.eval_luminance(wi, wo));
        assert!((a - b).abs() < 1e-5 * a, "{a} {b} at {wi:?} {wo:?}");
    }
}

#[test]
fn a_resampled_material_is_the_material_at_knots() {
    let material = Measured::Rgl(Box::new(super::rgl::small()));
    let tables = material.resampled(Grid { theta: 9, phi: 8, isotropic: true }).unwrap();
    assert_eq!(tables.len(), 1);
    let resampled = Measured::Tables(tables);
    for (ti, to, phi) in [(2.0, 3.0, 3.0), (0.0, 1.0, 0.0), (5.0, 5.0, 4.0)] {
        let angle = |i: f64| i * PI / 16.0;
        let (wi, wo) = (spherical(angle(ti), 0.0), spherical(angle(to), phi * TAU / 8.0));
        let (a, b) = (material.eval_luminance(wi, wo), resampled.eval_luminance(wi, wo));
        assert!((a - b).abs() <= 1e-6 * a, "{a} {b}");
    }
}
