//! Surface points at hits: position with an error bound, normals, and the primvars' derivatives, on lanes.

use super::{GeometryTable, NORMALS, SmoothHit, instance_row::MeshLanes};
use gonio_simd::{F, Lanes, U, Vec3};

/// Hits of meshes, curves and points, one per lane, with what is looked up once.
#[derive(Clone, Copy, Debug)]
pub struct HitLanes<L: Lanes> {
    /// Instance number.
    pub instance: U<L>,
    /// Triangle number in its mesh.
    pub primitive: U<L>,
    /// Barycentric coordinate of corner 1.
    pub u: F<L>,
    /// Barycentric coordinate of corner 2.
    pub v: F<L>,
    /// Mesh number.
    pub mesh: U<L>,
    /// First point of the mesh.
    pub first_point: U<L>,
    /// First reference to primvars of the instance's own, or [`NONE`](super::NONE).
    pub first_primvar: U<L>,
    /// Point numbers of the corners over all meshes.
    pub points: [U<L>; 3],
    /// Time of the shutter, from 0 to 1.
    pub time: F<L>,
    /// On curves and points what there is in place of corners; values there change as between corners 0 and 1.
    pub smooth: SmoothHit<L>,
}

impl<L: Lanes> HitLanes<L> {
    /// The same hits at other times.
    #[inline(always)]
    pub fn at_time(self, time: F<L>) -> Self {
        Self { time, ..self }
    }
}

/// A point on a surface, world space.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<L: Lanes> {
    /// Position.
    pub position: Vec3<L>,
    /// How far along the normal the true point may lie from `position`, metres.
    pub error: F<L>,
    /// Unit normal of the triangle, on the side its winding shows counter-clockwise.
    pub geometric_normal: Vec3<L>,
    /// Unit shading normal on the same side.
    pub shading_normal: Vec3<L>,
    /// Edges from corner 0 to 1 and 2, world space.
    pub edges: [Vec3<L>; 2],
    /// Twice the triangle's area.
    pub double_area: F<L>,
    /// Along curves, not unit; elsewhere zero.
    pub tangent: Vec3<L>,
}

/// Rounding errors of a chain of `n` operations: n ε / (1 − n ε) (Higham; pbrt-v4 section 6.8).
pub(super) const fn gamma(n: u32) -> f32 {
    let e = f32::EPSILON * 0.5;
    n as f32 * e / (1.0 - n as f32 * e)
}

impl GeometryTable {
    /// Looks up what the hits refer to, in the middle of the shutter.
    #[inline(always)]
    pub fn hit_lanes<L: Lanes>(&self, l: L, instance: U<L>, primitive: U<L>, u: F<L>, v: F<L>) -> HitLanes<L> {
        let MeshLanes { mesh, first_triangle, first_point, first_primvar } = self.mesh_lanes(l, instance);
        let corners = (first_triangle + primitive) * 3;
        let corners = if self.any_smooth() { corners.keep_if(corners.lt(self.corners.len() as u32)) } else { corners };
        let [a, b, c, _] = l.gather_integer_quads(&self.corners, corners);
        let smooth = SmoothHit::none(l);
        let hit = HitLanes { instance, primitive, u, v, mesh, first_point, first_primvar, points: [a, b, c], time: l.f(0.5), smooth };
        if self.any_smooth() { self.with_smooth(l, hit, first_triangle) } else { hit }
    }

    /// The points themselves.
    ///
    /// Positions come from the triangle, not from the ray, so their error does not grow with the distance travelled.
    #[inline(always)]
    pub fn surface_point<L: Lanes>(&self, l: L, hit: &HitLanes<L>) -> SurfacePoint<L> {
        let (p0, p1, p2) = (self.point(l, hit, 0), self.point(l, hit, 1), self.point(l, hit, 2));
        let (columns, origin) = self.instance_columns(l, hit);
        let w = l.f(1.0) - hit.u - hit.v;
        let local = p0 * w + p1 * hit.u + p2 * hit.v;
        let position = local.transform(columns) + origin;
        let edges = [(p1 - p0).transform(columns), (p2 - p0).transform(columns)];
        let cross = edges[0].cross(edges[1]);
        // A mirroring map turns the winding round.
        let cofactors = [columns[1].cross(columns[2]), columns[2].cross(columns[0]), columns[0].cross(columns[1])];
        let determinant = columns[0].dot(cofactors[0]);
        let sign = l.f(1.0).copysign(determinant);
        let double_area = cross.length();
        let geometric_normal = (cross * sign).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
        let shading_normal = self.shading_normal(l, hit, cofactors, sign, geometric_normal);
        let error = self.position_error([p0, p1, p2], local, columns, origin, edges);
        let tangent = Vec3::splat(l, [0.0; 3]);
        let point = SurfacePoint { position, error, geometric_normal, shading_normal, edges, double_area, tangent };
        if self.any_smooth() { self.smooth_point(l, hit, (columns, origin), (cofactors, sign), point) } else { point }
    }

