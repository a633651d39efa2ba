//! Rectangle about the origin.

use super::{Axis, extent, surface_primvars};
use crate::PolygonMesh;
use crate::vector::{add, cross, dot, scale};

/// UsdGeom Plane facing +`axis`: width is along X (along Z for axis X), length along Y (along Z for axis Y). s grows
/// with the width's axis, t with the length's.
#[must_use]
pub fn plane(width: f32, length: f32, axis: Axis) -> PolygonMesh {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let (across, along, normal) = match axis {
        Axis::X => (z, y, x),
        Axis::Y => (x, z, y),
        Axis::Z => (x, y, z),
    };
    let mut st = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    if dot(cross(across, along), normal) < 0.0 {
        st.reverse();
    }
    let at = |[s, t]: [f32; 2]| add(scale(across, extent(width) * (s - 0.5)), scale(along, extent(length) * (t - 0.5)));
    let points = st.map(at).to_vec();
    let primvars = surface_primvars(vec![normal; 4], st.to_vec());
    PolygonMesh { points, face_counts: vec![4], corners: vec![0, 1, 2, 3], primvars, ..PolygonMesh::default() }
}
