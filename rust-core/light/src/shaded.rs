//! Lights whose emission a shading program knows: triangles of meshes that glow by an image or a pattern.
//!
//! Their rows have the mean radiance, by which lights are chosen and which samples carry. Whoever uses a sample multiplies it by what the program
//! finds at the sampled point, over that mean.

use super::row::{Reader, field, flag};
use super::table::LightTable;
use gonio_simd::{F, Lanes, M, U, Vec3};

/// Where a ray meets a triangle's plane.
#[derive(Clone, Copy, Debug)]
pub struct TrianglePoint<L: Lanes> {
    /// Barycentric coordinates of corners 1 and 2, within the triangle.
    pub barycentric: [F<L>; 2],
    /// Way along the ray, in units of its direction.
    pub distance: F<L>,
    /// The mean radiance of the light, grey.
    pub mean: F<L>,
}

impl LightTable {
    /// Whether there are such lights.
    pub fn any_shaded(&self) -> bool {
        self.any_shaded
    }

    /// Which lanes' lights are such.
    #[inline(always)]
    pub fn is_shaded<L: Lanes>(&self, l: L, light: U<L>) -> M<L> {
        if self.any_shaded { self.reader(l, light).flag(flag::SHADED) } else { l.m(false) }
    }

    /// Where rays that were sent to triangles meet them.
    #[inline(always)]
    pub fn triangle_point<L: Lanes>(&self, l: L, light: U<L>, origin: Vec3<L>, direction: Vec3<L>) -> TrianglePoint<L> {
        let light: Reader<'_, L> = self.reader(l, light);
        let from = light.in_frame(origin - light.vector(field::ORIGIN));
        let step = light.in_frame(direction);
        let distance = -from.z / step.z;
        let (u, v) = (within(step.x.mul_add(distance, from.x)), within(step.y.mul_add(distance, from.y)));
        let over = (u + v).max(1.0).recip();
        TrianglePoint { barycentric: [u * over, v * over], distance: distance.max(0.0), mean: light.value(field::RADIANCE) }
    }
}

/// Rounding may lead past an edge, or away where the triangle is seen edge-on.
#[inline(always)]
fn within<L: Lanes>(x: F<L>) -> F<L> {
    x.is_finite().select(x, x.lanes().f(0.0)).clamp(0.0, 1.0)
}
