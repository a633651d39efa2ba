//! Light paths: flux is scattered as the camera's paths see it, and sampling fits what is evaluated.

use super::harness::{View, direction, lanes, rgb, sample, spread};
use super::rows;
use crate::normals::Normals;
use crate::parameter as p;
use crate::{Hits, LightHits, Lobes, ParameterValues};
use gonio_simd::{Execution, Lanes, Vec3, dispatch};

/// What a surface makes of flux that comes from the view's direction.
#[derive(Default)]
struct Scattered {
    /// Direction and throughput factor of samples; delta and walking ones have no density.
    samples: Vec<([f32; 3], [f32; 3], bool)>,
    /// Flux per solid angle, by direction.
    flux: Vec<[f32; 3]>,
}

#[inline(always)]
fn kernel<L: Lanes>(l: L, (view, whole): (&View, bool), numbers: &[[f32; 3]], directions: &[[f32; 3]], out: &mut Scattered) {
    let wo = Vec3::splat(l, view.wo);
    let values = ParameterValues::constant(&view.surface.constants);
    let geometric = Vec3::splat(l, view.geometric.unwrap_or([0.0, 0.0, 1.0]));
    let normals = Normals { geometric, smooth: Vec3::splat(l, [0.0, 0.0, 1.0]), coat: None };
    let normals = view.geometric.map(|_| normals);
    let hits = Hits {
        values: &values,
        at: 0,
        wo,
        entering: l.m(view.entering),
        normals: normals.as_ref(),
        walks: true,
        carried: None,
        numbers: None,
    };
    let (mut lobes, mut room) = (Lobes::empty(l), Lobes::empty(l));
    view.surface.resolve(l, &hits, &mut lobes);
    let light = LightHits { hits, geometric, whole };
    for chunk in numbers.chunks(L::COUNT) {
        let s = sample(l, &lobes, wo, lanes(l, chunk));
        let factor = rgb(view.surface.flux_factor(l, &light, &lobes, &s, &mut room));
        let (wi, pdf) = ([s.wi.x, s.wi.y, s.wi.z].map(|x| x.to_array()), s.pdf.to_array());
        let alone = (s.delta | s.entered).bits();
        for lane in 0..chunk.len() {
            let factor = if pdf[lane] > 0.0 { factor.map(|x| x[lane]) } else { [0.0; 3] };
            out.samples.push((wi.map(|x| x[lane]), factor, alone >> lane & 1 == 1));
        }
    }
    for chunk in directions.chunks(L::COUNT) {
        let [x, y, z] = lanes(l, chunk);
        let flux = rgb(view.surface.flux(l, &light, &lobes, Vec3::new(x, y, z), &mut room));
        out.flux.extend((0..chunk.len()).map(|lane| flux.map(|x| x[lane])));
    }
}

fn scattered(view: &View, numbers: &[[f32; 3]], directions: &[[f32; 3]]) -> Scattered {
    scattered_by((view, false), numbers, directions)
}

/// The same where no flux may get lost at interfaces.
fn scattered_by(view: (&View, bool), numbers: &[[f32; 3]], directions: &[[f32; 3]]) -> Scattered {
    let mut out = Scattered::default();
    dispatch!(Execution::best(), l => kernel(l, view, numbers, directions, &mut out));
    out
}

/// Uniform directions of the sphere.
fn sphere(count: usize) -> Vec<[f32; 3]> {
    let place = |u: &[f32; 3]| {
        let (z, phi) = (1.0 - 2.0 * u[0], std::f32::consts::TAU * u[1]);
        let r = (1.0 - z * z).max(0.0).sqrt();
        [r * phi.cos(), r * phi.sin(), z]
    };
    spread(count).iter().map(place).collect()
}

