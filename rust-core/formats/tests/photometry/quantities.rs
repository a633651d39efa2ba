//! Flux, intensity and symmetry by closed forms.

use crate::{close, ies_text, quadrature, steps, type_c};
use gonio_formats::photometry::{Goniogram, PhotometricType, Symmetry, ies};
use std::f64::consts::PI;

/// A goniogram of type A or B.
fn crossed(code: u32, vertical: &[f64], horizontal: &[f64], candela: impl Fn(f64, f64) -> f64) -> Goniogram {
    let head = format!("1 -1 1 V H {code} 2 0 0 0");
    ies::read(ies_text("IESNA:LM-63-2002", &head, "1 1 20", vertical, horizontal, candela).as_bytes()).unwrap()
}

#[test]
fn an_isotropic_source_has_four_pi_times_its_intensity() {
    let isotropic = type_c(&steps(0.0, 180.0, 7), &[0.0], |_, _| 10.0);
    close(isotropic.flux(), 40.0 * PI, 1e-12);
    close(isotropic.flux_below(), 20.0 * PI, 1e-12);
    close(isotropic.intensity([0.3, -0.4, 0.1]), 10.0, 1e-12);
}

#[test]
fn a_lambertian_source_has_pi_times_its_intensity() {
    let lambertian = type_c(&steps(0.0, 90.0, 1800), &[0.0], |_, gamma| 100.0 * gamma.to_radians().cos().max(0.0));
    close(lambertian.flux(), 100.0 * PI, 1e-6);
    assert_eq!(lambertian.flux(), lambertian.flux_below());
    assert_eq!(lambertian.intensity([0.0, 0.6, 0.8]), 0.0);
}

#[test]
fn flux_is_the_integral_of_the_interpolated_intensity() {
    let odd = |c: f64, gamma: f64| 50.0 + 40.0 * (c.to_radians() + 0.3).sin() * (gamma.to_radians() * 1.7).cos() + gamma / 9.0;
    let ragged = [0.0, 4.0, 11.0, 37.0, 38.0, 71.0, 90.0, 113.0, 180.0];
    for horizontal in [vec![0.0, 13.0, 90.0], vec![0.0, 50.0, 77.0, 180.0], vec![90.0, 170.0, 270.0], vec![0.0, 10.0, 130.0, 200.0, 360.0]]
    {
        let goniogram = type_c(&ragged, &horizontal, odd);
        close(goniogram.flux(), quadrature(&goniogram, false), 1e-5);
        close(goniogram.flux_below(), quadrature(&goniogram, true), 1e-4);
    }
    let part = type_c(&[0.0, 33.0, 60.0, 90.0, 140.0], &[0.0], odd);
    close(part.flux(), quadrature(&part, false), 1e-3);
}

#[test]
fn types_a_and_b_are_exact_as_well() {
    let odd = |h: f64, v: f64| 30.0 + h / 7.0 + v / 11.0 + (h * v) / 900.0;
    for code in [2, 3] {
        let half = crossed(code, &[-90.0, -20.0, 0.0, 45.0, 90.0], &[-90.0, -31.0, 60.0, 90.0], odd);
        close(half.flux(), quadrature(&half, false), 1e-4);
        assert_eq!(half.flux(), half.flux_below());
        let quarter = crossed(code, &[0.0, 13.0, 90.0], &[0.0, 25.0, 90.0], odd);
        assert_eq!(quarter.symmetry, Symmetry::Quadrants);
        close(quarter.flux(), quadrature(&quarter, false), 1e-4);
        let resampled = quarter.to_type_c();
        close(resampled.flux(), quarter.flux(), 1e-12);
        let direction = PhotometricType::C.direction(33.0, 41.0);
        close(resampled.intensity(direction), quarter.intensity(direction), 2e-3);
    }
    let behind = crossed(2, &[-180.0, -100.0, 30.0, 180.0], &[-90.0, 0.0, 90.0], odd);
    close(behind.flux(), quadrature(&behind, false), 1e-4);
    close(behind.flux_below(), quadrature(&behind, true), 1e-3);
}

