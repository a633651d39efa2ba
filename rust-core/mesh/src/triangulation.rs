//! The triangles of a polygon mesh.

/// The triangles of a polygon mesh, counter-clockwise seen from the front, with the way back to the polygons.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    /// Points of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Face corner (index into [`super::PolygonMesh::corners`]) of each triangle corner.
    pub corner_of: Vec<[u32; 3]>,
    /// Face of each triangle.
    pub face_of: Vec<u32>,
    /// Faces that are no holes and gave no triangle: too few corners, or corners out of range.
    pub skipped_faces: usize,
}
