//! RGL's measurements, written by us from known BRDFs.

use super::super::direction::{Direction, spherical};
use super::super::{Channels, Hemispheres, Interpolant, Measured, Rgl, RglGrid, read};
use super::Random;
use super::models::Ggx;

/// A coarse isotropic measurement.
pub(super) fn small() -> Rgl {
    let grid = RglGrid::isotropic(6, 1.4, [48, 24], 24);
    Rgl::from_function(&grid, "a GGX surface", |wi, wo| Ggx::ISOTROPIC.value(wi, wo)).unwrap()
}

/// A coarse anisotropic measurement.
pub(super) fn small_anisotropic() -> Rgl {
    let grid = RglGrid::anisotropic(9, 5, 1.4, [32, 48], 20);
    Rgl::from_function(&grid, "an anisotropic GGX surface", |wi, wo| Ggx::ANISOTROPIC.value(wi, wo)).unwrap()
}

/// The mean difference of luminance over the mean, for views at angles and random light.
fn mean_error(rgl: &Rgl, model: &Ggx, theta: &[f64]) -> f64 {
    let material = Measured::Rgl(Box::new(rgl.clone()));
    let mut random = Random(5);
    let (mut difference, mut sum) = (0.0, 0.0);
    for i in 0..4000 {
        let (wo, wi) = (spherical(theta[i % theta.len()], core::f64::consts::TAU * random.next()), random.direction());
        for (a, b) in material.eval_rgb(wi, wo).iter().zip(model.value(wi, wo)) {
            difference += (a - b).abs();
            sum += b;
        }
    }
    difference / sum
}

#[test]
fn an_isotropic_surface_comes_back() {
    let grid = RglGrid::isotropic(12, 1.45, [128, 64], 48);
    let rgl = Rgl::from_function(&grid, "", |wi, wo| Ggx::ISOTROPIC.value(wi, wo)).unwrap();
    let on: Vec<f64> = grid.theta.iter().map(|&t| t.into()).collect();
    let between: Vec<f64> = on.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
    let errors = [mean_error(&rgl, &Ggx::ISOTROPIC, &on), mean_error(&rgl, &Ggx::ISOTROPIC, &between)];
    assert!(errors[0] < 5e-3 && errors[1] < 1e-2, "mean relative error {:.2e} at the grid's angles, {:.2e} between", errors[0], errors[1]);
}

#[test]
fn an_anisotropic_surface_comes_back() {
    let grid = RglGrid::anisotropic(17, 8, 1.45, [64, 96], 32);
    let rgl = Rgl::from_function(&grid, "", |wi, wo| Ggx::ANISOTROPIC.value(wi, wo)).unwrap();
    let on: Vec<f64> = grid.theta.iter().map(|&t| t.into()).collect();
    let error = mean_error(&rgl, &Ggx::ANISOTROPIC, &on);
    assert!(error < 2e-2, "mean relative error {error:.2e}");
}

#[test]
fn a_file_comes_back() {
    for rgl in [small(), small_anisotropic()] {
        let bytes = rgl.write();
        let Measured::Rgl(back) = read(&bytes, "x.bsdf").unwrap() else { panic!("expected an RGL measurement") };
        let mut random = Random(7);
        for _ in 0..500 {
            let (wi, wo) = (random.direction(), random.direction());
            let [mut a, mut b] = [[0.0; 3]; 2];
            rgl.eval(wi, wo, &mut a);
            back.eval(wi, wo, &mut b);
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-5 * a.abs()), "{a:?} {b:?}");
        }
        assert_eq!((&back.description, back.jacobian, &back.channels), (&rgl.description, true, &rgl.channels));
    }
}

#[test]
fn spectra_come_back_and_have_the_colour_of_their_bands() {
    let mut rgl = small();
    // Five bands that repeat the three channels' slices: grey where all are the first one.
    let wavelengths = vec![450.0, 500.0, 550.0, 600.0, 650.0];
    let slice = rgl.spectra.rows * rgl.spectra.columns;
    let data = rgl.spectra.data.chunks_exact(3 * slice).flat_map(|angles| angles[..slice].repeat(5)).collect();
    let mut parameters = rgl.spectra.parameters.clone();
    parameters[2] = vec![0.0, 1.0, 2.0, 3.0, 4.0];
    rgl.spectra = Interpolant { parameters, data, ..rgl.spectra };
    rgl.channels = Channels::bands(wavelengths).unwrap();
    let back = read(&rgl.write(), "x.bsdf").unwrap();
    assert_eq!(back.channels(), &rgl.channels);
    let (wi, wo) = (spherical(0.3, 0.2), spherical(0.5, 3.0));
    let [r, g, b] = back.eval_rgb(wi, wo);
    assert!(r > 0.0 && (r - g).abs() < 1e-5 * r && (r - b).abs() < 1e-5 * r, "{r} {g} {b}");
    assert!((r / back.eval_luminance(wi, wo) - 1.0).abs() < 1e-5);
}

#[test]
fn nothing_comes_from_or_goes_to_the_back() {
    let material = Measured::Rgl(Box::new(small()));
    let mut random = Random(9);
    for _ in 0..200 {
        let (wi, wo) = (random.any_direction(), random.any_direction());
        let is_front = Hemispheres::of(wi, wo) == Some(Hemispheres::ReflectionFront);
        assert!(is_front || material.eval_luminance(wi, wo) == 0.0);
    }
}

#[test]
fn a_part_of_a_turn_is_mirrored() {
    // The quarter of a symmetric surface: φ from −π to −π/2.
    let mut grid = RglGrid::anisotropic(17, 5, 1.4, [32, 48], 20);
    let value = |wi: Direction, wo: Direction| Ggx::ANISOTROPIC.value(wi, wo);
    let full = Rgl::from_function(&grid, "", value).unwrap();
    grid.phi.truncate(5);
    let quarter = Rgl::from_function(&grid, "", value).unwrap();
    assert_eq!((full.reduction(), quarter.reduction()), (1, 4));
    let mut random = Random(11);
    let (mut difference, mut sum) = (0.0, 0.0);
    for _ in 0..2000 {
        let [mut a, mut b] = [[0.0; 3]; 2];
        let (wi, wo) = (random.direction(), random.direction());
        full.eval(wi, wo, &mut a);
        quarter.eval(wi, wo, &mut b);
        difference += a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>();
        sum += a.iter().sum::<f64>();
    }
    assert!(difference < 5e-3 * sum, "{}", difference / sum);
}
