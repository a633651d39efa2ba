//! Walks in a half-space, whose surface the test finds by itself: albedos against the colour asked for and against Cycles.

use super::harness::{self, direction, random};
use super::rows::{Values, surface};
use crate::parameter as p;
use crate::phase::henyey_greenstein;
use crate::subsurface::{LEAST_THROUGHPUT, MAXIMUM_STEPS, REDUCED_FROM};
use crate::{Closure, Hits, Lobes, ParameterValues, SubsurfaceMethod, Surface, Switches};
use gonio_simd::{Execution, F, Lanes, Spectrum, Vec3, dispatch};

/// Registers of walks.
const WALKS: usize = 40_000;

/// Numbers without end from a fixed seed.
struct Numbers {
    seed: u64,
    stock: Vec<[f32; 3]>,
}

impl Numbers {
    #[inline(always)]
    fn next<L: Lanes>(&mut self, l: L) -> F<L> {
        let mut lanes = [0.5; 16];
        for lane in lanes.iter_mut().take(L::COUNT) {
            *lane = self.one();
        }
        l.load(&lanes, 0)
    }
    fn one(&mut self) -> f32 {
        if self.stock.is_empty() {
            self.seed += 1;
            self.stock = random(1 << 16, self.seed);
        }
        self.stock.pop().map_or(0.5, |u| u[0])
    }
}

/// Mean throughput of all that happens at the surface, seen from `wo`; what goes back is white light.
#[inline(always)]
fn albedo<L: Lanes>(l: L, surface: &Surface, wo: [f32; 3], sum: &mut [f64; 3]) {
    let values = ParameterValues::constant(&surface.constants);
    let wo = Vec3::splat(l, wo);
    let mut lobes = Lobes::empty(l);
    surface.resolve(
        l,
        &Hits { values: &values, at: 0, wo, entering: l.m(true), normals: None, walks: true, carried: None, numbers: None },
        &mut lobes,
    );
    let mut numbers = Numbers { seed: 7, stock: Vec::new() };
    for _ in 0..WALKS / L::COUNT {
        let u = [numbers.next(l), numbers.next(l), numbers.next(l)];
        let sample = harness::sample(l, &lobes, wo, u);
        let usable = sample.pdf.gt(0.0);
        let mut throughput = (sample.value * sample.pdf.max(1e-20).recip()).keep_if(usable);
        let mut walking = sample.entered & usable;
        let mut gone = throughput.keep_if(!walking);
        let (mut direction, mut depth) = (sample.wi, l.f(0.0));
        let Some(medium) = lobes.medium() else { return };
        for step in 0..MAXIMUM_STEPS {
            if !walking.any() {
                break;
            }
            let here = if step < REDUCED_FROM { *medium } else { medium.reduced() };
            let flight = here.flight(throughput, [numbers.next(l), numbers.next(l)]);
            let to_surface = direction.z.gt(0.0).select(-depth / direction.z.max(1e-9), l.f(f32::MAX));
            let out = to_surface.le(flight.distance);
            let distance = out.select(to_surface, flight.distance);
            throughput = here.arrive(throughput, &flight, distance, out);
            depth = direction.z.mul_add(distance, depth);
            gone += throughput.keep_if(walking & out);
            walking = walking.and_not(out) & throughput.max_component().gt(LEAST_THROUGHPUT);
            direction = here.scatter(direction, [numbers.next(l), numbers.next(l)]);
        }
        let gone = gone.to_rgb();
        for (sum, channel) in sum.iter_mut().zip([gone.r, gone.g, gone.b]) {
            *sum += channel.to_array()[..L::COUNT].iter().map(|x| f64::from(*x)).sum::<f64>() / WALKS as f64;
        }
    }
}

fn measure(surface: &Surface, angle: f32) -> [f64; 3] {
    let mut sum = [0.0; 3];
    dispatch!(Execution::best(), l => albedo(l, surface, direction(angle, 0.0), &mut sum));
    sum
}

/// Principled of subsurface 1 as in the measured rows, with the given Specular IOR Level.
fn skin(method: SubsurfaceMethod, level: f32, more: Values) -> Surface {
    let level = [2.0 * level];
    let mut values: Vec<(usize, &[f32])> = vec![
        (p::ROUGHNESS, &[0.5]),
        (p::SPECULAR_WEIGHT, &level),
        (p::SUBSURFACE_WEIGHT, &[1.0]),
        (p::SUBSURFACE_COLOR, &[0.8, 0.5, 0.2]),
        (p::SUBSURFACE_RADIUS, &[0.1, 0.05, 0.025]),
    ];
    values.extend_from_slice(more);
    surface(Switches { subsurface: method, ..Switches::principled() }, &values)
}

/// Four standard errors of both: ours from the number of walks (a factor's variance is at most its mean), Cycles' as listed.
fn allowed(expected: f64) -> f64 {
    4.0 * ((expected * (1.0 - expected)).max(0.01) / WALKS as f64).sqrt() + 4e-3
}

