//! Energy: white surfaces give back what they get, estimates are near the truth, and equal lobes are reciprocal.

use super::harness::{View, direction, spread};
use super::rows::{self, glossy, principled, single, surface};
use crate::Distribution::{Ggx, MultiGgx};
use crate::parameter as p;
use crate::{Closure, Surface, Switches};
use gonio_simd::Execution;

const SAMPLES: usize = 1 << 15;

fn total(surface: &Surface, angle: f32) -> f64 {
    let [reflected, transmitted] = View::new(surface, angle, true).albedo(SAMPLES);
    reflected[1] + transmitted[1]
}

/// Surfaces that lose nothing, with the error that linear reads of coarse tables make at grazing angles.
fn white() -> Vec<(&'static str, Surface, f64)> {
    let one: &[f32] = &[1.0];
    let base: (usize, &[f32]) = (p::BASE_COLOR, &[1.0; 3]);
    let native = Switches::default();
    let thin = Switches { thin_walled: true, ..native };
    vec![
        ("lambert", surface(native, &[base, (p::SPECULAR_WEIGHT, &[0.0])]), 1e-3),
        ("eon", surface(native, &[base, (p::SPECULAR_WEIGHT, &[0.0]), (p::DIFFUSE_ROUGHNESS, one)]), 2e-3),
        ("metal", glossy([1.0; 3], 0.7, 0.0, MultiGgx), 3e-3),
        ("plastic", principled(&[base]), 5e-3),
        ("rough plastic", principled(&[base, (p::ROUGHNESS, one)]), 5e-3),
        ("glass", rows::glass(0.5, MultiGgx), 8e-3),
        ("smooth glass", rows::glass(0.0, MultiGgx), 1e-3),
        ("coated", principled(&[base, (p::COAT_WEIGHT, one), (p::COAT_ROUGHNESS, &[0.4])]), 1e-2),
        ("fuzzy", surface(native, &[base, (p::SPECULAR_WEIGHT, &[0.0]), (p::FUZZ_WEIGHT, one)]), 5e-3),
        ("toon", single(Closure::DiffuseToon, &[base, (p::TOON_SIZE, &[0.7])]), 1e-3),
        ("smooth thin wall", surface(thin, &[(p::TRANSMISSION_WEIGHT, one), (p::ROUGHNESS, &[0.0])]), 2e-3),
        ("thin wall", surface(thin, &[(p::TRANSMISSION_WEIGHT, one), (p::ROUGHNESS, &[0.5])]), 1e-2),
    ]
}

#[test]
fn white_surfaces_keep_all_energy() {
    let mut failures = Vec::new();
    for (name, surface, allowed) in white() {
        for angle in [0.0, 40.0, 70.0] {
            let found = total(&surface, angle);
            if (found - 1.0).abs() > allowed {
                failures.push(format!("{name} at {angle}: {found:.5}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn no_surface_makes_energy() {
    for (name, surface) in rows::undrawn() {
        for angle in [5.0, 50.0, 80.0] {
            let found = total(&surface, angle);
            assert!(found < 1.01, "{name} at {angle}: {found:.5}");
        }
    }
}

#[test]
fn throughput_is_bounded_and_finite() {
    for (name, surface) in rows::all() {
        for angle in [0.0, 60.0, 89.9] {
            for s in View::new(&surface, angle, true).sample(&spread(1 << 12)).iter().filter(|s| s.pdf > 0.0) {
                let length: f32 = s.wi.iter().map(|x| x * x).sum();
                let factor = s.value[0].max(s.value[1]).max(s.value[2]) / s.pdf;
                assert!((length - 1.0).abs() < 1e-3 && factor.is_finite() && factor < 60.0, "{name} at {angle}: {s:?}, factor {factor}");
            }
        }
    }
}

#[test]
fn albedo_estimates_are_near_the_truth() {
    let mut failures = Vec::new();
    // Tables know no anisotropy, plain lobes lose what the estimates count, and a walk's colour comes from its scattering.
    let unknown = ["glossy anisotropic", "metal turned", "oren-nayar", "beckmann anisotropic", "velvet", "walk"];
    let known = |name: &str| !unknown.contains(&name) && !name.starts_with("ashikhmin");
    for (name, surface) in rows::undrawn().filter(|(name, _)| known(name)) {
        let view = View::new(&surface, 40.0, true);
        let (estimate, truth) = (f64::from(view.summary().albedo[0]), view.albedo(SAMPLES));
        let truth = truth[0][0] + truth[1][0];
        if (estimate - truth).abs() > 0.1 * truth + 0.01 {
            failures.push(format!("{name}: estimate {estimate:.4}, truth {truth:.4}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn lobes_without_layers_are_reciprocal() {
    let native = Switches { distribution: Ggx, ..Switches::default() };
    let metal = surface(native, &[(p::METALNESS, &[1.0]), (p::ANISOTROPY, &[0.7]), (p::ROTATION, &[0.1])]);
    for (name, surface) in [("eon", rows::diffuse(0.8)), ("metal", metal), ("glossy", glossy([1.0; 3], 0.5, 0.0, Ggx))] {
        for (a, b) in [((20.0, 0.0), (50.0, 70.0)), ((70.0, 0.0), (30.0, 200.0)), ((80.0, 0.0), (60.0, 170.0))] {
            let (a, b) = (direction(a.0, a.1), direction(b.0, b.1));
            let value = |wo: [f32; 3], wi: [f32; 3]| View::of(&surface, wo, true).eval(&[wi])[0].0[1] / wi[2];
            let (there, back) = (value(a, b), value(b, a));
            assert!((there - back).abs() < 1e-3 * there.max(back) + 1e-6, "{name}: {there} and {back}");
        }
    }
}

#[test]
fn refraction_scales_with_the_squared_index_when_reversed() {
    let glass = rows::glass(0.6, Ggx);
    let [outside, inside] = [direction(30.0, 0.0), direction(155.0, 190.0)];
    let into = View::of(&glass, outside, true).eval(&[inside])[0].0[1] / -inside[2];
    let mirrored = |v: [f32; 3]| [v[0], v[1], -v[2]];
    let out = View::of(&glass, mirrored(inside), false).eval(&[mirrored(outside)])[0].0[1] / outside[2];
    assert!((into / (1.5 * 1.5) - out).abs() < 1e-3 * out, "{into} and {out}");
}

#[test]
fn levels_agree() {
    let numbers = spread(1 << 10);
    let directions: Vec<[f32; 3]> = numbers.iter().map(|u| direction(u[0] * 180.0, u[1] * 360.0)).collect();
    for (name, surface) in rows::all() {
        let view = View::new(&surface, 50.0, true);
        let (scalar, values) = (view.sample_at(Execution::Scalar, &numbers), view.eval_at(Execution::Scalar, &directions));
        for execution in Execution::all() {
            let near = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(b.abs()) + 1e-5;
            // A number at the border between two lobes may fall on either side.
            let samples = view.sample_at(execution, &numbers);
            let odd = samples.iter().zip(&scalar);
            let odd = odd.filter(|(a, b)| !near(a.pdf, b.pdf) || a.wi.iter().zip(b.wi).any(|(a, b)| (a - b).abs() > 1e-3)).count();
            assert!(odd <= numbers.len() / 200, "{name} on {}: {odd} samples differ", execution.name());
            let odd = view.eval_at(execution, &directions).iter().zip(&values).filter(|(a, b)| !near(a.0[0], b.0[0])).count();
            assert!(odd == 0, "{name} on {}: {odd} values differ", execution.name());
        }
    }
}
