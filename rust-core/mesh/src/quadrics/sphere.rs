//! Sphere about the origin, its poles on Z.

use super::lathe::{Lathe, arc};
use super::{Axis, extent};
use crate::PolygonMesh;
use std::f64::consts::FRAC_PI_2;

/// UsdGeom Sphere: s runs around Z from +X, t from the south pole (0) to the north pole (1).
#[must_use]
pub fn sphere(radius: f32, segments: u32) -> PolygonMesh {
    let mut lathe = Lathe::new(segments, Axis::Z);
    lathe.strip(&arc(extent(radius), 0.0, -FRAC_PI_2, FRAC_PI_2, (segments.clamp(3, 4096) / 2).max(2), [0.0, 1.0]));
    lathe.finish()
}
