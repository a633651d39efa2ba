//! Steps whose value depends on the hit: its position, normals and direction, steps to the next pixel, and the spaces of instances.

use super::{SurfaceColumns, columns::load3, light_path::light_path};
use crate::geometry::{GeometryTable, HitLanes};
use gonio_nodes::{Operation, Quantity, normalize};
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

/// A vector with zero as its fourth component.
#[inline(always)]
pub(super) fn from_vector<L: Lanes>(l: L, v: Vec3<L>) -> [F<L>; 4] {
    [v.x, v.y, v.z, l.f(0.0)]
}

/// What is known of the surface points themselves; zero for other operations.
#[inline(always)]
pub(super) fn point_value<L: Lanes>(l: L, points: &SurfaceColumns, at: usize, operation: &Operation) -> [F<L>; 4] {
    let vector = match operation {
        Operation::Position => load3(l, &points.position, at) + Vec3::splat(l, points.origin),
        Operation::Normal => load3(l, &points.shading_normal, at),
        Operation::GeometricNormal => load3(l, &points.geometric_normal, at),
        Operation::Incoming => load3(l, &points.wo, at),
        Operation::FrontFacing => return [l.f(1.0).keep_if(l.load(&points.side, at).gt(0.0)); 4],
        Operation::LightPath(value) => return [light_path(l, points, at, *value); 4],
        Operation::PositionStep { axis } => step(l, points, at, *axis),
        _ => Vec3::splat(l, [0.0; 3]),
    };
    from_vector(l, vector)
}

/// Two perpendicular directions in the surface that depend on its normal alone: those of Cycles.
#[inline(always)]
pub(super) fn beside<L: Lanes>(normal: Vec3<L>) -> [Vec3<L>; 2] {
    // Perpendicular to (1, 1, 1), but for normals along that.
    let along = normal.x.eq(normal.y) & normal.x.eq(normal.z);
    let usual = Vec3::new(normal.z - normal.y, normal.x - normal.z, normal.y - normal.x);
    let other = Vec3::new(normal.z - normal.y, normal.x + normal.z, -normal.y - normal.x);
    let first = along.select(other, usual).normalize_or(Frame::from_normal(normal).x);
    [first, normal.cross(first)]
}

/// The way to the next pixel along one of the directions of [`beside`], as wide as the ray's cone, for heights beside the hit are taken there.
#[inline(always)]
fn step<L: Lanes>(l: L, points: &SurfaceColumns, at: usize, axis: u8) -> Vec3<L> {
    let [first, second] = beside(load3(l, &points.geometric_normal, at));
    let direction = if axis == 0 { first } else { second };
    let least = load3(l, &points.position, at).max_abs().max(1.0) * LEAST_STEP;
    direction * l.load(&points.cone, at).max(least)
}

impl<L: Lanes> Place<'_, L> {
    /// How much a primvar changes over the step.
    #[inline(always)]
    pub(super) fn primvar_step(&self, l: L, column: usize, axis: u8) -> [F<L>; 4] {
        let edges = self.geometry.edges(l, &self.hit);
        let normal = edges[0].cross(edges[1]);
        let squared = normal.length_squared();
        let step = step(l, self.points, self.at, axis);
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

/// A vector's products with three axes.
#[inline(always)]
fn along<L: Lanes>(axes: [Vec3<L>; 3], v: Vec3<L>) -> Vec3<L> {
    Vec3::new(axes[0].dot(v), axes[1].dot(v), axes[2].dot(v))
}

/// Between the world and the space of the instance that was hit; zero where the instance has no volume and its inverse is asked for.
#[inline(always)]
pub(super) fn instance_transform<L: Lanes>(l: L, place: &Place<'_, L>, value: [F<L>; 3], to_world: bool, quantity: Quantity) -> [F<L>; 4] {
    let (columns, origin) = place.geometry.instance_columns(l, &place.hit);
    let origin = origin + Vec3::splat(l, place.points.origin);
    let v = Vec3::from(value);
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
