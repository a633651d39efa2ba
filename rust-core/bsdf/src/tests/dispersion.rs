//! Glass that disperses: samples follow the density of all wavelengths, each wavelength sees the glass of its own index, and no more are lost than need be.

use super::chi_square;
use super::harness::{RATIOS, View, spread};
use super::rows::{coloured_glass, glass};
use crate::Distribution::{Ggx, MultiGgx};
use crate::{Closure, Surface};

const INDEX: f32 = 1.5;
const SAMPLES: usize = 1 << 15;
/// What paths carry: the same, unlike numbers, one alone.
const CARRIED: [[f32; 3]; 3] = [[1.0; 3], [0.2, 1.0, 0.6], [0.0, 0.0, 2.0]];

fn seen(surface: Surface, angle: f32, entering: bool, carried: [f32; 3]) -> View {
    View { carried: Some(carried), ..View::new(&surface.of_glass(Some(0)), angle, entering) }
}

/// The same at one of the wavelengths, by its own index and in colour.
fn alone(component: usize, roughness: f32, angle: f32, entering: bool) -> View {
    View::new(&coloured_glass(Closure::Glass, 1.0, INDEX * RATIOS[component], roughness, Ggx), angle, entering)
}

#[test]
fn samples_follow_the_density() {
    for (number, carried) in CARRIED.into_iter().enumerate() {
        for (entering, angle, roughness) in [(true, 30.0, 0.4), (false, 35.0, 0.5), (true, 70.0, 0.6)] {
            let (p, integral, usable) = chi_square::test(&seen(glass(roughness, Ggx), angle, entering, carried), 7 + number as u64);
            assert!(p > 1e-4 && (integral - usable).abs() < 0.01, "{carried:?} at {angle}: p {p:.5}, {integral:.4} and {usable:.4}");
        }
    }
}

#[test]
fn each_wavelength_sees_the_glass_of_its_own_index() {
    let directions: Vec<[f32; 3]> = spread(512)
        .into_iter()
        .map(|[u, v, _]| {
            let (sin, cos) = (v * core::f32::consts::TAU).sin_cos();
            let z = 2.0 * u - 1.0;
            let flat = (1.0 - z * z).sqrt();
            [flat * cos, flat * sin, z]
        })
        .collect();
    for (entering, angle) in [(true, 20.0), (false, 38.0), (true, 75.0)] {
        let all = seen(glass(0.4, Ggx), angle, entering, [1.0; 3]).eval(&directions);
        let mut density = vec![0.0; directions.len()];
        for component in 0..3 {
            for (number, (value, pdf)) in alone(component, 0.4, angle, entering).eval(&directions).into_iter().enumerate() {
                let found = all[number].0[component];
                assert!((found - value[0]).abs() <= 1e-4 * value[0].max(1e-2), "{found} at {:?}, alone {}", directions[number], value[0]);
                density[number] += pdf / 3.0;
            }
        }
        for ((_, found), expected) in all.iter().zip(density) {
            assert!((found - expected).abs() <= 1e-4 * expected.max(1e-2), "density {found}, of the three {expected}");
        }
    }
}

#[test]
fn estimates_are_those_of_each_wavelength_alone() {
    for (entering, angle, roughness) in
        [(true, 0.0, 0.0), (true, 50.0, 0.0), (false, 30.0, 0.0), (true, 40.0, 0.1), (false, 36.0, 0.4), (true, 60.0, 0.7)]
    {
        let found = seen(glass(roughness, Ggx), angle, entering, [1.0; 3]).albedo(SAMPLES);
        for component in 0..3 {
            let expected = alone(component, roughness, angle, entering).albedo(SAMPLES);
            for side in 0..2 {
                let (found, expected) = (found[side][component], expected[side][0]);
                assert!((found - expected).abs() < 4e-3, "{entering} at {angle}, r {roughness}: {found:.4}, alone {expected:.4}");
            }
        }
    }
}

#[test]
fn white_glass_keeps_all_energy_at_all_wavelengths() {
    for (roughness, allowed) in [(0.0, 1e-3), (0.3, 8e-3), (0.6, 1e-2)] {
        for angle in [0.0, 40.0, 70.0] {
            let [reflected, transmitted] = seen(glass(roughness, MultiGgx), angle, true, [1.0; 3]).albedo(SAMPLES);
            for component in 0..3 {
                let found = reflected[component] + transmitted[component];
                assert!((found - 1.0).abs() < allowed, "r {roughness} at {angle}: {found:.4}");
            }
        }
    }
}

#[test]
fn no_wavelength_is_lost_that_goes_the_same_way() {
    let kept = |surface: Surface, angle: f32| {
        let samples = seen(surface, angle, true, [1.0; 3]).sample(&spread(1 << 10));
        let usable = samples.iter().filter(|sample| sample.pdf > 0.0);
        let side = |below: bool| usable.clone().filter(move |sample| (sample.wi[2] < 0.0) == below).map(|sample| sample.value);
        [side(false).all(|value| value.iter().all(|part| *part > 0.0)), side(true).all(|value| value.iter().all(|part| *part > 0.0))]
    };
    assert_eq!(kept(glass(0.0, Ggx), 0.0), [true, true], "straight on");
    assert_eq!(kept(glass(0.0, Ggx), 50.0), [true, false], "smooth glass aslant");
    let samples = seen(glass(0.5, Ggx), 50.0, true, [1.0; 3]).sample(&spread(1 << 10));
    let largest = samples.iter().filter(|sample| sample.pdf > 0.0).flat_map(|sample| sample.value.map(|part| part / sample.pdf));
    assert!(largest.fold(0.0, f32::max) < 3.01, "a wavelength stands for three at most");
}
