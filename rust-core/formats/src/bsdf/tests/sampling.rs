//! Samplers against their densities, for every kind of measurement.

use super::super::direction::{Direction, spherical, through};
use super::super::quadrature::quadrature;
use super::super::{
    Axis, Band, Channels, Coordinates, Grid, HalfVectorTable, Hemispheres, Layout, Measured, Mode, Resolution, Rgl, RglGrid, Sampler,
    Table, read,
};
use super::models::Ggx;
use super::{Random, chi_square, klems, rgl, trees};

/// Coarse tables: they make no difference to whether samples follow the density.
const COARSE: Resolution = Resolution { theta: 6, phi: 1, columns: 12, rows: 16, points: 2, cosine_share: 0.1 };

fn views() -> [Direction; 3] {
    [spherical(0.1, 0.3), spherical(0.8, 2.0), spherical(1.3, -1.1)]
}

fn both_sides() -> Vec<Direction> {
    views().into_iter().chain(views().map(through)).collect()
}

/// A table of a surface that reflects and lets some through.
fn table(coordinates: Coordinates) -> Measured {
    let ggx = Ggx { diffuse: 0.3, ..Ggx::ISOTROPIC };
    let theta = Axis::uniform(0.0, 1.5, 10, Mode::Linear).unwrap();
    let phi = Axis::uniform(0.0, 6.0, 16, Mode::Periodic { period: core::f64::consts::TAU }).unwrap();
    let axes = match coordinates {
        Coordinates::Isotropic => vec![theta.clone(), theta, phi],
        _ => vec![theta.clone(), phi.clone(), theta, phi],
    };
    let side = |hemispheres| {
        let layout = Layout { coordinates, axes: axes.clone(), channels: Channels::Rgb, hemispheres, reciprocal: false, bilateral: false };
        let fill = |wi, wo, out: &mut [f32]| out.iter_mut().zip(ggx.brdf(wi, wo)).for_each(|(out, v)| *out = v as f32);
        Table::from_function(layout, fill).unwrap()
    };
    Measured::Tables([Hemispheres::ReflectionFront, Hemispheres::TransmissionBack].map(side).to_vec())
}

#[test]
fn samples_of_tables_follow_their_density() {
    for (coordinates, phi) in [(Coordinates::Isotropic, 1), (Coordinates::Anisotropic, 4)] {
        let material = table(coordinates);
        chi_square::test(&Sampler::new(&material, &Resolution { phi, ..COARSE }), &views(), 1);
    }
}

#[test]
fn samples_of_trees_follow_their_density() {
    let material = Measured::Tree(trees::material(4));
    chi_square::test(&Sampler::new(&material, &Resolution { phi: 4, ..COARSE }), &both_sides(), 2);
}

#[test]
fn samples_of_rgl_follow_their_density() {
    for material in [rgl::small(), rgl::small_anisotropic()].map(|rgl| Measured::Rgl(Box::new(rgl))) {
        chi_square::test(&Sampler::new(&material, &COARSE), &views(), 3);
    }
}

#[test]
fn samples_of_matrices_follow_their_density() {
    let material = Measured::Patches(klems::blind());
    chi_square::test(&Sampler::new(&material, &COARSE), &both_sides(), 4);
}

#[test]
fn densities_integrate_to_one() {
    for material in [table(Coordinates::Isotropic), Measured::Tree(trees::material(3))] {
        let sampler = Sampler::new(&material, &COARSE);
        for wo in views() {
            let integral = chi_square::integral(&sampler, wo);
            assert!((integral - 1.0).abs() < 1e-3, "{integral} to {wo:?}");
        }
    }
}

#[test]
fn a_density_over_patches_sums_up_to_one() {
    // In a patch the density is the cosine times a constant.
    let material = Measured::Patches(klems::blind());
    let Measured::Patches(patches) = &material else { unreachable!() };
    let sampler = Sampler::new(&material, &COARSE);
    for wo in both_sides() {
        let mut sum = 0.0;
        for matrix in patches.matrices().iter().filter(|m| m.band == Band::Visible) {
            let basis = &patches.bases()[matrix.incident];
            for patch in 0..basis.count() {
                let sign = if matrix.turned[0] { -1.0 } else { 1.0 };
                let [x, y, z] = basis.direction(patch, [0.4, 0.6]);
                let wi = [sign * x, sign * y, if matrix.hemispheres.is_from_front() { z } else { -z }];
                if Hemispheres::of(wi, wo) == Some(matrix.hemispheres) {
                    sum += sampler.pdf(wo, wi) / z * basis.projected_solid_angle(patch);
                }
            }
        }
        // Nothing is reflected at the back; what comes through from the front is there.
        assert!((sum - 1.0).abs() < 1e-6, "{sum} to {wo:?}");
    }
}

