//! The phase functions of a scene, a row each, on lanes: exact values, and directions by an inverse table of each.
//!
//! Closed inversions of Draine's function lose all digits in single precision near g = 0 (Jendersie and d'Eon's, for α of 250), and Fournier and
//! Forand's has none. So the inverse of each distribution stands at [`BINS`] + 1 places, linear between; a factor near 1 makes up for what that
//! leaves out.

use super::kind::{Phase, ROW};
use super::turned;
use core::f32::consts::{LN_2, PI, TAU};
use gonio_simd::{F, Lanes, M, One, U, Vec3};

/// Bins of equal probability.
const BINS: usize = 1024;
const KNOTS: usize = BINS + 1;
/// Steps of the integrals that the inverse tables are made of.
const STEPS: usize = 8192;
/// Directions nearer to straight on are as far from it as this: 1 − cosine.
const LEAST: f32 = 1e-12;
/// The least of what is drawn: the logarithm stays finite.
const LEAST_DRAWN: f32 = 1e-7;
/// How far from 1 Fournier and Forand's δ is where the quotient loses no digits.
const NEAR: f32 = 0.25;
/// Terms of the series nearer to 1.
const TERMS: u32 = 12;

/// All of a scene.
#[derive(Clone, Debug, Default)]
pub struct PhaseTable {
    phases: Vec<Phase>,
    numbers: Vec<f32>,
    /// Powers of 1 − cosine at equal steps of probability, from straight on to straight back.
    knots: Vec<f32>,
    varied: bool,
}

impl PhaseTable {
    /// The row of a phase function; those that are alike share one.
    pub fn add(&mut self, phase: Phase) -> u32 {
        let known = self.phases.iter().position(|row| *row == phase);
        let row = known.unwrap_or_else(|| {
            self.phases.push(phase);
            self.phases.len() - 1
        });
        self.varied |= phase.henyey_greenstein().is_none();
        // Henyey and Greenstein's alone needs no table.
        while self.varied && self.numbers.len() < self.phases.len() * ROW {
            let numbers = self.phases[self.numbers.len() / ROW].numbers();
            self.numbers.extend(numbers);
            self.knots.extend(knots(&numbers));
        }
        row as u32
    }

    /// Whether there are others than Henyey and Greenstein's; only then may they be evaluated and drawn.
    pub fn is_varied(&self) -> bool {
        self.varied
    }

    /// The values of some rows, which are their densities per solid angle too, for light that went along a direction and goes along another.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, l: L, row: U<L>, from: Vec3<L>, to: Vec3<L>) -> F<L> {
        // The cosine of directions that hardly differ has no digits of their angle; their difference has.
        let t = ((to - from).length_squared() * 0.5).clamp(LEAST, 2.0);
        Numbers::load(l, &self.numbers, row).times_t(t, t.ln()) / t
    }

    /// Draws directions for light that goes along others. Gives a factor near 1 beside each: value over the density that it was drawn with.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, row: U<L>, along: Vec3<L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>) {
        let numbers = Numbers::load(l, &self.numbers, row);
        let place = u[0] * BINS as f32;
        let bin = place.floor().clamp(0.0, (BINS - 1) as f32);
        let [low, high] = l.gather_pairs(&self.knots, row * KNOTS as u32 + bin.to_i32());
        let y = low.lerp(high, place - bin).max(LEAST_DRAWN);
        let ln_t = (y.ln() * numbers.exponent).min(LN_2);
        let t = ln_t.exp().min(2.0);
        let factor = numbers.times_t(t, ln_t) * (high - low) * numbers.exponent / y * (BINS as f32 * TAU);
        (turned(along, 1.0 - t, (t * (2.0 - t)).safe_sqrt(), u[1]), factor)
    }
}

/// What is read of some rows.
#[derive(Clone, Copy, Debug)]
struct Numbers<L: Lanes> {
    /// g of Henyey and Greenstein and the factor before its kernel, g of Draine and the factor; or ν, the logarithm of δ over 1 − cosine, one minus δ
    /// straight back, and the factor of the last term.
    four: [F<L>; 4],
    alpha: F<L>,
    /// One over the power of 1 − cosine that is drawn.
    exponent: F<L>,
    is_fournier_forand: M<L>,
}

