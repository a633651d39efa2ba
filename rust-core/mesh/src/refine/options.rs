//! How to subdivide: scheme, level, boundary rules, creases.

/// Subdivision scheme (UsdGeomMesh `subdivisionScheme`; `none` means not to call [`super::refine`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// Catmull-Clark, for any polygons.
    #[default]
    CatmullClark,
    /// Loop, for triangles; other faces are cut into triangles first.
    Loop,
    /// Linear: the surface stays that of the polygons.
    Bilinear,
}

/// What happens at boundaries (`interpolateBoundary`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BoundaryInterpolation {
    /// Faces at the boundary have no surface.
    None,
    /// Boundary edges are creases.
    EdgeOnly,
    /// As `EdgeOnly`, and boundary vertices of a single face are corners.
    #[default]
    EdgeAndCorner,
}

/// Where face-varying values are linear (`faceVaryingLinearInterpolation`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FaceVaryingInterpolation {
    /// Nowhere.
    None,
    /// At corners of a region of continuous values.
    CornersOnly,
    /// As `CornersOnly`, and where more than two regions meet.
    #[default]
    CornersPlus1,
    /// As `CornersPlus1`, and at the ends of seams.
    CornersPlus2,
    /// Along all boundaries of continuous regions.
    Boundaries,
    /// Everywhere.
    All,
}

/// Weights of triangles under Catmull-Clark (`triangleSubdivisionRule`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TriangleRule {
    /// As for any polygon.
    #[default]
    CatmullClark,
    /// Weights that make triangles look smoother.
    Smooth,
}

/// How to subdivide a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefineOptions {
    /// Scheme.
    pub scheme: Scheme,
    /// How often each face is split.
    pub level: u32,
    /// Rule at boundaries.
    pub boundary: BoundaryInterpolation,
    /// Rule for face-varying values.
    pub face_varying: FaceVaryingInterpolation,
    /// Rule for triangles under Catmull-Clark.
    pub triangles: TriangleRule,
    /// Whether points and smooth primvars are moved to the limit surface after the last level.
    pub to_limit: bool,
    /// Whether to compute normals.
    pub normals: bool,
    /// The level is reduced until there are no more faces than this.
    pub max_faces: usize,
}

impl Default for RefineOptions {
    /// UsdGeomMesh's rules, level 2 on the limit surface with normals, at most 2²⁴ faces.
    fn default() -> Self {
        Self {
            scheme: Scheme::default(),
            level: 2,
            boundary: BoundaryInterpolation::default(),
            face_varying: FaceVaryingInterpolation::default(),
            triangles: TriangleRule::default(),
            to_limit: true,
            normals: true,
            max_faces: 1 << 24,
        }
    }
}

/// Semi-sharp features: chains of vertices and single vertices. A sharpness of 10 or more is infinite; NaN and negative
/// ones are smooth; what names no edge or point of the mesh is ignored and reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Creases {
    /// Vertices of all chains.
    pub crease_indices: Vec<u32>,
    /// Number of vertices of each chain.
    pub crease_lengths: Vec<u32>,
    /// One per chain, or one per edge of all chains.
    pub crease_sharpnesses: Vec<f32>,
    /// Sharp vertices.
    pub corner_indices: Vec<u32>,
    /// One per sharp vertex.
    pub corner_sharpnesses: Vec<f32>,
}
