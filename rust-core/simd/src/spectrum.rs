//! Light under way, one spectrum per lane: what is carried, scattered or emitted. Stored colour is [`Rgb`].
//!
//! No other file knows what a spectrum is made of: three components, which are linear Rec.709 or stand at three wavelengths. Colour becomes light, and
//! light colour, by the doors of [`Wavelengths`]. ARCHITECTURE.md lists who opens them.

mod columns;
mod upsampled;
mod wavelengths;

pub use columns::{SpectrumColumns, SpectrumItems};
pub use wavelengths::{FIRST_COLOUR_SPECTRA, WavelengthColumn, WavelengthTable, Wavelengths};

use crate::{F, Lanes, M, Rgb, Select};
use core::ops::{Add, AddAssign, Div, Mul, Sub};

/// Throughput, radiance, transmittance, a BSDF's value: one number for each component of light, in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Spectrum<L: Lanes> {
    r: F<L>,
    g: F<L>,
    b: F<L>,
}

impl<L: Lanes> Spectrum<L> {
    /// The components as colour, where they are linear Rec.709. For tests; [`Wavelengths::to_rgb`] is the door.
    #[inline(always)]
    pub fn to_rgb(self) -> Rgb<L> {
        Rgb::new(self.r, self.g, self.b)
    }
    /// The same at all wavelengths.
    #[inline(always)]
    pub fn constant(x: F<L>) -> Self {
        Self { r: x, g: x, b: x }
    }
    /// No light.
    #[inline(always)]
    pub fn zero(l: L) -> Self {
        Self::constant(l.f(0.0))
    }
    /// All light.
    #[inline(always)]
    pub fn one(l: L) -> Self {
        Self::constant(l.f(1.0))
    }
    /// The value of what [`Self::constant`] made.
    #[inline(always)]
    pub fn constant_value(self) -> F<L> {
        self.r
    }
    /// The lanes' token.
    #[inline(always)]
    pub fn lanes(self) -> L {
        self.r.lanes()
    }

    /// A function of each component. `f` is a closure that asks to be inlined; a function's name alone would stay a call.
    #[inline(always)]
    pub fn map(self, f: impl Fn(F<L>) -> F<L>) -> Self {
        Self { r: f(self.r), g: f(self.g), b: f(self.b) }
    }
    /// Functions of each pair of components, by a closure as for [`Self::map`].
    #[inline(always)]
    pub fn zip<const N: usize>(self, o: Self, f: impl Fn(F<L>, F<L>) -> [F<L>; N]) -> [Self; N] {
        let (r, g, b) = (f(self.r, o.r), f(self.g, o.g), f(self.b, o.b));
        let mut all = [self; N];
        for (i, one) in all.iter_mut().enumerate() {
            *one = Self { r: r[i], g: g[i], b: b[i] };
        }
        all
    }

    /// By component, that component of what a function makes of it and of another's: for what is computed of all components at once. `f` as for
    /// [`Self::map`].
    #[inline(always)]
    pub fn own<const N: usize>(self, o: Self, f: impl Fn(F<L>, F<L>) -> [Self; N]) -> [Self; N] {
        let (r, g, b) = (f(self.r, o.r), f(self.g, o.g), f(self.b, o.b));
        let mut all = [self; N];
        for (i, one) in all.iter_mut().enumerate() {
            *one = Self { r: r[i].r, g: g[i].g, b: b[i].b };
        }
        all
    }

