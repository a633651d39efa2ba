//! Linear Rec.709 colours, one per lane: what is stored, as textures, parameters, film and passes. Light under way is a [`Spectrum`](crate::Spectrum).

use crate::{F, Lanes, M, One, Select, Vec3};
use core::ops::Mul;

/// A linear Rec.709 triple in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Rgb<L: Lanes> {
    /// Red.
    pub r: F<L>,
    /// Green.
    pub g: F<L>,
    /// Blue.
    pub b: F<L>,
}

impl<L: Lanes> Rgb<L> {
    /// From its components.
    #[inline(always)]
    pub fn new(r: F<L>, g: F<L>, b: F<L>) -> Self {
        Self { r, g, b }
    }
    /// The same value in all three components.
    #[inline(always)]
    pub fn grey(x: F<L>) -> Self {
        Self { r: x, g: x, b: x }
    }
    /// The same colour in every lane.
    #[inline(always)]
    pub fn splat(l: L, c: [f32; 3]) -> Self {
        Self::new(l.f(c[0]), l.f(c[1]), l.f(c[2]))
    }
    /// Black.
    #[inline(always)]
    pub fn zero(l: L) -> Self {
        Self::grey(l.f(0.0))
    }
    /// From three columns at a place.
    #[inline(always)]
    pub fn load(l: L, columns: [&[f32]; 3], at: usize) -> Self {
        Self::new(l.load(columns[0], at), l.load(columns[1], at), l.load(columns[2], at))
    }
    /// To three columns at a place.
    #[inline(always)]
    pub fn store(self, columns: [&mut [f32]; 3], at: usize) {
        let [r, g, b] = columns;
        self.r.store(r, at);
        self.g.store(g, at);
        self.b.store(b, at);
    }
    /// Three consecutive values of a table from `index` on; the table has one more behind the last three.
    #[inline(always)]
    pub fn gather(l: L, table: &[f32], index: crate::U<L>) -> Self {
        let [r, g, b, _] = l.gather_quads(table, index);
        Self::new(r, g, b)
    }
    /// Luminance Y by the weights of Rec.709.
    #[inline(always)]
    pub fn luminance(self) -> F<L> {
        self.r.mul_add(0.2126, self.g.mul_add(0.7152, self.b * 0.0722))
    }
    /// `self * s + o` with a scalar factor.
    #[inline(always)]
    pub fn mul_add(self, s: F<L>, o: Self) -> Self {
        Self::new(self.r.mul_add(s, o.r), self.g.mul_add(s, o.g), self.b.mul_add(s, o.b))
    }
    /// `self` at 0, `to` at 1.
    #[inline(always)]
    pub fn lerp(self, to: Self, t: F<L>) -> Self {
        Self::new(self.r.lerp(to.r, t), self.g.lerp(to.g, t), self.b.lerp(to.b, t))
    }
    /// Mean of the components.
    #[inline(always)]
    pub fn mean(self) -> F<L> {
        (self.r + self.g + self.b) * (1.0 / 3.0)
    }
    /// Whether any component is not zero.
    #[inline(always)]
    pub fn is_lit(self) -> M<L> {
        self.r.abs().max(self.g.abs()).max(self.b.abs()).gt(0.0)
    }
    /// Components held in `[0, 1]`.
    #[inline(always)]
    pub fn saturate(self) -> Self {
        Self::new(self.r.saturate(), self.g.saturate(), self.b.saturate())
    }
    /// Components raised to `low` at least.
    #[inline(always)]
    pub fn max(self, low: f32) -> Self {
        Self::new(self.r.max(low), self.g.max(low), self.b.max(low))
    }
    /// The colour where the mask is set, black elsewhere.
    #[inline(always)]
    pub fn keep_if(self, mask: M<L>) -> Self {
        Self::new(self.r.keep_if(mask), self.g.keep_if(mask), self.b.keep_if(mask))
    }
}

impl From<Rgb<One>> for [f32; 3] {
    fn from(c: Rgb<One>) -> Self {
        [c.r.0, c.g.0, c.b.0]
    }
}

impl<L: Lanes> From<Vec3<L>> for Rgb<L> {
    #[inline(always)]
    fn from(v: Vec3<L>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}
impl<L: Lanes> Select<L> for Rgb<L> {
    #[inline(always)]
    fn select(mask: M<L>, a: Self, b: Self) -> Self {
        Self::new(mask.select(a.r, b.r), mask.select(a.g, b.g), mask.select(a.b, b.b))
    }
}
impl<L: Lanes> Mul<F<L>> for Rgb<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: F<L>) -> Self {
        Self::new(self.r * s, self.g * s, self.b * s)
    }
}
impl<L: Lanes> Mul for Rgb<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}
impl<L: Lanes> Mul<f32> for Rgb<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f32) -> Self {
        Self::new(self.r * s, self.g * s, self.b * s)
    }
}
