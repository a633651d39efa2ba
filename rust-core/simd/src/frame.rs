//! Shading frames, one per lane.

use crate::{Lanes, Select, Vec3};

/// An orthonormal frame: x tangent, y bitangent, z normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame<L: Lanes> {
    /// Tangent.
    pub x: Vec3<L>,
    /// Bitangent.
    pub y: Vec3<L>,
    /// Normal.
    pub z: Vec3<L>,
}

impl<L: Lanes> Frame<L> {
    /// Any frame about a unit normal, without branches (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017).
    #[inline(always)]
    pub fn from_normal(n: Vec3<L>) -> Self {
        let l = n.x.lanes();
        let sign = l.f(1.0).copysign(n.z);
        let a = -(sign + n.z).recip();
        let b = n.x * n.y * a;
        Self { x: Vec3::new(sign * n.x * n.x * a + 1.0, sign * b, -sign * n.x), y: Vec3::new(b, sign + n.y * n.y * a, -n.y), z: n }
    }
    /// The frame about unit normal `n` whose x axis is `tangent` projected to the plane; any frame where the tangent is parallel to `n`
    /// within 3·10⁻⁴, zero or not finite. The tangent's length does not matter.
    #[inline(always)]
    pub fn from_tangent(n: Vec3<L>, tangent: Vec3<L>) -> Self {
        let any = Self::from_normal(n);
        let flat = tangent - n * n.dot(tangent);
        let squared = flat.length_squared();
        let usable = squared.gt(tangent.length_squared() * 1e-7) & squared.is_finite();
        let unit = flat * squared.inverse_root();
        // Projected again, for a short remainder is mostly rounding error.
        let x = usable.select(unit - n * n.dot(unit), any.x);
        Self { x, y: n.cross(x), z: n }
    }
    /// A world vector in the frame's coordinates.
    #[inline(always)]
    pub fn to_local(self, v: Vec3<L>) -> Vec3<L> {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }
    /// A local vector in world coordinates.
    #[inline(always)]
    pub fn to_world(self, v: Vec3<L>) -> Vec3<L> {
        v.transform([self.x, self.y, self.z])
    }
}

impl<L: Lanes> Select<L> for Frame<L> {
    #[inline(always)]
    fn select(mask: crate::M<L>, a: Self, b: Self) -> Self {
        Self { x: mask.select(a.x, b.x), y: mask.select(a.y, b.y), z: mask.select(a.z, b.z) }
    }
}
