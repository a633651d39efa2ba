//! Fits of surfaces whose parameters are known.

use core::f64::consts::PI;

use super::super::{Axis, Channels, Coordinates, Direction, Fit, Hemispheres, Layout, Measured, Mode, Rgl, RglGrid, Table};
use super::models::Ggx;

/// A fine table of a BRDF, isotropic or not.
fn table(coordinates: Coordinates, brdf: impl Fn(Direction, Direction) -> [f64; 3]) -> Measured {
    let theta = |n: usize| Axis::uniform(0.0, 89.5_f64.to_radians(), n, Mode::Linear).unwrap();
    let phi = |n: usize| Axis::uniform(0.0, 2.0 * PI * (n - 1) as f64 / n as f64, n, Mode::Periodic { period: 2.0 * PI }).unwrap();
    let axes = match coordinates {
        Coordinates::Isotropic => vec![theta(46), theta(46), phi(90)],
        _ => vec![theta(16), phi(24), theta(16), phi(24)],
    };
    let hemispheres = Hemispheres::ReflectionFront;
    let layout = Layout { coordinates, axes, channels: Channels::Rgb, hemispheres, reciprocal: true, bilateral: false };
    let fill = |wi, wo, out: &mut [f32]| out.iter_mut().zip(brdf(wi, wo)).for_each(|(out, v)| *out = v as f32);
    Measured::Tables(vec![Table::from_function(layout, fill).unwrap()])
}

fn assert_colour(fit: &Fit, expected: [f64; 3], tolerance: f64) {
    let near = fit.base_color.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < tolerance);
    assert!(near, "{fit:?}, expected {expected:?}");
}

#[test]
fn a_rough_metal_is_found() {
    // Alpha 0.3 of a single-scattering lobe: the surface that makes up for the rest has a darker colour and the same albedo.
    let fit = table(Coordinates::Isotropic, |wi, wo| Ggx::ISOTROPIC.brdf(wi, wo)).fit().unwrap();
    assert_eq!(fit.base_metalness, 1.0);
    assert!((fit.specular_roughness - 0.3_f64.sqrt()).abs() < 0.02, "{fit:?}");
    assert!(fit.albedo.iter().all(|row| row.measured.iter().zip(row.fitted).all(|(a, b)| (a - b).abs() < 0.02)), "{fit:?}");
    assert!(fit.residual < 0.02 && fit.specular_roughness_anisotropy == 0.0, "{fit:?}");
}

#[test]
fn the_long_way_of_an_anisotropic_metal_is_found() {
    // Wider along y: a quarter of a turn from the tangent.
    let fit = table(Coordinates::Anisotropic, |wi, wo| Ggx::ANISOTROPIC.brdf(wi, wo)).fit().unwrap();
    assert_eq!(fit.base_metalness, 1.0);
    assert!((fit.rotation_deg - 90.0).abs() < 3.0, "{fit:?}");
    // The widths are in the proportion of 1 − anisotropy.
    assert!((1.0 - fit.specular_roughness_anisotropy - 0.5).abs() < 0.06, "{fit:?}");
    let rms = (0.5 * (0.25_f64 * 0.25 + 0.5 * 0.5)).sqrt();
    assert!((fit.specular_roughness - rms.sqrt()).abs() < 0.03, "{fit:?}");
}

#[test]
fn a_matt_surface_has_no_interface() {
    let fit = table(Coordinates::Isotropic, |_, _| [0.6 / PI, 0.3 / PI, 0.1 / PI]).fit().unwrap();
    assert_colour(&fit, [0.6, 0.3, 0.1], 0.01);
    assert!(fit.base_metalness == 0.0 && fit.specular_ior < 1.05 && fit.residual < 0.01, "{fit:?}");
    for row in &fit.albedo {
        assert!(row.measured.iter().zip(row.fitted).all(|(a, b)| (a - b).abs() < 0.01), "{row:?}");
    }
}

#[test]
fn adaptive_measurements_are_fitted_too() {
    let grid = RglGrid::isotropic(12, 1.45, [96, 48], 32);
    let rgl = Rgl::from_function(&grid, "", |wi, wo| Ggx::ISOTROPIC.value(wi, wo)).unwrap();
    let fit = Measured::Rgl(Box::new(rgl)).fit().unwrap();
    assert!(fit.base_metalness == 1.0 && (fit.specular_roughness - 0.3_f64.sqrt()).abs() < 0.02, "{fit:?}");
}

#[test]
fn what_does_not_reflect_is_told() {
    let black = table(Coordinates::Isotropic, |_, _| [0.0; 3]);
    assert!(black.fit().unwrap_err().problem.contains("reflects nothing"));
}