impl<L: Lanes> Numbers<L> {
    #[inline(always)]
    fn load(l: L, numbers: &[f32], row: U<L>) -> Self {
        let four = l.gather_quads(numbers, row * ROW as u32);
        let [alpha, exponent, kind, _] = l.gather_quads(numbers, row * ROW as u32 + 4);
        Self { four, alpha, exponent, is_fournier_forand: kind.gt(0.5) }
    }

    /// The value times t = 1 − cosine, which is finite straight on, by that and its logarithm.
    #[inline(always)]
    fn times_t(&self, t: F<L>, ln_t: F<L>) -> F<L> {
        let found = self.blend(t) * t;
        if self.is_fournier_forand.any() { self.is_fournier_forand.select(self.fournier_forand(t, ln_t), found) } else { found }
    }

    /// Henyey and Greenstein's function and Draine's.
    #[inline(always)]
    fn blend(&self, t: F<L>) -> F<L> {
        let [g_hg, of_hg, g_draine, of_draine] = self.four;
        let cos = 1.0 - t;
        let draine = of_draine * (self.alpha * cos).mul_add(cos, 1.0);
        kernel(g_hg, t).mul_add(of_hg, kernel(g_draine, t) * draine)
    }

    /// Fournier and Forand's function times t. With e = 1 − δ and Q = (ν e − 1 + δ^ν) / e² it is, of the paper's terms in another order,
    /// ((1 − δ180) Q − ν δ180 / δ) / (4 π δ^ν) + a (3 cos² − 1), where only Q wants care about δ = 1; and δ180 t / δ = 2.
    #[inline(always)]
    fn fournier_forand(&self, t: F<L>, ln_t: F<L>) -> F<L> {
        let [nu, ln_delta_of_t, rest, last] = self.four;
        let ln_delta = ln_t + ln_delta_of_t;
        let delta = ln_delta.exp();
        let e = 1.0 - delta;
        // Far below what is told from 0 beside the other terms, it would overflow.
        let power = (nu * ln_delta).min(80.0).exp();
        let quotient = (nu.mul_add(e, power) - 1.0) / (e * e).max(NEAR * NEAR);
        let mut series = t.lanes().f(1.0);
        for term in (2..TERMS).rev() {
            series = (series * e * (term as f32 - nu)).mul_add(1.0 / (term + 1) as f32, 1.0);
        }
        let q = e.abs().lt(NEAR).select(nu * (nu - 1.0) * 0.5 * series, quotient);
        let cos = 1.0 - t;
        let main = (rest * q * t - nu * 2.0) * (-(nu * ln_delta)).exp() * (0.25 / PI);
        (last * t).mul_add((cos * 3.0).mul_add(cos, -1.0), main)
    }
}

/// (1 + g² − 2 g cos)^(−3/2), by 1 − cos.
#[inline(always)]
fn kernel<L: Lanes>(g: F<L>, t: F<L>) -> F<L> {
    let (ahead, least) = (1.0 - g, 1.0 - g.abs());
    let base = (g * 2.0).mul_add(t, ahead * ahead).max(least * least);
    (base * base.sqrt()).recip()
}

/// The inverse of a distribution: powers of 1 − cosine between which [`BINS`] parts of equal probability lie.
fn knots(numbers: &[f32; ROW]) -> Vec<f32> {
    let all = Numbers::load(One, numbers, One.u(0));
    let exponent = f64::from(numbers[5]);
    let most = 2.0_f64.powf(exponent.recip());
    let width = most / STEPS as f64;
    let mut sums = vec![0.0; STEPS + 1];
    for step in 0..STEPS {
        let y = (step as f64 + 0.5) * width;
        let ln_t = y.ln() * exponent;
        let found = all.times_t(One.f(ln_t.exp() as f32), One.f(ln_t as f32)).to_array()[0];
        sums[step + 1] = sums[step] + f64::from(found) / y;
    }
    let mut step = 0;
    let inner = (1..BINS).map(|bin| {
        let wanted = sums[STEPS] * bin as f64 / BINS as f64;
        while sums[step + 1] < wanted {
            step += 1;
        }
        (step as f64 + (wanted - sums[step]) / (sums[step + 1] - sums[step])) * width
    });
    [0.0].into_iter().chain(inner).chain([most]).map(|x| x as f32).collect()
}
