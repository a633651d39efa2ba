//! Bent shading normals against Cycles: a flat plane whose normal input leans towards +x.

use super::harness::{self, direction, spread};
use super::rows::{Values, surface};
use crate::normals::Normals;
use crate::parameter as p;
use crate::{Bump, Closure, Distribution, Hits, Lobes, ParameterValues, Surface, Switches};
use gonio_simd::{Execution, F, Frame, Lanes, Vec3, dispatch};

/// View, sun and azimuth, degrees.
const SUNS: [[f32; 3]; 5] = [[0.0, 60.0, 0.0], [0.0, 60.0, 180.0], [45.0, 30.0, 180.0], [60.0, 75.0, 90.0], [45.0, 80.0, 0.0]];
/// Views of the furnace; negative ones from the side away from the lean.
const VIEWS: [f32; 4] = [0.0, 45.0, -45.0, 75.0];
const SAMPLES: usize = 1 << 15;

/// A plane's answer: value under a sun, or the share of a white sky that samples over the plane find.
#[inline(always)]
fn answer<L: Lanes>(l: L, surface: &Surface, lean: f32, wo: [f32; 3], sun: Option<[f32; 3]>, out: &mut f64) {
    let (sin, cos) = lean.to_radians().sin_cos();
    let frame = Frame::from_tangent(Vec3::splat(l, [sin, 0.0, cos]), Vec3::splat(l, [1.0, 0.0, 0.0]));
    let up = frame.to_local(Vec3::splat(l, [0.0, 0.0, 1.0]));
    let wo = frame.to_local(Vec3::splat(l, wo));
    let normals = Normals { geometric: up, smooth: up, coat: None };
    let values = ParameterValues::constant(&surface.constants);
    let mut lobes = Lobes::empty(l);
    surface.resolve(
        l,
        &Hits { values: &values, at: 0, wo, entering: l.m(true), normals: Some(&normals), walks: true, carried: None, numbers: None },
        &mut lobes,
    );
    if let Some(sun) = sun {
        *out = f64::from(lobes.eval(l, wo, frame.to_local(Vec3::splat(l, sun))).0.to_rgb().r.to_array()[0]);
        return;
    }
    for chunk in spread(SAMPLES).chunks_exact(L::COUNT) {
        let mut u = [[0.5; 16]; 3];
        for (lane, number) in chunk.iter().enumerate() {
            (0..3).for_each(|axis| u[axis][lane] = number[axis]);
        }
        let u: [F<L>; 3] = [l.load(&u[0], 0), l.load(&u[1], 0), l.load(&u[2], 0)];
        let sample = harness::sample(l, &lobes, wo, u);
        let usable = sample.pdf.gt(0.0) & sample.wi.dot(up).gt(0.0);
        let factor = (sample.value.to_rgb().r / sample.pdf.max(1e-20)).keep_if(usable);
        *out += factor.to_array()[..L::COUNT].iter().map(|x| f64::from(*x)).sum::<f64>() / SAMPLES as f64;
    }
}

fn bumped(switches: Switches, values: Values) -> Surface {
    surface(Switches { bump: Bump::Cycles, ..switches }, values)
}

