//! Meshes: what a `Mesh` prim says, as a source that is built into triangles later, without the interpreter.

use crate::build::{MeshSource, Surface};
use crate::context::Context;
use crate::options::Complexity;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::FromValue;
use crate::{primvar, subset};
use gonio::mesh::PolygonMesh;
use gonio::mesh::refine::{BoundaryInterpolation, Creases, FaceVaryingInterpolation, RefineOptions, Scheme, TriangleRule};
use gonio::scene::Dicing;
use pyo3::prelude::*;

/// Most faces that subdivision makes of one mesh; denser meshes are refined less.
const MAX_REFINED_FACES: usize = 1 << 22;

/// A mesh prim as read: the source and the prims of its slots, the mesh first.
#[derive(Debug)]
pub struct ReadMesh<'py> {
    /// What triangles are made of.
    pub source: MeshSource,
    /// The prims that slots look up their material at.
    pub slot_prims: Vec<Prim<'py>>,
}

/// Reads a `Mesh` prim; `None` where there is nothing to show or, with a report, nothing that can be used.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<ReadMesh<'py>> {
    let origin = prim.origin();
    let points = points(context, prim);
    let face_counts = context.get_authored::<Vec<i32>>(prim, "faceVertexCounts");
    let corners = context.get_authored::<Vec<i32>>(prim, "faceVertexIndices");
    let (Some(points), Some(face_counts), Some(corners)) = (points, face_counts, corners) else {
        context.once("mesh", "incomplete", &origin, || "the mesh has no usable points, faceVertexCounts or faceVertexIndices".into());
        return None;
    };
    if points.is_empty() || face_counts.is_empty() {
        context.once("mesh", "empty", &origin, || "the mesh has no points or faces".into());
        return None;
    }
    let mut polygons = match PolygonMesh::from_signed(points, &face_counts, &corners) {
        Ok(polygons) => polygons,
        Err(problem) => {
            context.warn(&origin, format!("{problem}; the mesh is left out"));
            return None;
        }
    };
    polygons.hole_faces = unsigned(context.get_authored::<Vec<i32>>(prim, "holeIndices"));
    polygons.left_handed = context.left_handed(prim);
    polygons.primvars = primvar::authored(context, prim);
    let (surface, normals) = surface(context, prim);
    polygons.primvars.extend(normals);
    let subsets = subset::read(context, prim, polygons.face_counts.len());
    let mut slot_prims = vec![prim.clone()];
    slot_prims.extend(subsets.prims);
    Some(ReadMesh { source: MeshSource { origin, polygons, surface, face_slots: subsets.face_slots }, slot_prims })
}

/// Negative indices become ones that are out of range, which the mesh's check reports.
fn unsigned(indices: Option<Vec<i32>>) -> Vec<u32> {
    indices.unwrap_or_default().into_iter().map(|index| u32::try_from(index).unwrap_or(u32::MAX)).collect()
}

/// The surface's kind, and the authored normals where they count: not on subdivision surfaces.
fn surface<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> (Surface, Option<gonio::mesh::FacePrimvar>) {
    let scheme = context.get_authored::<String>(prim, "subdivisionScheme").unwrap_or_else(|| "catmullClark".into());
    let scheme = match scheme.as_str() {
        "none" => None,
        "catmullClark" => Some(Scheme::CatmullClark),
        "loop" => Some(Scheme::Loop),
        "bilinear" => Some(Scheme::Bilinear),
        other => {
            context.warn(
                &prim.origin(),
                format!("subdivisionScheme is '{other}', expected catmullClark, loop, bilinear or none; none is used"),
            );
            None
        }
    };
    let Some(scheme) = scheme else { return (Surface::Polygons, primvar::normals(context, prim)) };
    let options = RefineOptions {
        scheme,
        level: context.options.complexity.levels(),
        boundary: boundary(context, prim),
        face_varying: face_varying(context, prim),
        triangles: triangle_rule(context, prim),
        max_faces: MAX_REFINED_FACES,
        ..RefineOptions::default()
    };
    // Triangles of pixels come from the levels that there are, by the camera when the scene is compiled.
    let dicing =
        (context.options.complexity == Complexity::Auto).then(|| Dicing { smooth: scheme != Scheme::Bilinear, ..Dicing::default() });
    (Surface::Subdivision(creases(context, prim), options, dicing), None)
}

fn boundary<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> BoundaryInterpolation {
    match context.get_authored::<String>(prim, "interpolateBoundary").as_deref() {
        Some("none") => BoundaryInterpolation::None,
        Some("edgeOnly") => BoundaryInterpolation::EdgeOnly,
        _ => BoundaryInterpolation::EdgeAndCorner,
    }
}

fn face_varying<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> FaceVaryingInterpolation {
    match context.get_authored::<String>(prim, "faceVaryingLinearInterpolation").as_deref() {
        Some("none") => FaceVaryingInterpolation::None,
        Some("cornersOnly") => FaceVaryingInterpolation::CornersOnly,
        Some("cornersPlus2") => FaceVaryingInterpolation::CornersPlus2,
        Some("boundaries") => FaceVaryingInterpolation::Boundaries,
        Some("all") => FaceVaryingInterpolation::All,
        _ => FaceVaryingInterpolation::CornersPlus1,
    }
}

fn triangle_rule<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> TriangleRule {
    match context.get_authored::<String>(prim, "triangleSubdivisionRule").as_deref() {
        Some("smooth") => TriangleRule::Smooth,
        _ => TriangleRule::CatmullClark,
    }
}

fn creases<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Creases {
    Creases {
        crease_indices: unsigned(context.get_authored(prim, "creaseIndices")),
        crease_lengths: unsigned(context.get_authored(prim, "creaseLengths")),
        crease_sharpnesses: context.get_authored(prim, "creaseSharpnesses").unwrap_or_default(),
        corner_indices: unsigned(context.get_authored(prim, "cornerIndices")),
        corner_sharpnesses: context.get_authored(prim, "cornerSharpnesses").unwrap_or_default(),
    }
}

/// The points of a prim at the time that is read.
pub(crate) fn points<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Vec<[f32; 3]>> {
    if prim.has_authored("velocities") { moved_points(context, prim) } else { context.get_authored(prim, "points") }
}

/// Points taken on by their velocities and accelerations from the sample before the time that is read.
fn moved_points<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Vec<[f32; 3]>> {
    let read = || -> PyResult<Option<Vec<[f32; 3]>>> {
        let mesh = Module::UsdGeom.wrap("PointBased", prim.object())?;
        let points = mesh.call_method1("ComputePointsAtTime", (&context.time, &context.time))?;
        Ok(Vec::from_value(&points))
    };
    let result = read();
    context
        .attempt_at(prim, "the points cannot be had at the time, they stand where they were", result)
        .flatten()
        .filter(|points| !points.is_empty())
        .or_else(|| context.get_authored(prim, "points"))
}
