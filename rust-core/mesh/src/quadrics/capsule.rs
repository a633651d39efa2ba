//! Capsules: a cylinder or frustum between two half spheres.

use super::cylinder::side;
use super::lathe::{Lathe, arc};
use super::{Axis, extent};
use crate::PolygonMesh;
use std::f64::consts::FRAC_PI_2;

/// UsdGeom Capsule and Capsule_1: `height` is that of the part between the half spheres. t is 0 to ¼ on the bottom half
/// sphere, ¼ to ¾ between and ¾ to 1 on the top.
#[must_use]
pub fn capsule(height: f32, radius_bottom: f32, radius_top: f32, axis: Axis, segments: u32) -> PolygonMesh {
    let (half, bottom, top) = (0.5 * extent(height), extent(radius_bottom), extent(radius_top));
    let rings = (segments.clamp(3, 4096) / 4).max(2);
    let mut lathe = Lathe::new(segments, axis);
    lathe.strip(&arc(bottom, -half, -FRAC_PI_2, 0.0, rings, [0.0, 0.25]));
    let mut between = side(bottom, -half, top, half);
    between[0].t = 0.25;
    between[1].t = 0.75;
    lathe.strip(&between);
    lathe.strip(&arc(top, half, 0.0, FRAC_PI_2, rings, [0.75, 1.0]));
    lathe.finish()
}
