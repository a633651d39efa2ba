//! What can be wrong with a polygon mesh, and how bad it is.

use super::interpolation::Interpolation;
use std::fmt;

/// Most points, faces or corners of one mesh: an index and the number of half-edges both fit 32 bits.
pub(crate) const MAX_ELEMENTS: usize = (1 << 31) - 1;

/// What a [`MeshProblem`] costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The mesh cannot be used.
    Fatal,
    /// The primvar at this place of the mesh's list cannot be used, the rest can.
    Primvar(usize),
    /// Something was left out or repaired.
    Warning,
}

/// One problem of a mesh. `Display` says what was found and what was expected; the caller adds the place.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshProblem {
    /// A face has a negative number of corners.
    NegativeFaceCount {
        /** Index of the face. */
        face: usize,
        /** The count found. */
        count: i32,
    },
    /// A face corner has a negative vertex index.
    NegativeVertex {
        /** Index of the corner. */
        corner: usize,
        /** The index found. */
        index: i32,
    },
    /// The face counts do not add up to the number of corners.
    CornerCount {
        /** Sum of the face counts. */
        expected: u64,
        /** Number of corners. */
        found: usize,
    },
    /// A face corner names a point that does not exist; the first of `count` such corners.
    VertexOutOfRange {
        /** First bad corner. */
        corner: usize,
        /** Its vertex. */
        vertex: u32,
        /** Number of points. */
        points: usize,
        /** Number of bad corners. */
        count: usize,
    },
    /// Points are NaN or infinite.
    NonFinitePoints {
        /** First bad point. */
        first: usize,
        /** Number of bad points. */
        count: usize,
    },
    /// More elements than 32-bit indices can name.
    TooLarge {
        /** What there is too much of. */
        what: &'static str,
        /** How many. */
        count: usize,
    },
    /// Faces with fewer than three corners; they are skipped.
    ShortFaces {
        /** First such face. */
        first: usize,
        /** Number of such faces. */
        count: usize,
    },
    /// Hole indices that name no face; they are ignored.
    HoleOutOfRange {
        /** First bad hole index. */
        hole: u32,
        /** Number of faces. */
        faces: usize,
        /** Number of bad indices. */
        count: usize,
    },
    /// A primvar has an impossible number of components.
    PrimvarComponents {
        /** Place in the mesh's list. */
        primvar: usize,
        /** Its name. */
        name: String,
        /** Components found. */
        found: usize,
    },
    /// A primvar has the wrong number of floats or indices for its interpolation.
    PrimvarLength {
        /** Place in the mesh's list. */
        primvar: usize,
        /** Its name. */
        name: String,
        /** Its interpolation. */
        interpolation: Interpolation,
        /** Elements expected. */
        expected: usize,
        /** Elements found (floats / components, rounded down). */
        found: usize,
    },
    /// A primvar index names an element that does not exist.
    PrimvarIndex {
        /** Place in the mesh's list. */
        primvar: usize,
        /** Its name. */
        name: String,
        /** Place of the first bad index. */
        position: usize,
        /** The index. */
        index: u32,
        /** Number of elements. */
        elements: usize,
    },
    /// A primvar has NaN or infinite values; they are set to 0.
    PrimvarNonFinite {
        /** Its name. */
        name: String,
        /** Number of bad floats. */
        count: usize,
    },
    /// Crease or corner data of a subdivision surface cannot be used and is ignored.
    Crease {
        /** What was found and expected. */
        message: String,
    },
    /// The subdivision level asked for would give more faces than allowed.
    LevelReduced {
        /** Level asked for. */
        asked: u32,
        /** Level given. */
        given: u32,
        /** Faces allowed. */
        max_faces: usize,
    },
}

impl MeshProblem {
    /// What the problem costs.
    #[must_use]
    pub fn severity(&self) -> Severity {
        match self {
            Self::PrimvarComponents { primvar, .. } | Self::PrimvarLength { primvar, .. } | Self::PrimvarIndex { primvar, .. } => {
                Severity::Primvar(*primvar)
            }
            Self::ShortFaces { .. }
            | Self::HoleOutOfRange { .. }
            | Self::PrimvarNonFinite { .. }
            | Self::Crease { .. }
            | Self::LevelReduced { .. } => Severity::Warning,
            _ => Severity::Fatal,
        }
    }
}

impl fmt::Display for MeshProblem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NegativeFaceCount { face, count } => write!(out, "face {face} has {count} corners, expected 3 or more"),
            Self::NegativeVertex { corner, index } => write!(out, "face corner {corner} has vertex {index}, expected 0 or more"),
            Self::CornerCount { expected, found } => write!(out, "{found} face corners, but the face counts add up to {expected}"),
            Self::VertexOutOfRange { corner, vertex, points, count } => {
                write!(out, "face corner {corner} has vertex {vertex}, but there are {points} points ({count} such corners)")
            }
            Self::NonFinitePoints { first, count } => write!(out, "{count} points are not finite, the first is point {first}"),
            Self::TooLarge { what, count } => write!(out, "{count} {what}, expected at most {}", MAX_ELEMENTS),
            Self::ShortFaces { first, count } => {
                write!(out, "{count} faces have fewer than 3 corners and are skipped, the first is face {first}")
            }
            Self::HoleOutOfRange { hole, faces, count } => {
                write!(out, "hole index {hole} names no face, there are {faces} ({count} such indices are ignored)")
            }
            Self::PrimvarComponents { name, found, .. } => write!(out, "primvar '{name}' has {found} components, expected 1 to 16"),
            Self::PrimvarLength { name, interpolation, expected, found, .. } => {
                write!(out, "primvar '{name}' has {found} elements, expected {expected} for {interpolation:?} interpolation")
            }
            Self::PrimvarIndex { name, position, index, elements, .. } => {
                write!(out, "primvar '{name}' has index {index} at place {position}, but there are {elements} elements")
            }
            Self::PrimvarNonFinite { name, count } => {
                write!(out, "primvar '{name}' has {count} values that are not finite, they are set to 0")
            }
            Self::Crease { message } => out.write_str(message),
            Self::LevelReduced { asked, given, max_faces } => {
                write!(out, "subdivision level {asked} would give more than {max_faces} faces, level {given} is used")
            }
        }
    }
}

impl std::error::Error for MeshProblem {}