/// Name, surface and lean, values under the suns, and the furnace.
type Setting = (&'static str, Surface, f32, [f64; 5], [f64; 4]);

fn settings() -> Vec<Setting> {
    let glossy = || {
        let switches = Switches { distribution: Distribution::Ggx, ..Switches::single(Closure::Glossy) };
        bumped(switches, &[(p::BASE_COLOR, &[1.0; 3]), (p::ROUGHNESS, &[0.5])])
    };
    vec![
        (
            "N1",
            bumped(Switches::single(Closure::Diffuse), &[]),
            30.0,
            [0.214, 0.0, 0.1269, 0.05058, 0.1294],
            [0.70293, 0.70293, 0.70293, 0.70293],
        ),
        ("N2", glossy(), 30.0, [1.455, 0.0, 0.1233, 0.01798, 0.04536], [0.83411, 0.89940, 0.65558, 0.87752]),
        ("N3", glossy(), 70.0, [0.4554, 0.0, 0.0, 0.009304, 1.13], [0.53656, 0.48918, 0.65558, 0.76824]),
        (
            "N4",
            bumped(Switches::principled(), &[(p::ROUGHNESS, &[0.5])]),
            30.0,
            [0.2665, 0.0, 0.1276, 0.04942, 0.1264],
            [0.71046, 0.71340, 0.69186, 0.71606],
        ),
    ]
}

#[test]
fn bent_normals_have_cycles_values() {
    let mut failures = Vec::new();
    for (name, surface, lean, suns, furnace) in settings() {
        for ([view, sun, azimuth], expected) in SUNS.into_iter().zip(suns) {
            let mut found = 0.0;
            let (wo, sun) = (direction(view, 0.0), direction(sun, azimuth));
            dispatch!(Execution::best(), l => answer(l, &surface, lean, wo, Some(sun), &mut found));
            if (found - expected).abs() > 0.005 * expected + 1e-6 {
                failures.push(format!("{name} view {view} sun {sun:?}: found {found:.5}, expected {expected:.5}"));
            }
        }
        for (view, expected) in VIEWS.into_iter().zip(furnace) {
            let mut found = 0.0;
            let wo = direction(view, 0.0);
            dispatch!(Execution::best(), l => answer(l, &surface, lean, wo, None, &mut found));
            if (found - expected).abs() > 0.005 * expected {
                failures.push(format!("{name} view {view}: found {found:.5}, expected {expected:.5}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The share of light that a smooth coat about another normal mirrors, and where it goes.
#[inline(always)]
fn coat<L: Lanes>(l: L, surface: &Surface, wo: [f32; 3], normal: [f32; 3], out: &mut [f32; 5]) {
    let (wo, normal, up) = (Vec3::splat(l, wo), Vec3::splat(l, normal), Vec3::splat(l, [0.0, 0.0, 1.0]));
    let normals = Normals { geometric: up, smooth: up, coat: Some(normal) };
    let values = ParameterValues::constant(&surface.constants);
    let mut lobes = Lobes::empty(l);
    surface.resolve(
        l,
        &Hits { values: &values, at: 0, wo, entering: l.m(true), normals: Some(&normals), walks: true, carried: None, numbers: None },
        &mut lobes,
    );
    let sample = harness::sample(l, &lobes, wo, [l.f(0.0), l.f(0.3), l.f(0.7)]);
    let away = sample.wi - wo.reflect(normal);
    let value = sample.value.to_rgb().r;
    *out = [away.length(), value, sample.pdf, value / sample.pdf, wo.dot(normal)].map(|x| x.to_array()[0]);
}

#[test]
fn coats_mirror_about_their_own_normal() {
    let values: Values = &[
        (p::BASE_COLOR, &[0.0; 3]),
        (p::SPECULAR_WEIGHT, &[0.0]),
        (p::COAT_WEIGHT, &[1.0]),
        (p::COAT_ROUGHNESS, &[0.0]),
        (p::COAT_IOR, &[1.5]),
    ];
    let surface = surface(Switches::principled(), values);
    let mut out = [0.0; 5];
    dispatch!(Execution::best(), l => coat(l, &surface, direction(50.0, 30.0), direction(20.0, 120.0), &mut out));
    let [away, _, _, factor, cos] = out;
    let sin_t = (1.0 - cos * cos).sqrt() / 1.5;
    let cos_t = (1.0 - sin_t * sin_t).sqrt();
    let [s, p] = [(cos - 1.5 * cos_t) / (cos + 1.5 * cos_t), (1.5 * cos - cos_t) / (1.5 * cos + cos_t)];
    assert!(away < 1e-5 && (factor - 0.5 * (s * s + p * p)).abs() < 1e-4, "{out:?}");
}
