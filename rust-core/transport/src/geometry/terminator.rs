//! Shadow terminators: a coarse mesh with smooth normals is lit as the curved surface that the normals tell of, but its triangles shadow
//! themselves where light grazes. Shadow rays then start from that surface.

use super::{GeometryTable, HitLanes, NORMALS};
use gonio_simd::{F, Lanes, Vec3};

impl GeometryTable {
    /// From points of triangles to the curved surface over them, world space: the quadratic one that has the corner normals, no
    /// higher than the planes at the corners (Cycles' *Geometry Offset*). `geometric` is the unit normal on the
    /// side that light comes to. Zero on flat triangles, curves and points.
    #[inline(always)]
    pub fn lift<L: Lanes>(&self, l: L, hit: &HitLanes<L>, geometric: Vec3<L>) -> Vec3<L> {
        let none = Vec3::splat(l, [0.0; 3]);
        let reference = self.reference(l, hit, NORMALS);
        let mut present = reference.present();
        if self.any_smooth() {
            present &= hit.smooth.shape.eq(0);
        }
        if !present.any() {
            return none;
        }
        let (columns, _) = self.instance_columns(l, hit);
        let p = [self.point(l, hit, 0), self.point(l, hit, 1), self.point(l, hit, 2)];
        let n = [
            self.corner_vector(l, hit, &reference, 0),
            self.corner_vector(l, hit, &reference, 1),
            self.corner_vector(l, hit, &reference, 2),
        ];
        let share = [l.f(1.0) - hit.u - hit.v, hit.u, hit.v];
        let at = p[0] * share[0] + p[1] * share[1] + p[2] * share[2];
        let normal = n[0] * share[0] + n[1] * share[1] + n[2] * share[2];
        let along = normal.transform(columns);
        let outside = along.dot(geometric).gt(0.0);
        let bulge = bulge(p, n, share);
        let height = outside.select(under_tangents(p, n, at, 1.0).max(bulge), bulge.min(-under_tangents(p, n, at, -1.0)));
        let lift = along * height.keep_if(present);
        lift.max_abs().is_finite().select(lift, none)
    }
}

/// Height of the quadratic surface over the triangle, in the corner normals' lengths: for each edge the product of both corners' shares, by how far
/// the normals turn along it.
#[inline(always)]
fn bulge<L: Lanes>(p: [Vec3<L>; 3], n: [Vec3<L>; 3], share: [F<L>; 3]) -> F<L> {
    let mut sum = share[0] * 0.0;
    for [i, j] in [[0, 1], [0, 2], [1, 2]] {
        sum = (n[j] - n[i]).dot(p[j] - p[i]).mul_add(share[i] * share[j], sum);
    }
    sum * 0.5
}

/// How far a point is under the tangent plane of a corner, each moved up to the highest of the other corners; the least of three. `side` is −1 seen
/// from the other side.
#[inline(always)]
fn under_tangents<L: Lanes>(p: [Vec3<L>; 3], n: [Vec3<L>; 3], at: Vec3<L>, side: f32) -> F<L> {
    let mut least = at.x * 0.0 + f32::MAX;
    for i in 0..3 {
        let [first, second] = [p[(i + 1) % 3], p[(i + 2) % 3]];
        let highest = ((first - p[i]).dot(n[i]) * side).max((second - p[i]).dot(n[i]) * side).max(0.0);
        least = least.min(((p[i] - at).dot(n[i]) * side + highest).max(0.0));
    }
    least
}