#[test]
fn angles_and_directions_agree() {
    for photometric_type in [PhotometricType::A, PhotometricType::B, PhotometricType::C] {
        for [h, v] in [[10.0, 20.0], [75.0, 40.0], [33.0, 89.0], [89.0, 1.0]] {
            let direction = photometric_type.direction(h, v);
            let [h_again, v_again] = photometric_type.angles(direction);
            close(h_again, h, 1e-12);
            close(v_again, v, 1e-12);
        }
        let nadir = photometric_type.direction(0.0, 0.0);
        assert_eq!(nadir, [0.0, 0.0, -1.0]);
    }
    // CIE 121: tan B = cos C tan γ and sin β = sin C sin γ; tan A = sin C tan γ and sin α = cos C sin γ.
    let (c, gamma) = (40f64, 50f64);
    let direction = PhotometricType::C.direction(c, gamma);
    let (c, gamma) = (c.to_radians(), gamma.to_radians());
    let [beta, b] = PhotometricType::B.angles(direction).map(f64::to_radians);
    close(b.tan(), c.cos() * gamma.tan(), 1e-12);
    close(beta.sin(), c.sin() * gamma.sin(), 1e-12);
    let [a, alpha] = PhotometricType::A.angles(direction).map(f64::to_radians);
    close(a.tan(), c.sin() * gamma.tan(), 1e-12);
    close(alpha.sin(), c.cos() * gamma.sin(), 1e-12);
}

#[test]
fn tabulated_directions_give_the_tabulated_intensity() {
    let odd = |c: f64, gamma: f64| 1.0 + c + 0.37 * gamma;
    let vertical = [0.0, 7.3, 45.0, 90.0, 166.6, 180.0];
    for (horizontal, images) in [
        (vec![0.0, 13.7, 90.0], vec![|c: f64| c, |c| 180.0 - c, |c| 180.0 + c, |c| 360.0 - c]),
        (vec![0.0, 13.7, 180.0], vec![|c| c, |c| 360.0 - c]),
        (vec![90.0, 113.7, 270.0], vec![|c| c, |c| 180.0 - c]),
        (vec![0.0, 113.7, 359.0, 360.0], vec![|c| c]),
    ] {
        let goniogram = type_c(&vertical, &horizontal, odd);
        let grid = goniogram.expanded();
        assert_eq!((grid.horizontal[0], grid.horizontal[grid.horizontal.len() - 1]), (0.0, 360.0));
        // The last plane of a full circle is the first one's direction.
        let planes = horizontal.iter().filter(|c| **c < 360.0);
        for (c, gamma) in planes.flat_map(|c| vertical.iter().map(|gamma| (*c, *gamma))).filter(|(_, gamma)| *gamma > 0.0 && *gamma < 180.0)
        {
            for image in &images {
                let direction = PhotometricType::C.direction(image(c), gamma);
                close(goniogram.intensity(direction), odd(c, gamma), 1e-6);
                let angle = image(c).rem_euclid(360.0);
                let h = grid.horizontal.iter().position(|a| (a - angle).abs() < 1e-6).unwrap();
                let v = grid.vertical.iter().position(|a| *a == gamma).unwrap();
                close(grid.intensities[h * vertical.len() + v], odd(c, gamma), 1e-6);
            }
        }
    }
}

#[test]
fn symmetries_are_found_and_given() {
    let about_c0 = type_c(&[0.0, 45.0, 90.0], &[0.0, 60.0, 180.0], |c, gamma| 10.0 + c * c * gamma / 100.0);
    assert_eq!(about_c0.symmetry, Symmetry::AboutC0);
    assert_eq!(about_c0.symmetry_found(1e-9), Symmetry::AboutC0);
    for symmetry in [Symmetry::None, Symmetry::Rotational, Symmetry::AboutC0, Symmetry::AboutC90, Symmetry::Quadrants] {
        let given = about_c0.symmetrised(symmetry);
        assert_eq!(given.symmetry, symmetry);
        close(given.flux(), about_c0.flux(), 1e-12);
    }
    assert_eq!(about_c0.symmetrised(Symmetry::Quadrants).symmetry_found(1e-9), Symmetry::Quadrants);
    assert_eq!(about_c0.symmetrised(Symmetry::None).symmetry_found(1e-9), Symmetry::AboutC0);
    let constant = type_c(&[0.0, 90.0], &[0.0, 90.0], |_, _| 5.0);
    assert_eq!(constant.symmetry_found(1e-9), Symmetry::Rotational);
}

#[test]
fn rotation_moves_the_intensities_and_keeps_the_flux() {
    let goniogram = type_c(&[0.0, 45.0, 90.0], &[0.0, 60.0, 180.0], |c, gamma| 10.0 + c * gamma / 100.0);
    for degrees in [90.0, -90.0, 180.0, 17.0, 400.0] {
        let rotated = goniogram.rotated(degrees);
        close(rotated.flux(), goniogram.flux(), 1e-12);
        for c in [0.0, 60.0, 200.0] {
            close(rotated.intensity_at(c + degrees, 45.0), goniogram.intensity_at(c, 45.0), 1e-12);
        }
    }
    assert_eq!(goniogram.rotated(90.0).symmetry, Symmetry::AboutC90);
    assert_eq!(goniogram.rotated(180.0).symmetry, Symmetry::AboutC0);
    let floodlight = crossed(2, &[-90.0, 0.0, 90.0], &[-90.0, 0.0, 90.0], |h, v| 100.0 - h.abs() / 2.0 + v / 3.0);
    let turned = floodlight.rotated(90.0);
    close(turned.flux(), floodlight.flux(), 1e-12);
    close(turned.intensity([0.0, 0.5, -0.8]), floodlight.intensity([0.5, 0.0, -0.8]), 2e-3);
}

