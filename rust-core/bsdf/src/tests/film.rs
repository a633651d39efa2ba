//! Films against values of Cycles' kernel, and in a furnace.

use super::harness::View;
use super::rows::filmed;
use crate::energy::floats;
use crate::film::{Film, SENSITIVITY};
use crate::parameter as p;
use gonio_simd::{Execution, Lanes, Rgb, Spectrum, Wavelengths, dispatch};

/// Thickness in nanometres, cosine, normal reflectance, normal colour and drop of the metal, and both reflectances, for a film of index 1.33
/// over an index of 1.5; from Cycles 5.2.
struct Case {
    thickness: f32,
    cos: f32,
    f0: [f32; 3],
    metal: [[f32; 3]; 2],
    expected: [[f32; 3]; 2],
}

const CASES: [Case; 3] = [
    Case {
        thickness: 0.1001,
        cos: 1.0,
        f0: [0.02, 0.04, 0.08],
        metal: [[0.80, 0.40, 0.10], [3.150_887_7, 5.980_276_6, 7.292_110_4]],
        expected: [[0.019_999_843, 0.039_999_57, 0.079_998_68], [0.799_999_24, 0.399_996_73, 0.099_996_78]],
    },
    Case {
        thickness: 250.0,
        cos: 0.8,
        f0: [0.08, 0.04, 0.02],
        metal: [[0.72, 0.31, 0.08], [10.496_964, 3.332_078_5, 0.892_544_57]],
        expected: [[0.087_973_63, 0.041_538_376, 0.008_534_165], [0.721_437_3, 0.273_250_94, 0.007_501_763]],
    },
    Case {
        thickness: 400.0,
        cos: 0.1,
        f0: [0.10, 0.50, 0.90],
        metal: [[0.95, 0.62, 0.22], [1.717_715_1, 8.428_315, 9.227_974]],
        expected: [[0.954_137_4, 3.513_930_6, 6.104_284], [0.976_734_16, 0.782_455_15, 0.553_069_1]],
    },
];

#[inline(always)]
fn light<L: Lanes>(l: L, colour: [f32; 3]) -> Spectrum<L> {
    Wavelengths::rgb(l).reflectance(Rgb::splat(l, colour))
}

#[inline(always)]
fn reflectances<L: Lanes>(l: L, case: &Case, out: &mut [[f32; 3]; 2]) {
    let one = l.f(1.0);
    let film = Film::new([one, l.f(1.33), l.f(case.thickness)], one, Wavelengths::rgb(l));
    let dielectric = film.over_tinted(l.f(case.cos), l.f(1.5), light(l, case.f0), Spectrum::constant(one));
    let metal = film.over_f82(l.f(case.cos), light(l, case.metal[0]), light(l, case.metal[1]));
    for (out, light) in out.iter_mut().zip([dielectric, metal]) {
        let colour = light.to_rgb();
        *out = [colour.r, colour.g, colour.b].map(|x| x.to_array()[0]);
    }
}

#[test]
fn reflectances_are_cycles_values_at_all_levels() {
    for execution in Execution::all() {
        for case in &CASES {
            let mut found = [[0.0; 3]; 2];
            dispatch!(execution, l => reflectances(l, case, &mut found));
            // Cycles has more than arrives where the tint of the normal reflectance is far above that of the index; never here.
            let expected = case.expected.iter().flatten().map(|e| e.min(1.0));
            let near = found.iter().flatten().zip(expected).all(|(f, e)| (f - e).abs() < 2e-3 * e + 3e-5);
            assert!(near, "{} nm on {}: found {found:?}, expected {:?}", case.thickness, execution.name(), case.expected);
        }
    }
}

#[test]
fn films_on_clear_glass_keep_all_energy() {
    for entering in [true, false] {
        for angle in [0.0, 35.0, 70.0] {
            let glass = filmed(&[(p::TRANSMISSION_WEIGHT, &[1.0]), (p::BASE_COLOR, &[1.0; 3]), (p::ROUGHNESS, &[0.0])]);
            let [reflected, transmitted] = View::new(&glass, angle, entering).albedo(1 << 14);
            for (r, t) in reflected.iter().zip(transmitted) {
                assert!((r + t - 1.0).abs() < 2e-3, "at {angle}, entering {entering}: {r} and {t}");
            }
        }
    }
}

/// Colour matching functions of the CIE 1931 observer at 360 to 830 nm in steps of 1 nm.
static OBSERVER: [f32; 3 * 471] = floats(include_bytes!("observer.f32"));

/// A colour matching function between its nodes; zero beyond.
fn observer(nanometres: f64, curve: usize) -> f64 {
    let x = nanometres - 360.0;
    let node = |i: f64| if (0.0..471.0).contains(&i) { f64::from(OBSERVER[3 * i as usize + curve]) } else { 0.0 };
    let t = x - x.floor();
    node(x.floor()) * (1.0 - t) + node(x.floor() + 1.0) * t
}

#[test]
fn the_table_is_the_transform_of_the_observer() {
    const RGB: [[f64; 3]; 3] =
        [[3.240_454_2, -1.537_138_5, -0.498_531_4], [-0.969_266_0, 1.876_010_8, 0.041_556_0], [0.055_643_4, -0.204_025_9, 1.057_225_2]];
    // Evenly spaced frequencies, 1/µm; a step of frequency is λ² of wavelength.
    let samples = 1022;
    let frequency = |j: usize| core::f64::consts::PI * j as f64 / 60.0;
    let curves: Vec<[f64; 3]> = (0..samples)
        .map(|j| {
            let f = frequency(j.max(1));
            let xyz = [0, 1, 2].map(|curve| if j == 0 { 0.0 } else { observer(1000.0 / f, curve) / (f * f) });
            RGB.map(|row| row.iter().zip(xyz).map(|(a, b)| a * b).sum())
        })
        .collect();
    for node in 0..512 {
        for channel in 0..3 {
            let (mut total, mut re, mut im) = (0.0, 0.0, 0.0);
            for (j, curve) in curves.iter().enumerate() {
                let (sin, cos) = (core::f64::consts::TAU * ((node * j) % samples) as f64 / samples as f64).sin_cos();
                total += curve[channel];
                re += curve[channel] * cos;
                im -= curve[channel] * sin;
            }
            for (value, part) in [(re, 0), (im, 3)] {
                let found = f64::from(SENSITIVITY[(part + channel) * 512 + node]);
                assert!((found - value / total).abs() < 1e-5, "node {node}, channel {channel}: {found} and {}", value / total);
            }
        }
    }
}
