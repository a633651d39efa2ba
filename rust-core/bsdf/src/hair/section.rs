//! The elliptic section of a fibre, in coordinates of which x is along the fibre, y along the longer half axis, which is 1, and z along the shorter.

use gonio_simd::{F, Lanes, M, Vec3};

/// A place on the section's edge, on the circle that it becomes when the shorter axis is stretched to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<L: Lanes> {
    y: F<L>,
    z: F<L>,
}

/// The shorter half axis, above 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section<L: Lanes> {
    pub(super) minor: F<L>,
}

impl<L: Lanes> Section<L> {
    /// Half of the width that is seen from an azimuth, in the fibre's outline.
    #[inline(always)]
    pub(super) fn half_width(&self, [y, z]: [F<L>; 2]) -> F<L> {
        let flat = self.minor * y;
        z.mul_add(z, flat * flat).sqrt()
    }
    /// Where what is seen from an azimuth lies, `across` from the middle to the left of who looks with the fibre upright; and whether it is there.
    #[inline(always)]
    pub(super) fn seen(&self, [y, z]: [F<L>; 2], across: F<L>) -> (Place<L>, M<L>) {
        let (from, towards) = ([-(z * across), y * across / self.minor], [y, z / self.minor]);
        let a = towards[0].mul_add(towards[0], towards[1] * towards[1]);
        let b = from[0].mul_add(towards[0], from[1] * towards[1]);
        let c = from[0].mul_add(from[0], from[1] * from[1]) - 1.0;
        let squared = b * b - a * c;
        let way = (squared.safe_sqrt() - b) / a;
        (Place { y: way.mul_add(towards[0], from[0]), z: way.mul_add(towards[1], from[1]) }, squared.gt(0.0))
    }
    /// The outward normal at a place.
    #[inline(always)]
    pub(super) fn normal(&self, at: Place<L>) -> [F<L>; 2] {
        let (y, z) = (at.y, at.z / self.minor);
        let scale = y.mul_add(y, z * z).max(1e-20).inverse_root();
        [y * scale, z * scale]
    }
    /// Where light that goes in a direction from a place meets the other side, and its way there.
    #[inline(always)]
    pub(super) fn crossed(&self, at: Place<L>, direction: Vec3<L>) -> (Place<L>, F<L>) {
        let (y, z) = (direction.y, direction.z / self.minor);
        let way = at.y.mul_add(y, at.z * z) * -2.0 / y.mul_add(y, z * z).max(1e-12);
        (Place { y: way.mul_add(y, at.y), z: way.mul_add(z, at.z) }, way.max(0.0))
    }
}
