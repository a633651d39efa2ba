//! Fibres: the model against itself in double precision, energy over the whole width, and parameters at the ends of their ranges.

use super::harness::{View, random, spread};
use super::rows::{Values, single, surface};
use crate::parameter as p;
use crate::{Closure, Surface, Switches};
use std::f64::consts::{PI, TAU};

/// A direction at `theta` along the fibre and `phi` about it from the normal, in degrees.
pub(super) fn about(theta: f64, phi: f64) -> [f32; 3] {
    let (theta, phi) = (theta.to_radians(), phi.to_radians());
    [theta.sin() as f32, (theta.cos() * phi.sin()) as f32, (theta.cos() * phi.cos()) as f32]
}

fn seen(surface: &Surface, wo: [f32; 3]) -> View {
    View::of(surface, wo, true)
}

/// I₀ by its series.
fn bessel(x: f64) -> f64 {
    let (mut term, mut sum, mut i) = (1.0, 1.0, 1.0);
    while term > 1e-17 * sum {
        term *= x * x / (4.0 * i * i);
        sum += term;
        i += 1.0;
    }
    sum
}

/// Reflectance of a dielectric; 1 under total reflection.
pub(super) fn fresnel(c: f64, eta: f64) -> f64 {
    let t = (1.0 - (1.0 - c * c) / (eta * eta)).max(0.0).sqrt();
    let (s, p) = ((c - eta * t) / (c + eta * t), (eta * c - t) / (eta * c + t));
    (s * s + p * p) / 2.0
}

/// The model of Chiang et al. as its paper has it, one channel, in double precision.
fn reference(wo: [f64; 3], wi: [f64; 3], variance: [f64; 3], scale: f64, (absorption, tilt, eta): (f64, f64, f64)) -> f64 {
    let theta = |w: [f64; 3]| w[0].asin();
    let (i, o) = (theta(wi), theta(wo));
    let azimuth = |w: [f64; 3]| w[2].atan2(w[1]);
    let phi = azimuth(wi) - azimuth(wo);
    let h = -wo[1] / wo[1].hypot(wo[2]);
    let outer = h.asin();
    let inner = (h * o.cos() / (eta * eta - o.sin().powi(2)).sqrt()).asin();
    let along = (o.sin() / eta).asin();
    let passed = (-absorption * 2.0 * inner.cos() / along.cos()).exp();
    let f = fresnel(o.cos() * outer.cos(), eta);
    let tt = (1.0 - f).powi(2) * passed;
    let trt = tt * passed * f;
    let amounts = [f, tt, trt, trt * passed * f / (1.0 - passed * f)];
    let tilts = [2.0, -1.0, -4.0, 0.0];
    let mut sum = 0.0;
    for k in 0..4 {
        let v = variance[k.min(2)];
        let o = o + tilts[k] * tilt;
        let m = (-(i.sin() * o.sin()) / v).exp() * bessel(i.cos() * o.cos().abs() / v) / (2.0 * v * (1.0 / v).sinh());
        let n = if k == 3 {
            1.0 / TAU
        } else {
            let middle = 2.0 * k as f64 * inner - 2.0 * outer + k as f64 * PI;
            let x = (phi - middle + PI).rem_euclid(TAU) - PI;
            let scale = scale * (PI / 8.0).sqrt();
            let density = |x: f64| 1.0 / (4.0 * scale * (x / (2.0 * scale)).cosh().powi(2));
            density(x) / (PI / (2.0 * scale)).tanh()
        };
        sum += amounts[k] * m * n;
    }
    sum
}

#[test]
fn values_are_those_of_the_paper() {
    for (variance, scale) in [([0.0846, 0.02115, 0.3384], 0.117), ([0.5, 0.125, 2.0], 0.4), ([0.01, 0.004, 0.04], 0.05)] {
        for (absorption, tilt, eta) in [(0.0, 0.0, 1.55), (0.6, 0.035, 1.55), (2.0, -0.1, 1.3)] {
            let single = single(
                Closure::Hair,
                &[
                    (p::HAIR_VARIANCE, &variance.map(|v: f64| v as f32)),
                    (p::HAIR_SCALE, &[scale as f32; 3]),
                    (p::HAIR_ABSORPTION, &[absorption as f32; 3]),
                    (p::HAIR_TILT, &[tilt as f32]),
                    (p::IOR, &[eta as f32]),
                ],
            );
            for view in [about(0.0, 0.0), about(35.0, 40.0), about(-70.0, -80.0)] {
                let directions: Vec<[f32; 3]> =
                    random(200, 7).iter().map(|u| about(f64::from(u[0]) * 178.0 - 89.0, f64::from(u[1]) * 360.0)).collect();
                for (wi, (value, _)) in directions.iter().zip(seen(&single, view).eval(&directions)) {
                    let expected = reference(view.map(f64::from), wi.map(f64::from), variance, scale, (absorption, tilt, eta));
                    let found = f64::from(value[1]);
                    assert!((found - expected).abs() < 2e-4 * expected + 1e-6, "{view:?} to {wi:?}: {found}, expected {expected}");
                }
            }
        }
    }
}

