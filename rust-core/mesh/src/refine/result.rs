//! What subdivision gives back.

use crate::{FacePrimvar, MeshProblem, PolygonMesh, Severity};
use std::fmt;

/// A refined mesh and the way back.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    /// The refined polygons with all primvars carried over; holes are marked, not removed.
    pub mesh: PolygonMesh,
    /// Face of the original mesh that each face comes from.
    pub face_of: Vec<u32>,
    /// Face-varying, indexed primvar `normals`, split at sharp edges; outward also for left-handed meshes.
    pub normals: Option<FacePrimvar>,
    /// Level reached.
    pub level: u32,
    /// What was left out.
    pub problems: Vec<MeshProblem>,
}

/// Why a mesh was not refined.
#[derive(Clone, Debug, PartialEq)]
pub enum RefineError {
    /// The topology is broken; all that was found, with at least one fatal problem.
    Invalid(Vec<MeshProblem>),
    /// The caller asked to stop.
    Cancelled,
}

impl fmt::Display for RefineError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cancelled => out.write_str("cancelled"),
            Self::Invalid(problems) => {
                let fatal = problems.iter().find(|problem| problem.severity() == Severity::Fatal);
                match fatal {
                    Some(problem) => problem.fmt(out),
                    None => out.write_str("the mesh cannot be subdivided"),
                }
            }
        }
    }
}

impl std::error::Error for RefineError {}