#[test]
fn samples_carry_the_flux_that_is_evaluated() {
    const COUNT: usize = 1 << 16;
    let mut failures = Vec::new();
    for (name, surface) in rows::all() {
        for angle in [10.0, 60.0] {
            let view = View::new(&surface, angle, true);
            let found = scattered(&view, &spread(COUNT), &sphere(COUNT));
            for side in [1.0, -1.0] {
                let here = |z: f32| z * side > 0.0;
                let sampled: f64 =
                    found.samples.iter().filter(|(wi, _, alone)| here(wi[2]) && !alone).map(|(_, factor, _)| f64::from(factor[1])).sum();
                let whole: f64 =
                    sphere(COUNT).iter().zip(&found.flux).filter(|(wi, _)| here(wi[2])).map(|(_, flux)| f64::from(flux[1])).sum();
                let (sampled, whole) = (sampled / COUNT as f64, whole * 4.0 * std::f64::consts::PI / COUNT as f64);
                // Narrow lobes leave the uniform directions few hits.
                if (sampled - whole).abs() > 0.03 * whole + 3e-3 {
                    failures.push(format!("{name} at {angle}, side {side}: {sampled:.4} sampled, {whole:.4} over all directions"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn flux_is_what_the_camera_sees() {
    // Reflected light: f(o, i) |cos o| for a unit of flux from i, with the view at o.
    // Toon lobes send light where they would for a camera in its place.
    for (name, surface) in rows::all().into_iter().filter(|(name, _)| !name.contains("toon")) {
        for (from, to) in [((20.0, 0.0), (50.0, 70.0)), ((70.0, 0.0), (30.0, 200.0)), ((40.0, 0.0), (75.0, 180.0))] {
            let (from, to) = (direction(from.0, from.1), direction(to.0, to.1));
            let arriving = View::of(&surface, from, true);
            let seen = View::of(&surface, to, true).eval(&[from])[0].0;
            let flux = scattered(&arriving, &[], &[to]).flux[0];
            for (flux, seen) in flux.iter().zip(seen.map(|x| x * to[2] / from[2])) {
                assert!((flux - seen).abs() <= 1e-4 * seen + 1e-6, "{name}: {flux} of flux, {seen} seen");
            }
        }
    }
}

#[test]
fn white_glass_keeps_all_flux_whatever_its_normals() {
    // A delta lobe under a bent normal: flux in over flux out is the cosines' business, and comes to one over a whole surface only on average;
    // without bending each path keeps all.
    for roughness in [0.0, 0.5] {
        let glass = rows::glass(roughness, crate::Distribution::MultiGgx);
        let view = View::new(&glass, 30.0, true);
        let found = scattered_by((&view, true), &spread(1 << 14), &[]);
        let mean = found.samples.iter().map(|(_, factor, _)| f64::from(factor[1])).sum::<f64>() / f64::from(1 << 14);
        assert!((mean - 1.0).abs() < 8e-3, "roughness {roughness}: {mean}");
    }
}

/// Glass of index 1.5, with a rough coat on it or without.
fn interfaces(roughness: f32) -> [(&'static str, crate::Surface); 2] {
    let glass: &[(usize, &[f32])] = &[(p::TRANSMISSION_WEIGHT, &[1.0]), (p::IOR, &[1.5]), (p::ROUGHNESS, &[roughness])];
    let coat: &[(usize, &[f32])] = &[(p::COAT_WEIGHT, &[1.0]), (p::COAT_ROUGHNESS, &[0.3]), (p::COAT_COLOR, &[0.8, 0.6, 0.4])];
    [("glass", rows::glass(roughness, crate::Distribution::MultiGgx)), ("coated", rows::principled(&[glass, coat].concat()))]
}

/// A direction in the frame of the surface's other side.
fn from_behind([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, -y, -z]
}

#[test]
fn flux_that_passes_an_interface_is_what_the_camera_sees() {
    // The camera's radiance lacks the squared index.
    for (name, surface) in [0.2, 0.4, 0.7].into_iter().flat_map(interfaces) {
        for (entering, index) in [(true, 1.5_f32), (false, 1.0 / 1.5)] {
            for (from, to) in [((15.0, 0.0), (170.0, 185.0)), ((35.0, 0.0), (150.0, 200.0)), ((30.0, 0.0), (145.0, 170.0))] {
                let (from, to) = (direction(from.0, from.1), direction(to.0, to.1));
                let arriving = View::of(&surface, from, entering);
                let view = View::of(&surface, from_behind(to), !entering);
                let seen = view.eval(&[from_behind(from)])[0].0.map(|x| x * index * index * to[2].abs() / from[2]);
                let flux = scattered(&arriving, &[], &[to]).flux[0];
                assert!(seen[1] > 1e-3, "{name}: nothing passes");
                for (flux, seen) in flux.iter().zip(seen) {
                    assert!((flux - seen).abs() <= 1e-3 * seen, "{name}, entering {entering}: {flux} of flux, {seen} seen");
                }
            }
        }
    }
}

#[test]
fn flux_that_passes_a_smooth_interface_is_what_the_camera_sees() {
    const COUNT: usize = 1 << 12;
    for (name, surface) in interfaces(0.0) {
        for entering in [true, false] {
            let arriving = View::of(&surface, direction(35.0, 0.0), entering);
            let samples = scattered(&arriving, &spread(COUNT), &[]).samples;
            let passed: Vec<_> = samples.iter().filter(|(wi, _, alone)| *alone && wi[2] < 0.0).collect();
            let view = View::of(&surface, from_behind(passed[0].0), !entering);
            let seen = view.albedo(COUNT)[1];
            for (channel, seen) in seen.into_iter().enumerate() {
                let flux = passed.iter().map(|(_, factor, _)| f64::from(factor[channel])).sum::<f64>() / COUNT as f64;
                assert!((flux - seen).abs() <= 5e-3 * seen, "{name}, entering {entering}: {flux} of flux, {seen} seen");
            }
        }
    }
}
