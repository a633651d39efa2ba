//! Polygon meshes of files: Wavefront OBJ, and PLY (Turk 1994) as text and in both byte orders.

mod obj;
mod ply;
mod ply_body;
mod ply_header;
mod write;

use crate::{FormatError, error::Result};

pub use write::to_obj;

/// Polygons, with values of their corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygons {
    /// Positions in the file's own unit and axes.
    pub points: Vec<[f32; 3]>,
    /// Corners of each face, three or more.
    pub face_counts: Vec<u32>,
    /// The point of each corner.
    pub corners: Vec<u32>,
    /// The shading normal of each corner, as the file has it; empty where no corner has one. A corner without one has its face's.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates of each corner, v upwards; empty where no corner has any. A corner without has (0, 0).
    pub uvs: Vec<[f32; 2]>,
    /// Names of the materials, in the order in which faces use them. One that is nameless stands for faces without.
    pub materials: Vec<String>,
    /// Of each face its place in `materials`.
    pub face_materials: Vec<u16>,
}

/// Reads either format; PLY begins with its name.
///
/// # Errors
/// The first line, or byte, that cannot be used.
pub fn read(bytes: &[u8]) -> Result<Polygons> {
    if bytes.starts_with(b"ply") { ply::read(bytes) } else { obj::read(bytes) }
}

impl Polygons {
    /// Normals of corners that may have none.
    fn set_normals(&mut self, normals: &[Option<[f32; 3]>]) {
        if normals.iter().all(Option::is_none) {
            return;
        }
        let mut start = 0;
        for count in &self.face_counts {
            let end = start + *count as usize;
            let of_face = &normals[start..end];
            let flat = if of_face.contains(&None) { self.face_normal(start..end) } else { [0.0; 3] };
            self.normals.extend(of_face.iter().map(|normal| normal.unwrap_or(flat)));
            start = end;
        }
    }

    /// Newell's normal of a face, not unit.
    fn face_normal(&self, corners: std::ops::Range<usize>) -> [f32; 3] {
        let point = |corner: &u32| self.points[*corner as usize];
        let corners = &self.corners[corners];
        let edges = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (point(a), point(b)));
        edges.fold([0.0; 3], |sum, (a, b)| {
            std::array::from_fn(|k| {
                let (y, z) = ((k + 1) % 3, (k + 2) % 3);
                sum[k] + (a[y] - b[y]) * (a[z] + b[z])
            })
        })
    }
}

/// Numbers that are to be finite.
fn finite<const N: usize>(values: [f32; N], line: u64) -> Result<[f32; N]> {
    if values.iter().all(|x| x.is_finite()) { Ok(values) } else { Err(FormatError::line(line, "a number is not finite")) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests;
