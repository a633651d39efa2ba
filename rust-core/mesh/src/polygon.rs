//! A mesh of polygons of any valence, as front ends have it.

use super::{FacePrimvar, Interpolation, MeshProblem};
use std::ops::Range;

/// A polygon mesh: `face_counts` cuts `corners` into faces, each corner names a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// Positions.
    pub points: Vec<[f32; 3]>,
    /// Corners of each face.
    pub face_counts: Vec<u32>,
    /// Point of each face corner.
    pub corners: Vec<u32>,
    /// Faces that are part of the topology but have no surface.
    pub hole_faces: Vec<u32>,
    /// Whether the corners of a face run clockwise when seen from its front.
    pub left_handed: bool,
    /// Named values over the mesh.
    pub primvars: Vec<FacePrimvar>,
}

impl PolygonMesh {
    /// A mesh without primvars and holes from signed arrays as files and hosts have them.
    ///
    /// # Errors
    /// The first negative face count or vertex index; nothing else is checked here, see [`PolygonMesh::validate`].
    pub fn from_signed(points: Vec<[f32; 3]>, face_counts: &[i32], corners: &[i32]) -> Result<Self, MeshProblem> {
        let unsigned = |values: &[i32]| values.iter().map(|&value| u32::try_from(value)).collect::<Result<Vec<u32>, _>>().ok();
        let first_negative = |values: &[i32]| values.iter().position(|&value| value < 0).unwrap_or(0);
        let Some(face_counts) = unsigned(face_counts) else {
            let face = first_negative(face_counts);
            return Err(MeshProblem::NegativeFaceCount { face, count: face_counts[face] });
        };
        let Some(corners) = unsigned(corners) else {
            let corner = first_negative(corners);
            return Err(MeshProblem::NegativeVertex { corner, index: corners[corner] });
        };
        Ok(Self { points, face_counts, corners, ..Self::default() })
    }

    /// The faces that can have a surface, as (face, range of its corners): three corners or more, all inside
    /// `corners` and all naming existing points. Holes are among them.
    pub fn usable_faces(&self) -> impl Iterator<Item = (u32, Range<usize>)> + '_ {
        let mut end = 0usize;
        self.face_counts.iter().enumerate().filter_map(move |(face, &count)| {
            let start = end;
            end = end.saturating_add(count as usize);
            let vertices = self.corners.get(start..end)?;
            let usable = count >= 3 && vertices.iter().all(|&vertex| (vertex as usize) < self.points.len());
            usable.then_some((face as u32, start..end))
        })
    }

    /// For each face whether it is a hole.
    #[must_use]
    pub fn hole_mask(&self) -> Vec<bool> {
        let mut mask = vec![false; self.face_counts.len()];
        for &hole in &self.hole_faces {
            if let Some(entry) = mask.get_mut(hole as usize) {
                *entry = true;
            }
        }
        mask
    }

    /// How many elements a primvar of this interpolation must have.
    #[must_use]
    pub fn place_count(&self, interpolation: Interpolation) -> usize {
        match interpolation {
            Interpolation::Constant => 1,
            Interpolation::Uniform => self.face_counts.len(),
            Interpolation::Varying | Interpolation::Vertex => self.points.len(),
            Interpolation::FaceVarying => self.corners.len(),
        }
    }
}
