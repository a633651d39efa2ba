//! Elliptic fibres: energy over many ways inside, smooth ones against the rays of geometric optics in double precision, and what is not there.

use super::hair::{about, fresnel};
use super::harness::{Sample, View, random};
use super::rows::{Values, single};
use crate::hair::NUMBERS;
use crate::parameter as p;
use crate::{Closure, Surface};

type Pair = [f64; 2];

/// The fibre seen with many ways inside.
fn ways(surface: &Surface, wo: [f32; 3], count: usize) -> impl Iterator<Item = View> {
    let view = View::of(surface, wo, true);
    let numbers = random(3 * count, 11).concat();
    let ways: Vec<[f32; NUMBERS]> = numbers.chunks_exact(9).map(|u| std::array::from_fn(|i| u[i])).collect();
    ways.into_iter().map(move |inside| View { inside, ..view.clone() })
}

fn fibre(values: Values) -> Surface {
    single(Closure::HairElliptic, values)
}

/// Mean of what leaves, over ways inside.
fn albedo(surface: &Surface, wo: [f32; 3]) -> f64 {
    const WAYS: usize = 20_000;
    const SAMPLES: usize = 16;
    let leaves = |s: &Sample| if s.pdf > 0.0 { f64::from(s.value[1] / s.pdf) } else { 0.0 };
    let sum: f64 = ways(surface, wo, WAYS).zip(0..).flat_map(|(view, seed)| view.sample(&random(SAMPLES, seed))).map(|s| leaves(&s)).sum();
    sum / (WAYS * SAMPLES) as f64
}

/// But for what facets send under the round surface, from where it does not come back.
#[test]
fn white_fibres_keep_light() {
    for (roughness, aspect, tilt, least) in [(0.55, 1.0, 0.0, 0.98), (0.55, 0.6, 0.035, 0.94), (0.2, 0.85, 0.0, 0.99), (0.9, 1.5, 0.0, 0.8)]
    {
        let values: Values =
            &[(p::ROUGHNESS, &[roughness]), (p::HAIR_ABSORPTION, &[0.0; 3]), (p::HAIR_ASPECT, &[aspect]), (p::HAIR_TILT, &[tilt])];
        let white = fibre(values);
        for wo in [about(0.0, 0.0), about(30.0, 35.0), about(-50.0, -20.0)] {
            let kept = albedo(&white, wo);
            assert!(kept > least && kept < 1.005, "{roughness}, {aspect} from {wo:?}: {kept}");
        }
    }
}

#[test]
fn beside_the_ellipse_there_is_nothing() {
    // The longer axis stands across the normal: the fibre is met up to where sin φ = √(cos² φ + sin² φ / 4), at 49.1 degrees.
    let flat = fibre(&[(p::HAIR_ASPECT, &[0.5]), (p::HAIR_TURN, &[std::f32::consts::FRAC_PI_2])]);
    let opacity = |phi: f64| View::of(&flat, about(20.0, phi), true).summary().opacity;
    for (phi, present) in [(0.0, 1.0), (48.5, 1.0), (49.7, 0.0), (-48.5, 1.0), (-49.7, 0.0), (80.0, 0.0)] {
        assert_eq!(opacity(phi), present, "{phi}");
    }
    let round = fibre(&[]);
    assert_eq!(View::of(&round, about(0.0, 89.0), true).summary().opacity, 1.0);
}

/// Directions and energies of R, TT and TRT of a smooth fibre that is seen from `wo`, with the longer axis `turn` from the normal (0, 0, 1).
fn rays(wo: [f64; 3], minor: f64, turn: f64, (absorption, eta): (f64, f64)) -> [([f64; 3], f64); 3] {
    let (sin, cos) = turn.sin_cos();
    let inwards = |v: [f64; 3]| [v[0], cos * v[2] - sin * v[1], -(cos * v[1] + sin * v[2])];
    let outwards = |v: [f64; 3]| [v[0], -(sin * v[1] + cos * v[2]), cos * v[1] - sin * v[2]];
    let (view, normal) = (inwards(wo), inwards([0.0, 0.0, 1.0]));
    // Where the ray meets the round outline, and from there the ellipse: y² + z² / minor² = 1.
    let mut at = meets([normal[1], normal[2]], [-view[1], -view[2]], minor, false);
    let mut to = [0.0; 3];
    let (mut energy, mut found) = (1.0, [([0.0; 3], 0.0); 3]);
    let mut from = view;
    for (way, found) in found.iter_mut().enumerate() {
        let outside = [at[0], at[1] / (minor * minor)];
        let scale = outside[0].hypot(outside[1]).recip() * if way == 0 { 1.0 } else { -1.0 };
        let n = [0.0, outside[0] * scale, outside[1] * scale];
        let c = from[1] * n[1] + from[2] * n[2];
        let ratio = if way == 0 { eta } else { 1.0 / eta };
        let squared = 1.0 - (1.0 - c * c) / (ratio * ratio);
        let t = squared.max(0.0).sqrt();
        let f = fresnel(c, ratio);
        let mirrored = [0, 1, 2].map(|k| 2.0 * c * n[k] - from[k]);
        let refracted = [0, 1, 2].map(|k| n[k] * (c / ratio - t) - from[k] / ratio);
        let (leaves, stays) = if way == 0 { (mirrored, refracted) } else { (refracted, mirrored) };
        let share = if way == 0 { f } else { 1.0 - f };
        *found = (outwards(leaves), energy * share);
        energy *= 1.0 - share;
        to.copy_from_slice(&stays);
        let end = meets(at, [to[1], to[2]], minor, true);
        let length = (end[0] - at[0]).hypot(end[1] - at[1]) / to[1].hypot(to[2]);
        energy *= (-absorption * length).exp();
        (at, from) = (end, to.map(|x| -x));
    }
    found
}