    /// The interpolated normal carried to world space, on the geometric normal's side.
    #[inline(always)]
    pub(super) fn shading_normal<L: Lanes>(&self, l: L, hit: &HitLanes<L>, cofactors: [Vec3<L>; 3], sign: F<L>, flat: Vec3<L>) -> Vec3<L> {
        if !self.any_normals {
            return flat;
        }
        let reference = self.reference(l, hit, NORMALS);
        let present = reference.present();
        if !present.any() {
            return flat;
        }
        let n0 = self.corner_vector(l, hit, &reference, 0);
        let n1 = self.corner_vector(l, hit, &reference, 1);
        let n2 = self.corner_vector(l, hit, &reference, 2);
        let local = n0 * (l.f(1.0) - hit.u - hit.v) + n1 * hit.u + n2 * hit.v;
        let world = (local.transform(cofactors) * sign).normalize_or(flat);
        // Authored normals may point to the other side; which side is the front is the winding's business.
        let same = world.dot(flat).ge(0.0);
        present.select(same.select(world, -world), flat)
    }

    /// A bound on how far position and later intersections may be off the plane, in single precision: interpolation, transformation to the
    /// world and of a new ray back to the object (pbrt-v4 section 6.8.4), and the distance test of a triangle of this size.
    #[inline(always)]
    fn position_error<L: Lanes>(
        &self,
        corners: [Vec3<L>; 3],
        local: Vec3<L>,
        columns: [Vec3<L>; 3],
        origin: Vec3<L>,
        edges: [Vec3<L>; 2],
    ) -> F<L> {
        let extent = corners[0].max_abs().max(corners[1].max_abs()).max(corners[2].max_abs());
        let stretch = columns[0].max_abs() + columns[1].max_abs() + columns[2].max_abs();
        let moved = stretch * (extent * gamma(9) + local.max_abs() * gamma(5));
        let size = edges[0].max_abs() + edges[1].max_abs();
        origin.max_abs().mul_add(gamma(5), size.mul_add(gamma(8), moved))
    }
}

impl<L: Lanes> SurfacePoint<L> {
    /// Where a ray into `direction` may start without meeting the surface it leaves.
    #[inline(always)]
    pub fn offset_ray_origin(&self, direction: Vec3<L>) -> Vec3<L> {
        offset_ray_origin(self.position, self.geometric_normal, self.error, direction)
    }
}

/// A ray's start at `position` moved off the surface to the side `direction` points to, by twice the error bound.
#[inline(always)]
pub fn offset_ray_origin<L: Lanes>(position: Vec3<L>, normal: Vec3<L>, error: F<L>, direction: Vec3<L>) -> Vec3<L> {
    let side = (error * 2.0).copysign(normal.dot(direction));
    normal.mul_add(side, position)
}

/// Beyond this many metres a point is as good as a direction.
const FAR: f32 = 1e9;
/// A ray to a point ends this part of its length before it, so that what the point lies on is not in its way.
const BEFORE_END: f32 = 1e-4;

/// A ray from a surface to a point: start, direction and end.
#[derive(Clone, Copy, Debug)]
pub struct ShadowSegment<L: Lanes> {
    /// Where it may start without meeting the surface it leaves.
    pub origin: Vec3<L>,
    /// Unit direction to the point.
    pub direction: Vec3<L>,
    /// Distance short of the point.
    pub t_max: F<L>,
}

/// The ray from `position` to the point `distance` away in `direction`. It leads there from where it starts: if it were moved off the surface
/// and no more, it would meet what the point lies on before its end, at grazing angles by far.
#[inline(always)]
pub fn shadow_ray_to<L: Lanes>(position: Vec3<L>, normal: Vec3<L>, error: F<L>, direction: Vec3<L>, distance: F<L>) -> ShadowSegment<L> {
    shadow_ray_from(offset_ray_origin(position, normal, error, direction), position, direction, distance)
}

/// The ray from `origin` to the point that is `distance` away from `position` in `direction`.
#[inline(always)]
pub fn shadow_ray_from<L: Lanes>(origin: Vec3<L>, position: Vec3<L>, direction: Vec3<L>, distance: F<L>) -> ShadowSegment<L> {
    let way = direction.mul_add(distance, position - origin);
    let near = distance.lt(FAR);
    let length = near.select(way.length(), distance);
    ShadowSegment {
        origin,
        direction: near.select(way * length.max(f32::MIN_POSITIVE).recip(), direction),
        t_max: (length * (1.0 - BEFORE_END)).min(f32::MAX),
    }
}