    /// Luminance Y by the weights of Rec.709.
    #[inline(always)]
    pub fn luminance(self) -> F<L> {
        self.r.mul_add(0.2126, self.g.mul_add(0.7152, self.b * 0.0722))
    }
    /// Sum of the components.
    #[inline(always)]
    pub fn sum(self) -> F<L> {
        self.r + self.g + self.b
    }
    /// Mean of the components.
    #[inline(always)]
    pub fn mean(self) -> F<L> {
        self.sum() * (1.0 / 3.0)
    }
    /// Sum of the products of the components.
    #[inline(always)]
    pub fn dot(self, o: Self) -> F<L> {
        self.r.mul_add(o.r, self.g.mul_add(o.g, self.b * o.b))
    }
    /// Largest component.
    #[inline(always)]
    pub fn max_component(self) -> F<L> {
        self.r.max(self.g).max(self.b)
    }
    /// Smallest component.
    #[inline(always)]
    pub fn min_component(self) -> F<L> {
        self.r.min(self.g).min(self.b)
    }
    /// The components' magnitudes.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { r: self.r.abs(), g: self.g.abs(), b: self.b.abs() }
    }
    /// Whether any component is not zero: lamps of negative strength take light away.
    #[inline(always)]
    pub fn is_lit(self) -> M<L> {
        self.abs().max_component().gt(0.0)
    }
    /// The components that do not have the sign of another spectrum's become zero: a part of that.
    #[inline(always)]
    pub fn part_of(self, whole: Self) -> Self {
        Self {
            r: whole.r.lt(0.0).select(self.r.min(0.0), self.r.max(0.0)),
            g: whole.g.lt(0.0).select(self.g.min(0.0), self.g.max(0.0)),
            b: whole.b.lt(0.0).select(self.b.min(0.0), self.b.max(0.0)),
        }
    }
    /// The components below zero become zero where they are no more than what rounding leaves of another spectrum: what is left of that.
    #[inline(always)]
    pub fn left_of(self, whole: Self) -> Self {
        Self { r: left_of(self.r, whole.r), g: left_of(self.g, whole.g), b: left_of(self.b, whole.b) }
    }

    /// The components' shares of their sum, equal ones where that is zero: probabilities to choose a component by.
    #[inline(always)]
    pub fn shares(self) -> Self {
        let total = self.sum();
        total.gt(0.0).select(self * total.max(1e-30).recip(), Self::constant(self.lanes().f(1.0 / 3.0)))
    }
    /// The component that `u` in `[0, 1)` chooses by these probabilities, of `values`.
    #[inline(always)]
    pub fn choose(self, u: F<L>, values: Self) -> F<L> {
        let (first, second) = (u.lt(self.r), u.lt(self.r + self.g));
        // Rounding may lead beyond the last component that has any probability.
        let last = self.b.gt(0.0).select(values.b, self.g.gt(0.0).select(values.g, values.r));
        first.select(values.r, second.select(values.g, last))
    }

    /// What such a choice leaves of `u`, in `[0, 1)` again.
    #[inline(always)]
    pub fn left_by_choice(self, u: F<L>) -> F<L> {
        let before = Self { r: u.lanes().f(0.0), g: self.r, b: self.r + self.g };
        ((u - self.choose(u, before)) / self.choose(u, self).max(1e-20)).clamp(0.0, 0.999_999_94)
    }

    /// `self * s + o` with a scalar factor.
    #[inline(always)]
    pub fn mul_add(self, s: F<L>, o: Self) -> Self {
        Self { r: self.r.mul_add(s, o.r), g: self.g.mul_add(s, o.g), b: self.b.mul_add(s, o.b) }
    }
    /// `self` at 0, `to` at 1.
    #[inline(always)]
    pub fn lerp(self, to: Self, t: F<L>) -> Self {
        Self { r: self.r.lerp(to.r, t), g: self.g.lerp(to.g, t), b: self.b.lerp(to.b, t) }
    }
    /// Components raised to a power.
    #[inline(always)]
    pub fn pow(self, power: F<L>) -> Self {
        Self { r: self.r.pow(power), g: self.g.pow(power), b: self.b.pow(power) }
    }
    /// e to the power of the components.
    #[inline(always)]
    pub fn exp(self) -> Self {
        Self { r: self.r.exp(), g: self.g.exp(), b: self.b.exp() }
    }
    /// Natural logarithms of the components.
    #[inline(always)]
    pub fn ln(self) -> Self {
        Self { r: self.r.ln(), g: self.g.ln(), b: self.b.ln() }
    }
    /// One over each component.
    #[inline(always)]
    pub fn recip(self) -> Self {
        Self { r: self.r.recip(), g: self.g.recip(), b: self.b.recip() }
    }
    /// Square roots of the components, 0 of negative ones.
    #[inline(always)]
    pub fn safe_sqrt(self) -> Self {
        Self { r: self.r.safe_sqrt(), g: self.g.safe_sqrt(), b: self.b.safe_sqrt() }
    }
    /// Components held in `[0, 1]`.
    #[inline(always)]
    pub fn saturate(self) -> Self {
        Self { r: self.r.saturate(), g: self.g.saturate(), b: self.b.saturate() }
    }
    /// Components held in `[low, high]`.
    #[inline(always)]
    pub fn clamp(self, low: f32, high: f32) -> Self {
        Self { r: self.r.clamp(low, high), g: self.g.clamp(low, high), b: self.b.clamp(low, high) }
    }
    /// Components raised to `low` at least.
    #[inline(always)]
    pub fn max(self, low: f32) -> Self {
        Self { r: self.r.max(low), g: self.g.max(low), b: self.b.max(low) }
    }
    /// Components lowered to `high` at most.
    #[inline(always)]
    pub fn min(self, high: f32) -> Self {
        Self { r: self.r.min(high), g: self.g.min(high), b: self.b.min(high) }
    }
    /// The light where the mask is set, none elsewhere.
    #[inline(always)]
    pub fn keep_if(self, mask: M<L>) -> Self {
        Self { r: self.r.keep_if(mask), g: self.g.keep_if(mask), b: self.b.keep_if(mask) }
    }
}

/// More than the part of a value that rounding leaves.
const ROUNDING: f32 = 1e-5;

#[inline(always)]
fn left_of<L: Lanes>(left: F<L>, whole: F<L>) -> F<L> {
    (left.lt(0.0) & left.abs().lt(whole.abs() * ROUNDING)).select(left.lanes().f(0.0), left)
}

impl<L: Lanes> Select<L> for Spectrum<L> {
    #[inline(always)]
    fn select(mask: M<L>, a: Self, b: Self) -> Self {
        Self { r: mask.select(a.r, b.r), g: mask.select(a.g, b.g), b: mask.select(a.b, b.b) }
    }
}
impl<L: Lanes> Add for Spectrum<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self { r: self.r + o.r, g: self.g + o.g, b: self.b + o.b }
    }
}
impl<L: Lanes> AddAssign for Spectrum<L> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<L: Lanes> Sub for Spectrum<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self { r: self.r - o.r, g: self.g - o.g, b: self.b - o.b }
    }
}
impl<L: Lanes> Mul for Spectrum<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self { r: self.r * o.r, g: self.g * o.g, b: self.b * o.b }
    }
}
impl<L: Lanes> Div for Spectrum<L> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        Self { r: self.r / o.r, g: self.g / o.g, b: self.b / o.b }
    }
}
impl<L: Lanes> Mul<F<L>> for Spectrum<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: F<L>) -> Self {
        Self { r: self.r * s, g: self.g * s, b: self.b * s }
    }
}
impl<L: Lanes> Mul<f32> for Spectrum<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f32) -> Self {
        Self { r: self.r * s, g: self.g * s, b: self.b * s }
    }
}
