//! Interference in a thin film over a dielectric or a metal (Belcour, Barla 2017): an Airy sum over the path differences of one to three
//! passages, each weighted with the Fourier transform of the colour channels' sensitivities, for both polarisations.
//!
//! The table holds real and then imaginary parts for red, green and blue at path differences of 60 µm / 1022π: the CIE 1931 curves in linear
//! Rec.709 over frequency, transformed and divided by their integrals. The grid is Cycles', whose interpolation is part of its look.

use super::energy::floats;
use super::fresnel::{f82_channel, f82_coefficients, gulbrandsen_channel, normal_reflectance};
use core::f32::consts::PI;
use gonio_simd::{F, Lanes, M, Rgb, Spectrum, Wavelengths};

/// Nodes along the path difference.
const NODES: usize = 512;
/// Nodes to a nanometre of path difference.
const PER_NANOMETRE: f32 = (NODES - 1) as f32 * 2.0 * PI / 60_000.0;
/// Films up to this many nanometres show nothing.
const THINNEST: f32 = 0.1;
/// Passages summed.
const ORDERS: usize = 3;

pub(super) static SENSITIVITY: [f32; 6 * NODES] = floats(include_bytes!("tables/film.f32"));

/// A film as seen from one side, the medium on that side having index 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Film<L: Lanes> {
    /// Share of the surface that it covers.
    pub(crate) weight: F<L>,
    /// Index, relative to what it is seen from.
    ior: F<L>,
    /// Index of that.
    near: F<L>,
    /// Thickness, nanometres.
    thickness: F<L>,
    /// Wavelengths in nanometres, where light has any.
    nanometres: Option<Spectrum<L>>,
}

/// Complex numbers, one for each component of light.
type Complex<L> = [Spectrum<L>; 2];

/// Reflection of both polarisations at an interface between dielectrics.
#[derive(Clone, Copy, Debug)]
struct Polarised<L: Lanes> {
    /// Reflectances s and p.
    reflectance: [F<L>; 2],
    /// −1 where the amplitude turns its sign.
    sign: [F<L>; 2],
    /// Cosine on the far side.
    cos: F<L>,
    total: M<L>,
}

#[inline(always)]
fn polarised<L: Lanes>(c: F<L>, eta: F<L>) -> Polarised<L> {
    let l = c.lanes();
    let squared = 1.0 - (1.0 - c * c) / (eta * eta);
    let cos = squared.safe_sqrt();
    let s = (c - eta * cos) / (c + eta * cos).max(1e-9);
    let p = (eta * c - cos) / (eta * c + cos).max(1e-9);
    let sign = [l.f(1.0).copysign(s), l.f(1.0).copysign(p)];
    Polarised { reflectance: [s * s, p * p], sign, cos, total: squared.le(0.0) }
}

/// Sensitivities at a path difference in nanometres.
#[inline(always)]
fn sensitivity<L: Lanes>(l: L, difference: F<L>) -> Complex<L> {
    let x = (difference * PER_NANOMETRE).clamp(0.0, (NODES - 1) as f32);
    let below = x.floor().min((NODES - 2) as f32);
    let (index, t) = (below.to_i32(), x - below);
    let mut values = [l.f(0.0); 6];
    for (value, table) in values.iter_mut().zip(SENSITIVITY.as_chunks::<NODES>().0) {
        let [low, high] = l.gather_pairs(table, index);
        *value = low.lerp(high, t);
    }
    let [r, g, b, r_imaginary, g_imaginary, b_imaginary] = values;
    let rgb = Wavelengths::rgb(l);
    [rgb.coefficient(Rgb::new(r, g, b)), rgb.coefficient(Rgb::new(r_imaginary, g_imaginary, b_imaginary))]
}

/// Cosine and sine of the phase of a path difference, both in nanometres.
#[inline(always)]
fn turned<L: Lanes>(difference: F<L>, nanometres: Spectrum<L>) -> Complex<L> {
    nanometres.zip(
        nanometres,
        #[inline(always)]
        |nanometres, _| {
            let turns = difference / nanometres;
            let (sin, cos) = (turns - turns.floor()).sin_cos_turns();
            [cos, sin]
        },
    )
}

/// The sum for one polarisation: reflectance `top` of the film's upper side, `bottom` of its lower one, `phase` of both inner reflections.
#[inline(always)]
fn airy<L: Lanes>(
    l: L,
    top: F<L>,
    bottom: Spectrum<L>,
    phase: Complex<L>,
    sensitivities: &[Complex<L>; ORDERS],
    at_wavelengths: bool,
) -> Spectrum<L> {
    let white = Spectrum::one(l);
    let passed = 1.0 - top;
    let both = bottom * top;
    let inner = bottom * (passed * passed) / (white - both).max(1e-6);
    let step = both.safe_sqrt();
    let mut sum = inner + Spectrum::constant(top);
    let mut factor = inner - Spectrum::constant(passed);
    if at_wavelengths {
        // All orders: the sum of ρᵐ cos mθ is (ρ cos θ − ρ²) / (1 − 2 ρ cos θ + ρ²).
        let [cos, sin] = sensitivities[0];
        let turned = (phase[0] * cos + phase[1] * sin) * step;
        return sum + factor * (turned - both) / (white - turned * 2.0 + both).max(1e-6) * 2.0;
    }
    let mut turn = phase;
    for s in sensitivities {
        factor = factor * step;
        sum += factor * (turn[0] * s[0] + turn[1] * s[1]) * 2.0;
        turn = [turn[0] * phase[0] - turn[1] * phase[1], turn[0] * phase[1] + turn[1] * phase[0]];
    }
    sum
}