#[test]
fn an_rgl_density_integrates_to_what_stays_above_the_surface() {
    let material = Measured::Rgl(Box::new(rgl::small()));
    let sampler = Sampler::new(&material, &COARSE);
    let n = 400;
    for wo in views() {
        let place = |i: usize| (i as f64 + 0.5) / f64::from(n);
        let kept = (0..(n * n) as usize).filter(|i| sampler.sample(wo, [0.5, place(i % n as usize), place(i / n as usize)]).is_some());
        let (kept, integral) = (kept.count() as f64 / f64::from(n * n), chi_square::integral(&sampler, wo));
        assert!((integral - kept).abs() < 1e-3, "{integral} and {kept} to {wo:?}");
    }
}

/// What samples of luminance × cosine over density have told.
struct Weights {
    mean: f64,
    variance: f64,
    /// Standard error of the variance, from the fourth moment.
    variance_error: f64,
}

/// Weights of as many samples to a view.
fn weights(material: &Measured, wo: Direction, count: u32, sample: impl Fn([f64; 3]) -> Option<(Direction, f64)>) -> Weights {
    let mut random = Random(53);
    let weight = |(wi, pdf): (Direction, f64)| material.eval_luminance(wi, wo) / pdf;
    let weights: Vec<f64> = (0..count).map(|_| sample([random.next(), random.next(), random.next()]).map_or(0.0, weight)).collect();
    let moment = |middle: f64, power: i32| weights.iter().map(|w| (w - middle).powi(power)).sum::<f64>() / f64::from(count);
    let mean = moment(0.0, 1);
    let variance = moment(mean, 2);
    Weights { mean, variance, variance_error: ((moment(mean, 4) - variance * variance) / f64::from(count)).sqrt() }
}

const SAMPLES: u32 = 20_000;

#[test]
fn weights_average_to_what_leaves() {
    let rgl = Measured::Rgl(Box::new(rgl::small()));
    let table = Measured::Tables(rgl.resampled(Grid { theta: 24, phi: 48, isotropic: true }).unwrap());
    for material in [&rgl, &table] {
        let sampler = Sampler::new(material, &Resolution::ISOTROPIC);
        for wo in views() {
            let Weights { mean, variance, .. } = weights(material, wo, SAMPLES, |u| sampler.sample(wo, u).map(|s| (s.wi, s.pdf)));
            let leaving: f64 = quadrature(wo, 200).map(|n| material.eval_luminance(n.direction, wo) * n.solid_angle).sum();
            let error = 4.0 * (variance / f64::from(SAMPLES)).sqrt();
            assert!((mean - leaving).abs() < error + 1e-3, "{mean} ± {error} and {leaving}");
        }
    }
}

/// The same measurement sampled both ways: a file that was written of a GGX surface.
fn assert_half_vectors_are_nearly_as_good(grid: &RglGrid, model: &Ggx, resolution: &Resolution, count: u32) {
    const MOST: f64 = 1.3;
    /// Of the normal distribution: one chance of a hundred beyond it, on one side.
    const QUANTILE: f64 = 2.33;
    let file = Rgl::from_function(grid, "a GGX surface", |wi, wo| model.value(wi, wo)).unwrap().write();
    let material = read(&file, "ggx.bsdf").unwrap();
    let own = Sampler::new(&material, resolution);
    let table = HalfVectorTable::new(&material, resolution);
    for wo in views() {
        let warp = weights(&material, wo, count, |u| own.sample(wo, u).map(|s| (s.wi, s.pdf)));
        let half = weights(&material, wo, count, |u| table.sample(wo, u));
        let excess = half.variance - MOST * warp.variance;
        let error = half.variance_error.hypot(MOST * warp.variance_error);
        let told = format!("to {wo:?}: {:.3} of the variance by the file's warp, {:.3e}", half.variance / warp.variance, warp.variance);
        eprintln!("{told}; {excess:.2e} ± {error:.1e} over {MOST} times that");
        assert!(excess + QUANTILE * error < 0.0, "{told}");
    }
}

#[test]
fn half_vectors_are_nearly_as_good_as_an_isotropic_files_warp() {
    let grid = RglGrid::isotropic(12, 1.45, [128, 64], 48);
    assert_half_vectors_are_nearly_as_good(&grid, &Ggx::ISOTROPIC, &Resolution::ISOTROPIC, 300_000);
}

#[test]
fn half_vectors_are_nearly_as_good_as_an_anisotropic_files_warp() {
    let grid = RglGrid::anisotropic(17, 8, 1.45, [64, 96], 32);
    assert_half_vectors_are_nearly_as_good(&grid, &Ggx::ANISOTROPIC, &Resolution::ANISOTROPIC, 40_000);
}
