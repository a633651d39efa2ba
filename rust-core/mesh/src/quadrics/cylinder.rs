//! Cylinders and cones with their caps.

use super::lathe::{Lathe, Row};
use super::{Axis, extent};
use crate::PolygonMesh;

/// UsdGeom Cylinder and Cylinder_1: centred at the origin, closed by flat caps where the radius is not 0.
#[must_use]
pub fn cylinder(height: f32, radius_bottom: f32, radius_top: f32, axis: Axis, segments: u32) -> PolygonMesh {
    let (half, bottom, top) = (0.5 * extent(height), extent(radius_bottom), extent(radius_top));
    let mut lathe = Lathe::new(segments, axis);
    let cap = |radius, height, along, t| Row { radius, height, normal: [0.0, along], t };
    lathe.strip(&[cap(0.0, -half, -1.0, 0.0), cap(bottom, -half, -1.0, 1.0)]);
    lathe.strip(&side(bottom, -half, top, half));
    lathe.strip(&[cap(top, half, 1.0, 0.0), cap(0.0, half, 1.0, 1.0)]);
    lathe.finish()
}

/// UsdGeom Cone: the tip at + half the height, the base closed.
#[must_use]
pub fn cone(height: f32, radius: f32, axis: Axis, segments: u32) -> PolygonMesh {
    cylinder(height, radius, 0.0, axis, segments)
}

/// The slanted side between two rings.
pub(super) fn side(low_radius: f32, low: f32, high_radius: f32, high: f32) -> [Row; 2] {
    let (away, along) = (high - low, low_radius - high_radius);
    let length = away.hypot(along);
    let normal = if length > 0.0 { [away / length, along / length] } else { [1.0, 0.0] };
    [Row { radius: low_radius, height: low, normal, t: 0.0 }, Row { radius: high_radius, height: high, normal, t: 1.0 }]
}
