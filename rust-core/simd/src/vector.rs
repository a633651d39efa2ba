//! Directions and points in structure-of-arrays form, one per lane.

use crate::{F, Lanes, M, Select, ToF};
use core::ops::{Add, Mul, Neg, Sub};

/// A two-dimensional vector in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Vec2<L: Lanes> {
    /// First coordinate.
    pub x: F<L>,
    /// Second coordinate.
    pub y: F<L>,
}

/// A three-dimensional vector in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Vec3<L: Lanes> {
    /// First coordinate.
    pub x: F<L>,
    /// Second coordinate.
    pub y: F<L>,
    /// Third coordinate.
    pub z: F<L>,
}

impl<L: Lanes> From<[F<L>; 3]> for Vec3<L> {
    #[inline(always)]
    fn from([x, y, z]: [F<L>; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<L: Lanes> From<Vec3<L>> for [F<L>; 3] {
    #[inline(always)]
    fn from(v: Vec3<L>) -> Self {
        [v.x, v.y, v.z]
    }
}

impl<L: Lanes> Vec3<L> {
    /// From its coordinates.
    #[inline(always)]
    pub fn new(x: F<L>, y: F<L>, z: F<L>) -> Self {
        Self { x, y, z }
    }
    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(l: L, v: [f32; 3]) -> Self {
        Self::new(l.f(v[0]), l.f(v[1]), l.f(v[2]))
    }
    /// From three columns at a place.
    #[inline(always)]
    pub fn load(l: L, columns: [&[f32]; 3], at: usize) -> Self {
        Self::new(l.load(columns[0], at), l.load(columns[1], at), l.load(columns[2], at))
    }
    /// To three columns at a place.
    #[inline(always)]
    pub fn store(self, columns: [&mut [f32]; 3], at: usize) {
        let [x, y, z] = columns;
        self.x.store(x, at);
        self.y.store(y, at);
        self.z.store(z, at);
    }
    /// Three consecutive values of a table from `index` on; the table has one more behind the last three.
    #[inline(always)]
    pub fn gather(l: L, table: &[f32], index: crate::U<L>) -> Self {
        let [x, y, z, _] = l.gather_quads(table, index);
        Self::new(x, y, z)
    }
    /// Inner product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> F<L> {
        self.x.mul_add(o.x, self.y.mul_add(o.y, self.z * o.z))
    }
    /// Cross product.
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self::new(self.y.mul_add(o.z, -(self.z * o.y)), self.z.mul_add(o.x, -(self.x * o.z)), self.x.mul_add(o.y, -(self.y * o.x)))
    }
    /// Squared length.
    #[inline(always)]
    pub fn length_squared(self) -> F<L> {
        self.dot(self)
    }
    /// Length.
    #[inline(always)]
    pub fn length(self) -> F<L> {
        self.dot(self).sqrt()
    }
    /// Unit vector; NaN for the zero vector.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        self * self.length_squared().inverse_root()
    }
    /// Unit vector, or `fallback` where the length is zero or not finite.
    #[inline(always)]
    pub fn normalize_or(self, fallback: Self) -> Self {
        let squared = self.length_squared();
        let usable = squared.gt(0.0) & squared.is_finite();
        usable.select(self * squared.inverse_root(), fallback)
    }
    /// `self * s + o`.
    #[inline(always)]
    pub fn mul_add(self, s: F<L>, o: Self) -> Self {
        Self::new(self.x.mul_add(s, o.x), self.y.mul_add(s, o.y), self.z.mul_add(s, o.z))
    }
    /// Mirror direction of `self` (pointing away from the surface) about `n`.
    #[inline(always)]
    pub fn reflect(self, n: Self) -> Self {
        n * (self.dot(n) * 2.0) - self
    }
    /// The largest of the three magnitudes.
    #[inline(always)]
    pub fn max_abs(self) -> F<L> {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }
    /// A linear map given by its columns applied to the vector.
    #[inline(always)]
    pub fn transform(self, columns: [Self; 3]) -> Self {
        columns[0].mul_add(self.x, columns[1].mul_add(self.y, columns[2] * self.z))
    }
}

impl<L: Lanes> Select<L> for Vec2<L> {
    #[inline(always)]
    fn select(mask: M<L>, a: Self, b: Self) -> Self {
        Self { x: mask.select(a.x, b.x), y: mask.select(a.y, b.y) }
    }
}
impl<L: Lanes> Select<L> for Vec3<L> {
    #[inline(always)]
    fn select(mask: M<L>, a: Self, b: Self) -> Self {
        Self::new(mask.select(a.x, b.x), mask.select(a.y, b.y), mask.select(a.z, b.z))
    }
}
impl<L: Lanes> Add for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}
impl<L: Lanes> Sub for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}
impl<L: Lanes> Neg for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}
impl<L: Lanes, T: ToF<L>> Mul<T> for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        let s = s.to_f(self.x.lanes());
        Self::new(self.x * s, self.y * s, self.z * s)
    }
}