#[inline(always)]
fn unit<L: Lanes>([re, im]: [F<L>; 2]) -> [F<L>; 2] {
    let length = re.mul_add(re, im * im).sqrt();
    let usable = length.gt(0.0);
    let inverse = length.max(1e-20).recip();
    [usable.select(re * inverse, re.lanes().f(1.0)), im * inverse]
}

/// Reflection in a medium of index `near` at a conductor (Born, Wolf, Principles of Optics, 14.4.1): for s and for p the reflectance and the
/// phase's cosine and sine.
#[inline(always)]
fn conductor<L: Lanes>(c: F<L>, near: F<L>, n: F<L>, k: F<L>) -> [F<L>; 6] {
    let (n2, k2, near2, nk2) = (n * n, k * k, near * near, n * k * 2.0);
    let difference = n2 - k2 - near2 * (1.0 - c * c);
    let length = difference.mul_add(difference, nk2 * nk2).sqrt();
    let (u2, v2) = (((length + difference) * 0.5).max(0.0), ((length - difference) * 0.5).max(0.0));
    let (u, v, a) = (u2.sqrt(), v2.sqrt(), near * c);
    let s = ((a - u).squared() + v2) / ((a + u).squared() + v2).max(1e-12);
    let (x, y) = ((n2 - k2) * c, nk2 * c);
    let (nu, nv) = (near * u, near * v);
    let p = ((x - nu).squared() + (y - nv).squared()) / ((x + nu).squared() + (y + nv).squared()).max(1e-12);
    let phase_s = [a * a - u2 - v2, a * v * -2.0];
    let phase_p = [((n2 + k2) * c).squared() - near2 * (u2 + v2), a * 2.0 * (nk2 * u - (n2 - k2) * v)];
    let ([cos_s, sin_s], [cos_p, sin_p]) = (unit(phase_s), unit(phase_p));
    [s, cos_s, sin_s, p, cos_p, sin_p]
}