#[test]
fn flux_is_scaled_with_the_lamps() {
    let text = ies_text("IESNA:LM-63-2002", "2 500 1 V H 1 2 0 0 0", "1 1 20", &[0.0, 90.0], &[0.0], |_, _| 100.0);
    let goniogram = ies::read(text.as_bytes()).unwrap();
    let scaled = goniogram.scaled_to_flux(3000.0).unwrap();
    close(scaled.flux(), 3000.0, 1e-12);
    close(scaled.figures().light_output_ratio.unwrap(), goniogram.figures().light_output_ratio.unwrap(), 1e-12);
    assert!(goniogram.scaled_to_flux(-1.0).is_err());
    assert!(goniogram.scaled_to_flux(f64::NAN).is_err());
    assert!(type_c(&[0.0, 90.0], &[0.0], |_, _| 0.0).scaled_to_flux(100.0).is_err());
}

#[test]
fn figures_of_a_known_curve() {
    // A tent: 1000 cd at nadir, 0 at 90 degrees; half at 45, a tenth at 81.
    let tent = type_c(&[0.0, 90.0], &[0.0], |_, gamma| 1000.0 - gamma * 100.0 / 9.0);
    let figures = tent.figures();
    close(figures.peak, 1000.0, 1e-12);
    close(figures.beam[0].angle(), 90.0, 1e-12);
    close(figures.field[1].angle(), 162.0, 1e-12);
    close(figures.efficacy.unwrap(), tent.flux() / 20.0, 1e-12);
    close(figures.downward_fraction, 1.0, 1e-12);
    assert_eq!(figures.light_output_ratio, None);
    // The same turned up, and leaning over to C0 alone.
    let up = type_c(&[90.0, 180.0], &[0.0], |_, gamma| (gamma - 90.0) * 10.0);
    assert!(up.figures().beam[0].up);
    close(up.figures().beam[0].angle(), 90.0, 1e-12);
    let aside = type_c(&[0.0, 20.0, 40.0, 90.0], &[0.0, 90.0, 180.0], |c, gamma| if c == 0.0 && gamma == 20.0 { 100.0 } else { 0.0 });
    assert_eq!(aside.figures().peak_direction, [0.0, 20.0]);
    let [from, to] = aside.figures().beam[0].range;
    close(from, 10.0, 1e-12);
    close(to, 30.0, 1e-12);
}

#[test]
fn hemispheres_end_at_the_horizon_whatever_the_files_angles() {
    let beam = |vertical: &[f64], candela: &[f64]| {
        let at = |_: f64, gamma: f64| candela[vertical.iter().position(|angle| *angle == gamma).unwrap()];
        type_c(vertical, &[0.0], at).figures().beam[0].angle()
    };
    // Globes, with angles at the poles alone and with a horizon.
    close(beam(&[0.0, 180.0], &[100.0; 2]), 180.0, 1e-12);
    close(beam(&[0.0, 45.0, 90.0, 135.0, 180.0], &[100.0, 95.0, 90.0, 80.0, 50.0]), 180.0, 1e-12);
    // A post lamp whose angles go from 84° to 91°.
    let steps: Vec<f64> = (0..16).map(|k| f64::from(k) * 7.0).collect();
    let post: Vec<f64> = (0..16).map(|k| [80.0, 40.0, 0.0].get(usize::wrapping_sub(k, 13)).copied().unwrap_or(100.0)).collect();
    close(beam(&steps, &post), 180.0, 1e-12);
    // Half of 100 at 60°; 20 of 100 where the curve falls from 50 at 60° to 17 at 80°, not at a node.
    let curve = ([0.0, 20.0, 40.0, 60.0, 80.0, 100.0], [100.0, 94.0, 77.0, 50.0, 17.0, 0.0]);
    close(beam(&curve.0, &curve.1), 120.0, 1e-12);
    // Brighter above: half of the horizon's 75 to the zenith's 100.
    close(beam(&[0.0, 60.0, 120.0, 180.0], &[10.0, 50.0, 100.0, 100.0]), 180.0, 1e-12);
}
