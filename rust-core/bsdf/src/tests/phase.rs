//! Phase functions against their closed forms: integral, mean cosine, and a chi-square test of what is drawn.

use super::harness::random;
use crate::phase::{henyey_greenstein, sample_henyey_greenstein};
use gonio_simd::{Execution, Lanes, Vec3, dispatch};

const SAMPLES: usize = 1 << 17;
/// Bins of equal probability by the cosine, and bins about the direction.
const RINGS: usize = 32;
const TURNS: usize = 8;
/// Mean cosines, near 0 too, where the formula has none.
const COSINES: [f64; 8] = [-0.95, -0.5, -2e-3, 0.0, 5e-4, 0.3, 0.8, 0.97];

/// Probability of cosines below `x`.
fn below(g: f64, x: f64) -> f64 {
    if g.abs() < 1e-3 {
        return (x + 1.0) * 0.5;
    }
    (1.0 - g * g) / (2.0 * g) * ((1.0 + g * g - 2.0 * g * x).sqrt().recip() - (1.0 + g).recip())
}

#[inline(always)]
fn draw<L: Lanes>(l: L, g: f32, numbers: &[[f32; 3]], along: [f32; 3], out: &mut Vec<[f32; 3]>) {
    for chunk in numbers.chunks_exact(L::COUNT) {
        let (mut u, mut v) = ([0.0; 16], [0.0; 16]);
        for (lane, number) in chunk.iter().enumerate() {
            (u[lane], v[lane]) = (number[0], number[1]);
        }
        let found = sample_henyey_greenstein(l.f(g), Vec3::splat(l, along), [l.load(&u, 0), l.load(&v, 0)]);
        let [x, y, z] = [found.x.to_array(), found.y.to_array(), found.z.to_array()];
        out.extend((0..L::COUNT).map(|lane| [x[lane], y[lane], z[lane]]));
    }
}

#[test]
fn directions_are_drawn_as_often_as_the_function_says() {
    let numbers = random(SAMPLES, 11);
    for g in COSINES {
        let mut found = Vec::new();
        dispatch!(Execution::best(), l => draw(l, g as f32, &numbers, [0.0, 0.0, 1.0], &mut found));
        let mut bins = vec![0.0; RINGS * TURNS];
        for [x, y, z] in &found {
            let ring = (below(g, f64::from(*z).clamp(-1.0, 1.0)) * RINGS as f64) as usize;
            let turn = (f64::from(*y).atan2(f64::from(*x)) / std::f64::consts::TAU).rem_euclid(1.0) * TURNS as f64;
            bins[ring.min(RINGS - 1) * TURNS + (turn as usize).min(TURNS - 1)] += 1.0;
        }
        let expected = found.len() as f64 / bins.len() as f64;
        let chi_square: f64 = bins.iter().map(|count| (count - expected) * (count - expected) / expected).sum();
        let freedom = (bins.len() - 1) as f64;
        assert!(chi_square < freedom + 4.0 * (2.0 * freedom).sqrt(), "g {g}: {chi_square} of {freedom}");
    }
}

#[inline(always)]
fn moments<L: Lanes>(l: L, g: f32, sums: &mut [f64; 2]) {
    const NODES: usize = 1 << 20;
    for node in 0..NODES {
        // Finer towards the peaks at both ends.
        let t = (node as f64 + 0.5) / NODES as f64;
        let cos = -(std::f64::consts::PI * t).cos();
        let width = std::f64::consts::PI * (std::f64::consts::PI * t).sin() / NODES as f64;
        let part = f64::from(henyey_greenstein(l.f(g), l.f(cos as f32)).to_array()[0]) * std::f64::consts::TAU * width;
        sums[0] += part;
        sums[1] += part * cos;
    }
}

#[test]
fn all_of_the_light_goes_somewhere() {
    for g in COSINES {
        let mut sums = [0.0; 2];
        dispatch!(Execution::Scalar, l => moments(l, g as f32, &mut sums));
        assert!((sums[0] - 1.0).abs() < 1e-3, "g {g}: {sums:?}");
        assert!((sums[1] - g).abs() < 1e-3, "g {g}: {sums:?}");
    }
}
