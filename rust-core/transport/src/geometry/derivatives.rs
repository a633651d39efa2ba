//! Derivatives at hits: how positions, texture coordinates and primvars change over the triangle, for ray footprints and tangents, on lanes.

use super::{GeometryTable, HitLanes};
use gonio_simd::{F, Lanes, Vec3};

/// How texture coordinates lie on a triangle.
#[derive(Clone, Copy, Debug)]
pub struct UvDerivatives<L: Lanes> {
    /// Along the derivative of the position by u, not unit; zero where there is none.
    pub tangent: Vec3<L>,
    /// Twice the triangle's area in texture coordinates, negative where they are mirrored; zero where there are none.
    pub determinant: F<L>,
}

impl GeometryTable {
    /// Images of x, y and z of the instances' spaces in the world, and their origins, rebased, at the hits' times.
    #[inline(always)]
    pub fn instance_columns<L: Lanes>(&self, l: L, hit: &HitLanes<L>) -> ([Vec3<L>; 3], Vec3<L>) {
        if !self.motion.is_empty() {
            return self.moved_columns(l, hit);
        }
        let (table, at) = (&self.instance_transform, hit.instance * 12);
        ([Vec3::gather(l, table, at), Vec3::gather(l, table, at + 3), Vec3::gather(l, table, at + 6)], Vec3::gather(l, table, at + 9))
    }

    /// A corner of the triangles, object space.
    #[inline(always)]
    pub(super) fn point<L: Lanes>(&self, l: L, hit: &HitLanes<L>, corner: usize) -> Vec3<L> {
        let still = Vec3::gather(l, &self.points, hit.points[corner] * 3);
        if self.mesh_keys.is_empty() { still } else { self.moved_point(l, hit, corner, still) }
    }

    /// Edges of the triangles from corner 0 to 1 and 2, world space.
    #[inline(always)]
    pub fn edges<L: Lanes>(&self, l: L, hit: &HitLanes<L>) -> [Vec3<L>; 2] {
        let (columns, _) = self.instance_columns(l, hit);
        let first = self.point(l, hit, 0);
        [(self.point(l, hit, 1) - first).transform(columns), (self.point(l, hit, 2) - first).transform(columns)]
    }

    /// How the texture coordinates in a primvar column lie on triangles with these edges.
    #[inline(always)]
    pub fn uv_derivatives<L: Lanes>(&self, l: L, hit: &HitLanes<L>, column: usize, edges: [Vec3<L>; 2]) -> UvDerivatives<L> {
        let [a, b, c] = self.corner_uvs(l, hit, column);
        let (du1, dv1, du2, dv2) = (b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
        let determinant = du1 * dv2 - du2 * dv1;
        let usable = determinant.abs().gt(1e-20);
        let sign = l.f(1.0).copysign(determinant);
        // The length does not matter, only the direction.
        let tangent = (edges[0] * dv2 - edges[1] * dv1) * sign;
        UvDerivatives { tangent: usable.select(tangent, Vec3::splat(l, [0.0; 3])), determinant: determinant.keep_if(usable) }
    }

    /// How much a primvar changes where the barycentric coordinates of corners 1 and 2 change by `change`; missing values and components
    /// do not change.
    #[inline(always)]
    pub fn primvar_change<L: Lanes>(&self, l: L, hit: &HitLanes<L>, column: usize, change: [F<L>; 2]) -> [F<L>; 4] {
        let [first, second, third] = self.corner_values(l, hit, column);
        let mut out = first;
        for (i, component) in out.iter_mut().enumerate() {
            *component = (second[i] - first[i]).mul_add(change[0], (third[i] - first[i]) * change[1]);
        }
        out
    }
}
