//! Curves: `BasisCurves`, `HermiteCurves` and `NurbsCurves` prims.

mod nurbs;

use crate::context::Context;
use crate::prim::Prim;
use crate::{mesh, primvar, strand_values};
use gonio::mesh::{FacePrimvar, Interpolation};
use gonio::scene::{CurveBasis, CurveShape, CurveWrap, Curves};

/// Greatest diameter where none is authored, local units, as Hydra has it.
const USUAL_WIDTH: f32 = 1.0;
/// Greatest share of the curves' extent that it may be: hair is often written without widths, and in metres.
const USUAL_SHARE: f32 = 1.0 / 400.0;

/// Whether prims of this type are curves.
pub fn is_curves(type_name: &str) -> bool {
    matches!(type_name, "BasisCurves" | "HermiteCurves" | "NurbsCurves")
}

/// Points and how many of them each curve has; widths and primvars are still those of the prim.
#[derive(Debug, Default)]
struct Lines {
    points: Vec<[f32; 3]>,
    counts: Vec<u32>,
    basis: CurveBasis,
    wrap: CurveWrap,
    widths: Option<FacePrimvar>,
    primvars: Vec<FacePrimvar>,
}

/// Reads a prim of curves; `None`, with a report, where there is nothing to show.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, type_name: &str) -> Option<Curves> {
    let origin = prim.origin();
    let points = mesh::points(context, prim).unwrap_or_default();
    let counts = context.get_authored::<Vec<i32>>(prim, "curveVertexCounts").unwrap_or_default();
    let counts: Vec<u32> = counts.into_iter().map(|count| u32::try_from(count).unwrap_or(0)).collect();
    let sum: u64 = counts.iter().map(|count| u64::from(*count)).sum();
    if points.is_empty() || sum == 0 {
        context.once("curves", "empty", &origin, || "the curves have no usable points or curveVertexCounts".into());
        return None;
    }
    if sum != points.len() as u64 {
        context.warn(&origin, format!("curveVertexCounts add up to {sum}, expected {} points; the curves are left out", points.len()));
        return None;
    }
    let widths = primvar::widths(context, prim);
    let primvars = primvar::authored(context, prim).into_iter().filter(|primvar| primvar.name != "widths").collect();
    let lines = Lines { points, counts, widths, primvars, ..Lines::default() };
    let lines = match type_name {
        "HermiteCurves" => hermite(context, prim, lines)?,
        "NurbsCurves" => nurbs::spans(context, prim, lines)?,
        _ => basis(context, prim, lines),
    };
    Some(finished(context, prim, lines))
}

/// Type, basis and wrap as authored.
fn basis<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, lines: Lines) -> Lines {
    let mut token = |name: &str, usual: &str| context.get_authored::<String>(prim, name).unwrap_or_else(|| usual.to_owned());
    let (kind, basis, wrap) = (token("type", "cubic"), token("basis", "bezier"), token("wrap", "nonperiodic"));
    let basis = match (kind.as_str(), basis.as_str()) {
        ("linear", _) => CurveBasis::Linear,
        ("cubic", "bezier") => CurveBasis::Bezier,
        ("cubic", "bspline") => CurveBasis::BSpline,
        ("cubic", "catmullRom") => CurveBasis::CatmullRom,
        (kind, basis) => {
            context.unsupported(&format!("curves of type {kind} and basis {basis}"), &prim.origin());
            CurveBasis::Linear
        }
    };
    let wrap = match wrap.as_str() {
        "periodic" => CurveWrap::Periodic,
        "pinned" => CurveWrap::Pinned,
        _ => CurveWrap::Nonperiodic,
    };
    Lines { basis, wrap, ..lines }
}

/// Hermite curves as Bézier spans: points are their joints.
#[allow(clippy::needless_range_loop, reason = "a range of two arrays side by side")]
fn hermite<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, lines: Lines) -> Option<Lines> {
    let tangents = context.get_authored::<Vec<[f32; 3]>>(prim, "tangents").unwrap_or_default();
    if tangents.len() != lines.points.len() {
        let found = tangents.len();
        context.warn(&prim.origin(), format!("{found} tangents, expected {}; the curves are left out", lines.points.len()));
        return None;
    }
    let joints: Vec<_> = lines.points.iter().zip(&tangents).collect();
    let (mut points, mut counts, mut rest) = (Vec::new(), Vec::new(), joints.as_slice());
    for count in &lines.counts {
        let (curve, after) = rest.split_at((*count as usize).min(rest.len()));
        for (at, (point, tangent)) in curve.iter().enumerate() {
            let third = |sign: f32| std::array::from_fn(|axis| point[axis] + tangent[axis] * sign / 3.0);
            if at > 0 {
                points.push(third(-1.0));
            }
            points.push(**point);
            if at + 1 < curve.len() {
                points.push(third(1.0));
            }
        }
        counts.push((3 * curve.len() as u32).saturating_sub(2));
        rest = after;
    }
    let mut lines = Lines { points, counts, basis: CurveBasis::Bezier, ..lines };
    for primvar in lines.primvars.iter_mut().chain(&mut lines.widths).filter(|primvar| primvar.interpolation == Interpolation::Vertex) {
        primvar.interpolation = Interpolation::Varying;
    }
    Some(lines)
}

/// The scene's curves; values that do not fit are left out, with a report.
fn finished<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, lines: Lines) -> Curves {
    let origin = prim.origin();
    // Ribbons that lie in the surface of something have normals; these face the ray instead.
    let is_ribbon = prim.has_authored("normals") || prim.has_authored("primvars:normals");
    if is_ribbon {
        context.unsupported("normals of curves (flat curves face each ray)", &origin);
    }
    let shape = if is_ribbon { CurveShape::Ribbon } else { CurveShape::Round };
    let mut curves = Curves {
        origin,
        points: lines.points.into(),
        counts: lines.counts.into(),
        basis: lines.basis,
        wrap: lines.wrap,
        shape,
        ..Curves::default()
    };
    let elements = strand_values::Elements { uniform: curves.counts.len(), varying: curves.joints(), vertex: curves.points.len() };
    let usual = USUAL_WIDTH.min(USUAL_SHARE * extent(&curves.points));
    curves.widths = strand_values::widths(context, prim, lines.widths, &elements, if usual > 0.0 { usual } else { USUAL_WIDTH });
    curves.primvars = lines.primvars.into_iter().filter_map(|primvar| strand_values::fitting(context, prim, primvar, &elements)).collect();
    curves
}

/// The diagonal of the box around points.
fn extent(points: &[[f32; 3]]) -> f32 {
    let mut square = 0.0;
    for axis in 0..3 {
        let least = points.iter().map(|point| point[axis]).fold(f32::INFINITY, f32::min);
        let most = points.iter().map(|point| point[axis]).fold(f32::NEG_INFINITY, f32::max);
        square += (most - least).powi(2);
    }
    if square.is_finite() { square.sqrt() } else { 0.0 }
}
