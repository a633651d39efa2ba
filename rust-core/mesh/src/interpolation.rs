//! How primvars spread over a mesh.

/// How the elements of a primvar map to a mesh (the USD names).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// One element for the mesh.
    Constant,
    /// One element per face.
    Uniform,
    /// One element per point, interpolated linearly under subdivision.
    Varying,
    /// One element per point, interpolated like the points under subdivision.
    Vertex,
    /// One element per face corner.
    FaceVarying,
}
