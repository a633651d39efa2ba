//! Smooth normals far from the triangle's: the lobes of all models keep their light above the triangle.

use super::chi_square::test_all;
use super::harness::{View, direction, spread};
use super::rows::{self, surface};
use crate::parameter as p;
use crate::{Bump, Closure, Surface, Switches};

/// Angles of view and triangle's normal to the shading normal, degrees: a view from behind it, and one whose mirror image falls inwards.
const VIEWS: [[f32; 2]; 2] = [[95.0, 20.0], [80.0, 15.0]];

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A white mirror in every model.
fn mirrors() -> Vec<(&'static str, Surface)> {
    let (white, smooth): ([f32; 3], [f32; 1]) = ([1.0; 3], [0.0]);
    let values = [(p::BASE_COLOR, &white[..]), (p::METAL_EDGE_TINT, &white[..]), (p::METALNESS, &[1.0]), (p::ROUGHNESS, &smooth[..])];
    let metal = |switches| surface(switches, &values);
    vec![
        ("OpenPBR", metal(Switches::default())),
        ("Principled", metal(Switches { bump: Bump::Cycles, ..Switches::principled() })),
        ("preview surface", metal(Switches::preview_surface())),
        ("standard surface", metal(Switches::standard_surface())),
        ("glTF", metal(Switches::gltf())),
        ("glossy", rows::single(Closure::Glossy, &[(p::BASE_COLOR, &white), (p::ROUGHNESS, &smooth)])),
    ]
}

#[test]
fn mirrors_lose_nothing_at_rims() {
    for (name, surface) in mirrors() {
        for [view, lean] in VIEWS {
            // Gulbrandsen's fit takes reflectances up to 0.999.
            for sample in View::smooth(&surface, view, lean, true).sample(&spread(16)) {
                let height = dot(sample.wi, direction(lean, 0.0));
                assert!(sample.delta && height > 0.0099, "{name} at {view}: {height}");
                assert!((sample.value[1] / sample.pdf - 1.0).abs() < 5e-3, "{name} at {view}: {:?}", sample.value);
            }
        }
    }
}

#[test]
fn smooth_normals_make_no_energy() {
    for (name, surface) in rows::undrawn() {
        for [view, lean] in VIEWS {
            let [reflected, transmitted] = View::smooth(&surface, view, lean, true).albedo(1 << 14);
            assert!(reflected[1] + transmitted[1] < 1.01, "{name} at {view}: {reflected:?} {transmitted:?}");
        }
    }
}

#[test]
fn samples_have_the_values_of_evaluation() {
    for (name, surface) in rows::all().into_iter().filter(|(_, surface)| surface.switches.bump == Bump::None) {
        for [view, lean] in VIEWS {
            let view = View::smooth(&surface, view, lean, true);
            let samples: Vec<_> = view.sample(&spread(256)).into_iter().filter(|s| s.pdf > 0.0 && !s.delta && !s.entered).collect();
            let directions: Vec<_> = samples.iter().map(|sample| sample.wi).collect();
            for (sample, (value, pdf)) in samples.iter().zip(view.eval(&directions)) {
                let same = |a: f32, b: f32| (a - b).abs() <= 1e-4 * a.abs().max(b.abs()) + 1e-7;
                assert!(same(sample.pdf, pdf) && same(sample.value[1], value[1]), "{name}: {sample:?}, {value:?}, {pdf}");
            }
        }
    }
}

#[test]
fn samples_follow_their_density() {
    // Raised mirror directions graze, where lobes are narrow.
    test_all(
        1e-2,
        &[
            |surface, entering| View::smooth(surface, VIEWS[0][0], VIEWS[0][1], entering),
            |surface, entering| View::smooth(surface, VIEWS[1][0], VIEWS[1][1], entering),
        ],
    );
}
