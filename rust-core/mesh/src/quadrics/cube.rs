//! Cube about the origin.

use super::{Axis, extent, surface_primvars};
use crate::PolygonMesh;

/// UsdGeom Cube of edge length `size`: eight points, six quads with sharp normals, `st` over the unit square of each face.
#[must_use]
pub fn cube(size: f32) -> PolygonMesh {
    let half = 0.5 * extent(size);
    let sign = |point: usize, bit: usize| if point >> bit & 1 == 1 { half } else { -half };
    let points = (0..8).map(|point| [sign(point, 0), sign(point, 1), sign(point, 2)]).collect();
    let (mut corners, mut normals, mut st) = (Vec::new(), Vec::new(), Vec::new());
    for axis in [Axis::X, Axis::Y, Axis::Z] {
        for up in [1.0f32, -1.0] {
            for [x, y] in [[-1.0f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
                // Mirroring x on the lower side keeps the winding outward.
                let corner = axis.turn([x * up, y, up]);
                corners.push((0..3).map(|bit| u32::from(corner[bit] > 0.0) << bit).sum());
                normals.push(axis.turn([0.0, 0.0, up]));
                st.push([0.5 + 0.5 * x, 0.5 + 0.5 * y]);
            }
        }
    }
    PolygonMesh { points, face_counts: vec![4; 6], corners, primvars: surface_primvars(normals, st), ..PolygonMesh::default() }
}
