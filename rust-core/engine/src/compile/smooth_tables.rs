//! Curves and points as flat tables.

use super::{
    cut::Cut,
    smooth_primvars::{append_curve_primvars, append_point_primvars},
};
use crate::{
    error::{Diagnostic, Error, Result},
    geometry::{GeometryTable, InstanceRow, NONE, PrimitiveShape},
    scene::{CurveShape, PointShape, Scene},
};

/// Appends curves and points behind the meshes; gives their parts of their instances' rows.
pub(super) fn append(
    scene: &Scene,
    cuts: &[Cut],
    names: &[String],
    table: &mut GeometryTable,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<InstanceRow>> {
    if cuts.is_empty() {
        return Ok(Vec::new());
    }
    table.shapes = vec![PrimitiveShape::Triangle as u32; scene.meshes.len()];
    table.first_radius = (table.points.len() / 3) as u32;
    let mut rows = Vec::with_capacity(cuts.len());
    for (curves, cut) in scene.curves.iter().zip(cuts) {
        let round = curves.shape == CurveShape::Round;
        rows.push(append_cut(cut, if round { PrimitiveShape::Tube } else { PrimitiveShape::Ribbon }, table)?);
        append_curve_primvars(curves, cut, names, table, diagnostics);
    }
    for (points, cut) in scene.points.iter().zip(&cuts[scene.curves.len()..]) {
        let solid = points.shape == PointShape::Sphere;
        rows.push(append_cut(cut, if solid { PrimitiveShape::Sphere } else { PrimitiveShape::Disc }, table)?);
        append_point_primvars(points, names, table, diagnostics);
    }
    Ok(rows)
}

fn append_cut(cut: &Cut, shape: PrimitiveShape, table: &mut GeometryTable) -> Result<InstanceRow> {
    let first_point = table.points.len() / 3;
    if (first_point + cut.points.len()) * 3 >= i32::MAX as usize || cut.points.len() >= 1 << 30 {
        return Err(Error::setting("scene", "the scene has more points of curves than 2^31 table entries hold"));
    }
    let first_triangle = table.pieces.len() as u32;
    table.points.reserve(3 * cut.points.len());
    cut.points.iter().for_each(|point| table.points.extend_from_slice(&point[..3]));
    table.radii.extend(cut.points.iter().map(|point| point[3]));
    table.pieces.extend_from_slice(&cut.pieces);
    table.shapes.push(shape as u32);
    Ok(InstanceRow { first_triangle, first_point: first_point as u32, first_slot: NONE, ..InstanceRow::default() })
}
