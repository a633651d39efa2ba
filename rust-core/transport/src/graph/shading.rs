//! Steps whose value depends on the hit: its position, normals and direction, steps to the next pixel, and the spaces of instances.

use super::{
    HitValue, Quantity, SurfaceColumns,
    columns::load3,
    light_path::light_path,
    vector::{from_vector, normalize, vector_of},
};
use crate::geometry::{GeometryTable, HitLanes};
use gonio_simd::{F, Frame, Lanes, Vec3};

/// The least step to the next pixel as a part of the position's largest coordinate: smaller ones would be lost in its rounding.
const LEAST_STEP: f32 = 1.0 / 16384.0;

/// One register of hits with where they are looked up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<'a, L: Lanes> {
    pub(super) geometry: &'a GeometryTable,
    pub(super) hit: HitLanes<L>,
    pub(super) points: &'a SurfaceColumns,
    pub(super) at: usize,
}

/// What is known of the hits themselves.
#[inline(always)]
pub(super) fn hit_value<L: Lanes>(l: L, points: &SurfaceColumns, at: usize, value: HitValue) -> [F<L>; 4] {
    let vector = match value {
        HitValue::Position => load3(l, &points.position, at) + Vec3::splat(l, points.origin),
        HitValue::Normal => load3(l, &points.shading_normal, at),
        HitValue::GeometricNormal => load3(l, &points.geometric_normal, at),
        HitValue::Incoming => load3(l, &points.wo, at),
        HitValue::FrontFacing => return [l.f(1.0).keep_if(l.load(&points.side, at).gt(0.0)); 4],
        HitValue::LightPath(value) => return [light_path(l, points, at, value); 4],
    };
    from_vector(l, vector)
}

impl<L: Lanes> Place<'_, L> {
    /// The way to the next pixel along one of two perpendicular directions in the surface that depend on its normal alone.
    #[inline(always)]
    fn step(&self, l: L, axis: u8) -> Vec3<L> {
        let frame = Frame::from_normal(load3(l, &self.points.geometric_normal, self.at));
        let least = load3(l, &self.points.position, self.at).max_abs().max(1.0) * LEAST_STEP;
        let direction = if axis == 0 { frame.x } else { frame.y };
        direction * l.load(&self.points.width, self.at).max(least)
    }
    /// [`Self::step`] as a value.
    #[inline(always)]
    pub(super) fn position_step(&self, l: L, axis: u8) -> [F<L>; 4] {
        from_vector(l, self.step(l, axis))
    }
    /// How much a primvar changes over the step.
    #[inline(always)]
    pub(super) fn primvar_step(&self, l: L, column: usize, axis: u8) -> [F<L>; 4] {
        let edges = self.geometry.edges(l, &self.hit);
        let normal = edges[0].cross(edges[1]);
        let squared = normal.length_squared();
        let step = self.step(l, axis);
        let usable = squared.gt(0.0) & squared.is_finite();
        let scale = squared.recip();
        let change = [step.cross(edges[1]).dot(normal) * scale, edges[0].cross(step).dot(normal) * scale];
        self.geometry.primvar_change(l, &self.hit, column, [change[0].keep_if(usable), change[1].keep_if(usable)])
    }
    /// The unit tangent along u; zero where there is none.
    #[inline(always)]
    pub(super) fn uv_tangent(&self, l: L, column: usize) -> [F<L>; 4] {
        let edges = self.geometry.edges(l, &self.hit);
        let tangent = self.geometry.uv_derivatives(l, &self.hit, column, edges).tangent;
        from_vector(l, normalize(l, tangent))
    }
}

/// Three rows of four applied to a point.
#[inline(always)]
pub(super) fn matrix_transform<L: Lanes>(value: [F<L>; 4], rows: &[[f32; 4]; 3]) -> [F<L>; 4] {
    let [x, y, z, w] = value;
    let row = |r: usize| x.mul_add(rows[r][0], y.mul_add(rows[r][1], z * rows[r][2])) + rows[r][3];
    [row(0), row(1), row(2), w]
}

/// A vector's products with three axes.
#[inline(always)]
fn along<L: Lanes>(axes: [Vec3<L>; 3], v: Vec3<L>) -> Vec3<L> {
    Vec3::new(axes[0].dot(v), axes[1].dot(v), axes[2].dot(v))
}

/// Between the world and the space of the instance that was hit; zero where the instance has no volume and its inverse is asked for.
#[inline(always)]
pub(super) fn instance_transform<L: Lanes>(l: L, place: &Place<'_, L>, value: [F<L>; 4], to_world: bool, quantity: Quantity) -> [F<L>; 4] {
    let (columns, origin) = place.geometry.instance_columns(l, &place.hit);
    let origin = origin + Vec3::splat(l, place.points.origin);
    let v = vector_of(value);
    let cofactors = [columns[1].cross(columns[2]), columns[2].cross(columns[0]), columns[0].cross(columns[1])];
    let determinant = columns[0].dot(cofactors[0]);
    let scale = (l.f(1.0) / determinant).keep_if(determinant.abs().gt(f32::MIN_POSITIVE));
    let result = match (quantity, to_world) {
        (Quantity::Point, true) => v.transform(columns) + origin,
        (Quantity::Vector, true) => v.transform(columns),
        (Quantity::Normal, true) => normalize(l, v.transform(cofactors) * l.f(1.0).copysign(determinant)),
        (Quantity::Point, false) => along(cofactors, v - origin) * scale,
        (Quantity::Vector, false) => along(cofactors, v) * scale,
        (Quantity::Normal, false) => normalize(l, along(columns, v)),
    };
    from_vector(l, result)
}