impl<L: Lanes> Film<L> {
    /// A film of this index and thickness in nanometres. From inside a body of index `near` its index counts relative to the body. Waves are as long as
    /// they are in the film where light has wavelengths; else they are as long as in the body, as in Cycles.
    #[inline(always)]
    pub(crate) fn new([weight, ior, thickness]: [F<L>; 3], near: F<L>, wavelengths: Wavelengths<'_, L>) -> Self {
        // Films of a few atoms have no wave optics: they go over into nothing.
        let t = thickness.saturate();
        let ior = ior.lanes().f(1.0).lerp(ior.max(1e-5) / near, t * t * (3.0 - t * 2.0));
        Self { weight: weight.saturate().keep_if(thickness.gt(THINNEST)), ior, near, thickness, nanometres: wavelengths.nanometres() }
    }
    /// Sensitivities of all passages for the film's inner cosine.
    #[inline(always)]
    fn passages(&self, l: L, cos: F<L>) -> [Complex<L>; ORDERS] {
        let difference = self.ior * self.thickness * cos * 2.0;
        if let Some(nanometres) = self.nanometres {
            return [turned(difference * self.near, nanometres); ORDERS];
        }
        let mut passages = [[Spectrum::zero(l); 2]; ORDERS];
        for (order, passage) in passages.iter_mut().enumerate() {
            #[allow(clippy::cast_precision_loss, reason = "three passages")]
            let count = (order + 1) as f32;
            *passage = sensitivity(l, difference * count);
        }
        passages
    }
    /// Reflectance of the film over a dielectric of index `eta`, at cosine `c` outside.
    #[inline(always)]
    fn over_dielectric(&self, c: F<L>, eta: F<L>) -> Spectrum<L> {
        let l = c.lanes();
        let upper = polarised(c, self.ior);
        let lower = polarised(upper.cos, eta / self.ior);
        let passages = self.passages(l, upper.cos);
        let mut sum = Spectrum::zero(l);
        for side in 0..2 {
            let phase = [Spectrum::constant(-(upper.sign[side] * lower.sign[side])), Spectrum::zero(l)];
            sum +=
                airy(l, upper.reflectance[side], Spectrum::constant(lower.reflectance[side]), phase, &passages, self.nanometres.is_some());
        }
        (upper.total | lower.total).select(Spectrum::one(l), (sum * 0.5).saturate())
    }
    /// Reflectance of the film over a conductor; with `at_82`, the reflectance at 82 degrees in vacuum, the lower interface's curve is F82.
    #[inline(always)]
    fn conductor_sum(&self, c: F<L>, n: Spectrum<L>, k: Spectrum<L>, at_82: Option<Spectrum<L>>) -> Spectrum<L> {
        let l = c.lanes();
        let upper = polarised(c, self.ior);
        let [mut s, cos_s, sin_s, mut p, cos_p, sin_p] = n.zip(
            k,
            #[inline(always)]
            |n, k| conductor(upper.cos, self.ior, n, k),
        );
        if let Some(at_82) = at_82 {
            s = f82_inside(upper.cos, self.ior, n, k, at_82);
            p = s;
        }
        let passages = self.passages(l, upper.cos);
        let mut sum = Spectrum::zero(l);
        for (side, (bottom, cos, sin)) in [(s, cos_s, sin_s), (p, cos_p, sin_p)].into_iter().enumerate() {
            let turn = -upper.sign[side];
            sum += airy(l, upper.reflectance[side], bottom, [cos * turn, sin * turn], &passages, self.nanometres.is_some());
        }
        upper.total.select(Spectrum::one(l), (sum * 0.5).saturate())
    }
    /// Reflectance of the film over a dielectric whose curve is moved to normal reflectance `f0` and grazing reflectance `f90`.
    #[inline(always)]
    pub(crate) fn over_tinted(&self, c: F<L>, eta: F<L>, f0: Spectrum<L>, f90: Spectrum<L>) -> Spectrum<L> {
        self.tinted(dielectric_film(c.lanes(), self, c, eta), eta, f0, f90)
    }
    /// Reflectances over two such curves that differ in their ends alone.
    #[inline(always)]
    pub(crate) fn over_two(&self, c: F<L>, eta: F<L>, [first, second]: [[Spectrum<L>; 2]; 2]) -> [Spectrum<L>; 2] {
        let plain = dielectric_film(c.lanes(), self, c, eta);
        [self.tinted(plain, eta, first[0], first[1]), self.tinted(plain, eta, second[0], second[1])]
    }
    /// The reflectance `plain` over a dielectric with the ends moved; at most 1, whatever the tint.
    #[inline(always)]
    fn tinted(&self, plain: Spectrum<L>, eta: F<L>, f0: Spectrum<L>, f90: Spectrum<L>) -> Spectrum<L> {
        let normal = normal_reflectance(eta);
        let toward = (Spectrum::one(eta.lanes()) - plain) * (1.0 - normal).recip();
        let factor = f0 * normal.max(1e-5).recip();
        let tint = f90 + (factor - f90) * toward.saturate();
        (plain * normal.gt(1e-5).select(tint, f90)).saturate()
    }
    /// Reflectance of the film over a conductor.
    #[inline(always)]
    pub(crate) fn over_conductor(&self, c: F<L>, n: Spectrum<L>, k: Spectrum<L>) -> Spectrum<L> {
        conductor_film(c.lanes(), self, c, n, k, None)
    }
    /// Reflectance of the film over a metal with the F82 curve of normal value `f0` and coefficient `drop`.
    #[inline(always)]
    pub(crate) fn over_f82(&self, c: F<L>, f0: Spectrum<L>, drop: Spectrum<L>) -> Spectrum<L> {
        let at_82 = f82_coefficients(f0, drop);
        let [n, k] = f0.min(0.999).zip(
            at_82,
            #[inline(always)]
            |f0, at_82| gulbrandsen_channel(f0, at_82),
        );
        conductor_film(c.lanes(), self, c, n, k, Some(at_82))
    }
}

/// Normal reflectance of a conductor.
#[inline(always)]
fn conductor_normal<L: Lanes>(n: F<L>, k: F<L>) -> F<L> {
    let k2 = k * k;
    ((n - 1.0).squared() + k2) / ((n + 1.0).squared() + k2)
}

/// The F82 curve inside a film of index `ior`: normal value by index and extinction relative to the film, the value at 82 degrees as in vacuum.
#[inline(always)]
fn f82_inside<L: Lanes>(c: F<L>, ior: F<L>, n: Spectrum<L>, k: Spectrum<L>, at_82: Spectrum<L>) -> Spectrum<L> {
    let [f0] = n.zip(
        k,
        #[inline(always)]
        |n, k| [conductor_normal(n / ior, k / ior)],
    );
    let [value] = f0.zip(
        at_82,
        #[inline(always)]
        |f0, at_82| [f82_channel(c, f0, at_82)],
    );
    value
}

/// [`Film::over_dielectric`] as a function of its own: inlined at each use it would outgrow all other lobes together.
#[inline(never)]
fn dielectric_film<L: Lanes>(l: L, film: &Film<L>, c: F<L>, eta: F<L>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || film.over_dielectric(c, eta),
    )
}

/// [`Film::conductor_sum`] as a function of its own.
#[inline(never)]
fn conductor_film<L: Lanes>(l: L, film: &Film<L>, c: F<L>, n: Spectrum<L>, k: Spectrum<L>, at_82: Option<Spectrum<L>>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || film.conductor_sum(c, n, k, at_82),
    )
}