#[test]
fn white_fibres_keep_all_light() {
    let settings: [Values; 4] = [
        &[],
        &[(p::HAIR_TILT, &[0.0]), (p::IOR, &[1.2])],
        &[(p::HAIR_VARIANCE, &[1e-3, 2e-4, 4e-3]), (p::HAIR_SCALE, &[0.01; 3])],
        &[(p::HAIR_VARIANCE, &[27.0, 7.0, 108.0]), (p::HAIR_SCALE, &[4.0; 3])],
    ];
    for values in settings {
        let mut all: Vec<(usize, &[f32])> = vec![(p::HAIR_ABSORPTION, &[0.0; 3])];
        all.extend_from_slice(values);
        let white = surface(Switches::single(Closure::Hair), &all);
        for theta in [0.0, 30.0, -65.0, 85.0] {
            for phi in [-89.9, -50.0, 0.0, 20.0, 90.0] {
                let view = seen(&white, about(theta, phi));
                // Every sample has the whole albedo, for value and density are in proportion; so the density itself is checked too.
                let [back, through] = view.albedo(1 << 10);
                assert!((back[1] + through[1] - 1.0).abs() < 1e-4, "{values:?} at {theta}, {phi}: {}", back[1] + through[1]);
            }
        }
    }
}

#[test]
fn densities_integrate_to_one() {
    for values in [&[][..], &[(p::HAIR_VARIANCE, &[4.0, 1.0, 16.0][..]), (p::HAIR_SCALE, &[1.3; 3][..])][..]] {
        let fibre = single(Closure::Hair, values);
        for view in [about(0.0, 0.0), about(50.0, 70.0), about(-80.0, -30.0)] {
            const STEPS: [usize; 2] = [360, 720];
            let mut directions = Vec::with_capacity(STEPS[0] * STEPS[1]);
            for i in 0..STEPS[0] {
                // Evenly in sin θ: solid angle.
                let theta = ((i as f64 + 0.5) / STEPS[0] as f64 * 2.0 - 1.0).asin().to_degrees();
                directions.extend((0..STEPS[1]).map(|k| about(theta, (k as f64 + 0.5) / STEPS[1] as f64 * 360.0)));
            }
            let sum: f64 = seen(&fibre, view).eval(&directions).iter().map(|(_, pdf)| f64::from(*pdf)).sum();
            let integral = sum * 4.0 * PI / directions.len() as f64;
            assert!((integral - 1.0).abs() < 2e-3, "{values:?} from {view:?}: {integral}");
        }
    }
}

#[test]
fn parameters_at_their_ends_give_finite_light() {
    let ends: [Values; 7] = [
        &[(p::HAIR_VARIANCE, &[0.0; 3]), (p::HAIR_SCALE, &[0.0; 3])],
        &[(p::HAIR_VARIANCE, &[1e9; 3]), (p::HAIR_SCALE, &[1e9; 3])],
        &[(p::HAIR_ABSORPTION, &[1e9, 0.0, -1.0])],
        &[(p::IOR, &[0.0])],
        &[(p::IOR, &[100.0]), (p::HAIR_ABSORPTION, &[0.0; 3])],
        &[(p::HAIR_TILT, &[1.5])],
        &[(p::HAIR_TINT_R, &[-1.0; 3]), (p::HAIR_TINT_TT, &[0.0; 3]), (p::HAIR_TINT_TRT, &[0.0; 3])],
    ];
    let closures = [Closure::Hair, Closure::HairReflection, Closure::HairTransmission];
    let views = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-0.999_999, 0.0, 0.001_4], [0.6, 0.8, -1e-4]];
    for values in ends.into_iter().chain([&[(p::HAIR_WIDTHS, &[0.0, 0.0][..])][..], &[(p::HAIR_WIDTHS, &[9.0, 9.0][..])][..]]) {
        for closure in closures {
            for view in views {
                let view = seen(&single(closure, values), view);
                for s in view.sample(&spread(256)) {
                    assert!(s.pdf.is_finite() && s.pdf >= 0.0 && s.value.iter().all(|x| x.is_finite() && *x >= 0.0), "{values:?}: {s:?}");
                    let length: f32 = s.wi.iter().map(|x| x * x).sum();
                    assert!(s.pdf == 0.0 || (length - 1.0).abs() < 1e-3, "{values:?}: {s:?}");
                    let factor = s.value.map(|x| x / s.pdf.max(1e-30));
                    assert!(s.pdf == 0.0 || factor.iter().all(|x| *x < 3.001), "{values:?}: {s:?}");
                }
                let ways = views.map(|v| v);
                assert!(view.eval(&ways).iter().all(|(value, pdf)| value[0].is_finite() && pdf.is_finite()), "{values:?}");
            }
        }
    }
}
