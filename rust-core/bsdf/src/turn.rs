//! Frames whose tangent is rotated about the normal.

use gonio_simd::{F, Lanes, Vec3};

/// A direction in a frame whose tangent is turned by an angle of this cosine and sine.
#[inline(always)]
pub(crate) fn turned<L: Lanes>(v: Vec3<L>, turn: Option<[F<L>; 2]>) -> Vec3<L> {
    match turn {
        Some([cos, sin]) => Vec3::new(cos.mul_add(v.x, sin * v.y), cos.mul_add(v.y, -(sin * v.x)), v.z),
        None => v,
    }
}