fn check(rows: &[(&str, SubsurfaceMethod, f32, [[f64; 3]; 3])]) {
    let mut failures = Vec::new();
    for (name, method, level, expected) in rows {
        let surface = skin(*method, *level, &[]);
        for (angle, expected) in [0.0, 45.0, 75.0].into_iter().zip(expected) {
            let found = measure(&surface, angle);
            if found.iter().zip(expected).any(|(f, e)| (f - e).abs() > allowed(*e)) {
                failures.push(format!("{name} at {angle}: found {found:.4?}, expected {expected:.4?}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn old_walks_have_cycles_albedo() {
    use SubsurfaceMethod::{RandomWalkLegacy, RandomWalkSkin};
    check(&[
        (
            "legacy, no specular",
            RandomWalkLegacy,
            0.0,
            [[0.76994, 0.44280, 0.16215], [0.80379, 0.49125, 0.19110], [0.86134, 0.59249, 0.26370]],
        ),
        (
            "legacy, specular",
            RandomWalkLegacy,
            0.5,
            [[0.77927, 0.46503, 0.19409], [0.79661, 0.49124, 0.21387], [0.83224, 0.56534, 0.29700]],
        ),
        ("skin, no specular", RandomWalkSkin, 0.0, [[0.79247, 0.47779, 0.18456], [0.80577, 0.49829, 0.19687], [0.82778, 0.53725, 0.22468]]),
        ("skin, specular", RandomWalkSkin, 0.5, [[0.79979, 0.49697, 0.21478], [0.81351, 0.52064, 0.23344], [0.84349, 0.58949, 0.31546]]),
    ]);
}

#[test]
fn profiles_have_the_colour_asked_for() {
    let colour = [0.8, 0.5, 0.2];
    check(&[("burley", SubsurfaceMethod::Burley, 0.0, [colour; 3])]);
}

#[test]
fn radii_do_not_change_the_albedo() {
    let surface = |radius: f32| skin(SubsurfaceMethod::RandomWalk, 0.0, &[(p::SUBSURFACE_RADIUS, &[radius; 3])]);
    let (short, long) = (measure(&surface(1e-3), 45.0), measure(&surface(10.0), 45.0));
    assert!(short.iter().zip(long).all(|(a, b)| (a - b).abs() < 2.0 * allowed(b)), "{short:?} and {long:?}");
}

#[test]
fn anisotropy_keeps_the_diffuse_albedo() {
    // Similarity holds for light that enters evenly; from an oblique view both walks are near it.
    let surface = |g: f32| skin(SubsurfaceMethod::RandomWalk, 0.0, &[(p::SUBSURFACE_ANISOTROPY, &[g])]);
    for g in [-0.5, 0.5, 0.8] {
        let (even, bent) = (measure(&surface(0.0), 55.0), measure(&surface(g), 55.0));
        assert!(even.iter().zip(bent).all(|(a, b)| (a - b).abs() < 0.05), "g {g}: {even:?} and {bent:?}");
    }
}

#[test]
fn channels_without_radius_are_diffuse() {
    let switches = Switches { subsurface: SubsurfaceMethod::RandomWalk, ..Switches::single(Closure::Subsurface) };
    let surface = surface(switches, &[(p::BASE_COLOR, &[0.8, 0.5, 0.2]), (p::SUBSURFACE_RADIUS, &[0.0, 0.0, 0.0])]);
    let view = harness::View::new(&surface, 30.0, true);
    let [reflected, _] = view.albedo(1 << 12);
    assert!(reflected.iter().zip([0.8, 0.5, 0.2]).all(|(f, e)| (f - e).abs() < 1e-3), "{reflected:?}");
    assert!(view.sample(&random(1 << 10, 3)).iter().all(|s| !s.entered));
}

/// Sums of one kernel: mean cosine of scattered directions, and of the phase function over the sphere.
#[inline(always)]
fn phase<L: Lanes>(l: L, g: f32, out: &mut [f64; 3]) {
    let colour = Spectrum::constant(l.f(0.5));
    let method = SubsurfaceMethod::RandomWalk;
    let medium = crate::subsurface::WalkMedium::new(method, colour, colour, l.f(g), l.f(1.4)).0;
    let before = Vec3::new(l.f(0.6), l.f(0.0), l.f(-0.8));
    let mut numbers = Numbers { seed: 3, stock: Vec::new() };
    let count = 100_000 / L::COUNT;
    for _ in 0..count {
        let after = medium.scatter(before, [numbers.next(l), numbers.next(l)]);
        out[0] += f64::from(after.dot(before).to_array()[0]) / count as f64;
    }
    let nodes = 20_000;
    for node in 0..nodes {
        let cos = (node as f32 + 0.5) / nodes as f32 * 2.0 - 1.0;
        let value =
            f64::from(henyey_greenstein(medium.anisotropy, l.f(cos)).to_array()[0]) * 4.0 * core::f64::consts::PI / f64::from(nodes);
        out[1] += value;
        out[2] += value * f64::from(cos);
    }
}

#[test]
fn scattering_follows_its_phase_function() {
    for g in [-0.7, 0.0, 0.4, 0.9] {
        let mut out = [0.0; 3];
        dispatch!(Execution::best(), l => phase(l, g, &mut out));
        // A cosine's variance is at most 1; four standard errors of the fewest lanes' mean.
        assert!((out[0] - f64::from(g)).abs() < 4.0 / (100_000.0_f64 / 16.0).sqrt(), "g {g}: sampled {}", out[0]);
        assert!((out[1] - 1.0).abs() < 2e-3 && (out[2] - f64::from(g)).abs() < 4e-3, "g {g}: integrals {} and {}", out[1], out[2]);
    }
}
