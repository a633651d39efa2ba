//! Triangles, sampled by area.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use gonio_simd::{F, Lanes, Vec3};

/// Triangles of emitting meshes.
pub(crate) struct Triangle;

/// Density per solid angle of points uniform over the triangle, towards the vector `v` from a point to the triangle.
#[inline(always)]
fn by_area<L: Lanes>(light: &Reader<'_, L>, v: Vec3<L>) -> F<L> {
    let [x, y, _] = light.frame();
    let squared = v.length_squared();
    squared * squared.sqrt() * 2.0 / x.cross(y).dot(v).abs()
}

impl Emitter for Triangle {
    #[inline(always)]
    fn sample<L: Lanes>(_: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let [x, y, _] = light.frame();
        // Heitz, A Low-Distortion Map Between Triangle and Square, 2019.
        let upper = u[0].lt(u[1]);
        let (small, large) = (u[0].min(u[1]) * 0.5, u[0].max(u[1]));
        let (a, b) = (upper.select(small, large - small), upper.select(large - small, small));
        let v = light.vector(field::ORIGIN) - p + x * a + y * b;
        let aim = Aim::towards(v);
        Aim { pdf: by_area(light, v), ..aim }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, hit: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let distance = (hit - from).length();
        (by_area(light, wi * distance), [l.f(0.0); 2])
    }
}
