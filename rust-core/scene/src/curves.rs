//! Curves: hair, fur, grass, threads.

use super::{Origin, PointKey, Primvar};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How the points of a curve are joined (UsdGeomBasisCurves' `type` and `basis`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum CurveBasis {
    /// By straight lines.
    #[default]
    Linear,
    /// By cubic Bézier spans: every third point is passed, those between pull.
    Bezier,
    /// By a uniform cubic B-spline, which passes near its points.
    BSpline,
    /// By a cubic Catmull–Rom spline, which passes through its points.
    CatmullRom,
}

/// What happens at the ends of a curve (UsdGeomBasisCurves' `wrap`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum CurveWrap {
    /// Spans lie where the points give them; the first and the last point of a spline only steer.
    #[default]
    Nonperiodic,
    /// The curve is closed.
    Periodic,
    /// Splines reach to their first and last points; linear and Bézier curves do so anyway.
    Pinned,
}

/// What is seen of curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum CurveShape {
    /// Tubes with round ends.
    #[default]
    Round,
    /// Flat ribbons that turn towards each ray; their shading normals are those of tubes.
    Ribbon,
}

/// Curves in their own space.
///
/// Elements of primvars: `Constant` one value; `Uniform` one a curve; `Varying` one a joint of spans (a point of linear curves); `Vertex` one a point.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Curves {
    /// Where they came from.
    pub origin: Origin,
    /// Points, local units, curve after curve.
    #[serde(with = "super::blob")]
    pub points: Arc<[[f32; 3]]>,
    /// Points at evenly spaced times over the shutter, two or more; empty where the curves keep their shape.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<PointKey>,
    /// Points of each curve.
    #[serde(with = "super::blob")]
    pub counts: Arc<[u32]>,
    /// How points are joined.
    pub basis: CurveBasis,
    /// What happens at the ends.
    pub wrap: CurveWrap,
    /// What is seen.
    pub shape: CurveShape,
    /// Diameters, local units: one component, of any interpolation but `FaceVarying`.
    pub widths: Primvar,
    /// Other named values.
    pub primvars: Vec<Primvar>,
}

impl CurveBasis {
    /// Spans of a curve of so many points, and its joints; zeros for too few points.
    pub fn spans(self, points: usize, wrap: CurveWrap) -> [usize; 2] {
        let closed = wrap == CurveWrap::Periodic;
        let spans = match self {
            Self::Linear if closed => points,
            Self::Linear => points.saturating_sub(1),
            Self::Bezier if closed => points / 3,
            Self::Bezier => points.saturating_sub(1) / 3,
            Self::BSpline | Self::CatmullRom => match wrap {
                CurveWrap::Periodic => points,
                CurveWrap::Pinned => points.saturating_sub(1),
                CurveWrap::Nonperiodic => points.saturating_sub(3),
            },
        };
        // Two points and the way back are no closed curve.
        let spans = if points < 2 || (closed && points < 3) { 0 } else { spans };
        [spans, if spans == 0 { 0 } else { spans + usize::from(!closed) }]
    }
}

impl Curves {
    /// The primvar called `name`.
    pub fn primvar(&self, name: &str) -> Option<&Primvar> {
        self.primvars.iter().find(|primvar| primvar.name == name)
    }
    /// Joints of all curves: the number of values of a `Varying` primvar.
    pub fn joints(&self) -> usize {
        self.counts.iter().map(|count| self.basis.spans(*count as usize, self.wrap)[1]).sum()
    }
    /// Bytes held by the arrays.
    pub fn memory(&self) -> usize {
        let primvars = std::iter::once(&self.widths).chain(&self.primvars);
        self.points.len() * 12 * (1 + self.motion.len()) + self.counts.len() * 4 + primvars.map(Primvar::memory).sum::<usize>()
    }
}
