//! Curves and points as flat tables.

use super::{
    cut::{Cut, Laid},
    smooth_primvars::{append_curve_primvars, append_point_primvars},
};
use crate::{
    error::{Diagnostic, Error, Result},
    geometry::{GeometryTable, InstanceRow, NONE, PrimitiveShape},
    scene::{CurveShape, PointShape, Scene},
};

/// Appends curves and points behind the meshes; gives their parts of their instances' rows. Of cuts that stand still the points are taken.
pub(super) fn append(
    scene: &Scene,
    cuts: &mut [Cut],
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
    let (of_curves, of_points) = cuts.split_at_mut(scene.curves.len());
    for (curves, cut) in scene.curves.iter().zip(of_curves) {
        let round = curves.shape == CurveShape::Round;
        append_curve_primvars(curves, cut, names, table, diagnostics);
        rows.push(append_cut(cut, if round { PrimitiveShape::Tube } else { PrimitiveShape::Ribbon }, table)?);
    }
    for (points, cut) in scene.points.iter().zip(of_points) {
        let solid = points.shape == PointShape::Sphere;
        append_point_primvars(points, names, table, diagnostics);
        rows.push(append_cut(cut, if solid { PrimitiveShape::Sphere } else { PrimitiveShape::Disc }, table)?);
    }
    Ok(rows)
}

fn append_cut(cut: &mut Cut, shape: PrimitiveShape, table: &mut GeometryTable) -> Result<InstanceRow> {
    let first_point = table.points.len() / 3;
    if (first_point + cut.points.len()) * 3 >= i32::MAX as usize || cut.points.len() >= 1 << 30 {
        return Err(Error::setting("scene", "the scene has more points of curves than 2^31 table entries hold"));
    }
    let first_triangle = table.pieces.len() as u32;
    let still = cut.keys.is_empty();
    if still {
        cut.places = Vec::new();
    }
    let begin = [table.points.len(), table.radii.len(), table.pieces.len()];
    cut.points.iter().for_each(|point| table.points.extend_from_slice(&point[..3]));
    table.radii.extend(cut.points.iter().map(|point| point[3]));
    table.pieces.extend_from_slice(&cut.pieces);
    table.shapes.push(shape as u32);
    let [coordinates, radii, pieces] = begin;
    cut.laid = Laid { coordinates: coordinates..table.points.len(), radii: radii..table.radii.len(), pieces: pieces..table.pieces.len() };
    if still {
        // The tables have them, and there may be millions.
        (cut.points, cut.pieces) = (Vec::new(), Vec::new());
    }
    Ok(InstanceRow { first_triangle, first_point: first_point as u32, first_slot: NONE, ..InstanceRow::default() })
}