/// The first place of the ellipse on a line through `at`, or the other one of a line that starts there.
fn meets(at: Pair, along: Pair, minor: f64, other: bool) -> Pair {
    let square = minor * minor;
    let a = along[0] * along[0] + along[1] * along[1] / square;
    let b = at[0] * along[0] + at[1] * along[1] / square;
    let c = at[0] * at[0] + at[1] * at[1] / square - 1.0;
    let root = (b * b - a * c).max(0.0).sqrt();
    let way = if other { -2.0 * b / a } else { (-b - root) / a };
    [at[0] + way * along[0], at[1] + way * along[1]]
}

#[test]
fn smooth_fibres_are_those_of_geometric_optics() {
    for (minor, turn) in [(1.0, 0.0), (0.8, 0.0), (0.6, 0.9), (0.6, -2.0)] {
        for (theta, phi) in [(0.0, 10.0), (25.0, 30.0), (-40.0, -15.0)] {
            let (absorption, eta) = (0.3, 1.55);
            let smooth = fibre(&[
                (p::ROUGHNESS, &[0.01]),
                (p::HAIR_ABSORPTION, &[absorption; 3]),
                (p::HAIR_TILT, &[0.0]),
                (p::HAIR_ASPECT, &[minor]),
                (p::HAIR_TURN, &[turn]),
                (p::IOR, &[eta]),
            ]);
            let wo = about(theta, phi);
            let samples: Vec<Sample> = ways(&smooth, wo, 16).zip(0..).flat_map(|(view, seed)| view.sample(&random(4000, seed))).collect();
            let expected = rays(wo.map(f64::from), f64::from(minor), f64::from(turn), (f64::from(absorption), f64::from(eta)));
            for (way, (direction, energy)) in expected.into_iter().enumerate().filter(|(_, (_, energy))| *energy > 0.0) {
                let near = |s: &&Sample| s.pdf > 0.0 && (0..3).map(|k| f64::from(s.wi[k]) * direction[k]).sum::<f64>() > 0.99;
                let sum: f64 = samples.iter().filter(near).map(|s| f64::from(s.value[1] / s.pdf)).sum();
                let found = sum / samples.len() as f64;
                // What the wide lobe sends there too, and the tails of the facets' distribution, are about that much.
                assert!(
                    (found - energy).abs() < 0.03 * energy + 0.004,
                    "{minor}, {turn} at {theta}, {phi}, {way}: {found}, expected {energy}"
                );
            }
        }
    }
}

#[test]
fn parameters_at_their_ends_give_finite_light() {
    let ends: [Values; 9] = [
        &[(p::ROUGHNESS, &[0.0])],
        &[(p::ROUGHNESS, &[9.0]), (p::HAIR_ABSORPTION, &[0.0; 3])],
        &[(p::HAIR_ABSORPTION, &[1e9, 0.0, -1.0])],
        &[(p::IOR, &[0.0])],
        &[(p::IOR, &[100.0]), (p::HAIR_ABSORPTION, &[0.0; 3])],
        &[(p::HAIR_TILT, &[1.5])],
        &[(p::HAIR_ASPECT, &[0.0])],
        &[(p::HAIR_ASPECT, &[1e9]), (p::HAIR_WHOLE, &[1.0])],
        &[(p::HAIR_TINT_R, &[-1.0; 3]), (p::HAIR_TINT_TT, &[0.0; 3]), (p::HAIR_TINT_TRT, &[0.0; 3])],
    ];
    let views = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-0.999_999, 0.0, 0.001_4], [0.6, 0.8, -1e-4]];
    for values in ends {
        for wo in views {
            for view in ways(&fibre(values), wo, 8) {
                for s in view.sample(&random(64, 5)) {
                    assert!(s.pdf.is_finite() && s.pdf >= 0.0 && s.value.iter().all(|x| x.is_finite() && *x >= 0.0), "{values:?}: {s:?}");
                    let length: f32 = s.wi.iter().map(|x| x * x).sum();
                    assert!(s.pdf == 0.0 || (length - 1.0).abs() < 1e-3, "{values:?}: {s:?}");
                }
                assert!(view.eval(&views).iter().all(|(value, pdf)| value[0].is_finite() && pdf.is_finite()), "{values:?}");
            }
        }
    }
}
