//! Curves and points: their trees, kept from one compilation to the next, and their part of the tables.

use super::{
    bounds::Bounds,
    cut::Cut,
    smooth_primvars::{append_curve_primvars, append_point_primvars},
};
use crate::{
    accel::{Blas, Care, Seen},
    error::{Diagnostic, Error, Result},
    geometry::{GeometryTable, InstanceRow, NONE, PrimitiveShape},
    scene::{CurveShape, Curves, PointShape, Points, Primvar, Scene},
};
use std::sync::{Arc, atomic::AtomicBool};

/// The tree of curves or points and what it was built from.
#[derive(Clone, Debug)]
pub(super) struct KeptSmooth {
    source: Source,
    pub(super) tree: Arc<Blas>,
    /// In the geometry's own space.
    pub(super) bounds: Bounds,
}

/// Curves or points without their primvars.
#[derive(Clone, Debug)]
enum Source {
    Curves(Curves),
    Points(Points),
}

fn same_widths(a: &Primvar, b: &Primvar) -> bool {
    Arc::ptr_eq(&a.values, &b.values) && a.interpolation == b.interpolation && a.indices == b.indices
}

impl Source {
    /// Whether curves have the very same arrays and words.
    fn is_curves(&self, curves: &Curves) -> bool {
        let Self::Curves(kept) = self else { return false };
        Arc::ptr_eq(&kept.points, &curves.points)
            && Arc::ptr_eq(&kept.counts, &curves.counts)
            && same_widths(&kept.widths, &curves.widths)
            && (kept.basis, kept.wrap, kept.shape) == (curves.basis, curves.wrap, curves.shape)
    }

    /// Whether points have the very same arrays and words.
    fn is_points(&self, points: &Points) -> bool {
        let Self::Points(kept) = self else { return false };
        Arc::ptr_eq(&kept.points, &points.points) && same_widths(&kept.widths, &points.widths) && kept.shape == points.shape
    }
}

/// Trees of all curves and behind them all points; those that are the very same as before are kept.
pub(super) fn build(scene: &Scene, cuts: &[Cut], previous: &[KeptSmooth], cancel: &AtomicBool) -> Result<Vec<KeptSmooth>> {
    let care = Care::of_scene(cuts.iter().map(|cut| cut.pieces.len().max(cut.points.len())).sum());
    let mut built = Vec::with_capacity(cuts.len());
    for (curves, cut) in scene.curves.iter().zip(cuts) {
        if let Some(kept) = previous.iter().find(|kept| kept.source.is_curves(curves)) {
            built.push(kept.clone());
            continue;
        }
        let seen = if curves.shape == CurveShape::Round { Seen::Solid } else { Seen::Facing };
        let tree = Blas::of_curves(&cut.points, &cut.pieces, seen, care, cancel).map_err(|_| Error::Cancelled)?;
        let source = Source::Curves(Curves { primvars: Vec::new(), ..curves.clone() });
        built.push(KeptSmooth { source, tree: Arc::new(tree), bounds: bounds(&cut.points) });
    }
    for (points, cut) in scene.points.iter().zip(&cuts[scene.curves.len()..]) {
        if let Some(kept) = previous.iter().find(|kept| kept.source.is_points(points)) {
            built.push(kept.clone());
            continue;
        }
        let seen = if points.shape == PointShape::Sphere { Seen::Solid } else { Seen::Facing };
        let tree = Blas::of_points(&cut.points, seen, care, cancel).map_err(|_| Error::Cancelled)?;
        let source = Source::Points(Points { primvars: Vec::new(), ..points.clone() });
        built.push(KeptSmooth { source, tree: Arc::new(tree), bounds: bounds(&cut.points) });
    }
    Ok(built)
}

/// Bounds of spheres.
fn bounds(points: &[[f32; 4]]) -> Bounds {
    let mut bounds = Bounds::default();
    for [x, y, z, radius] in points.iter().map(|point| point.map(f64::from)) {
        bounds.extend([x - radius, y - radius, z - radius]);
        bounds.extend([x + radius, y + radius, z + radius]);
    }
    bounds
}

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

/// Says what curves and points do not do as other surfaces do.
pub(super) fn report_emission(scene: &Scene, emits: impl Fn(usize) -> bool, diagnostics: &mut Vec<Diagnostic>) {
    for group in scene.instances.iter().filter(|group| group.geometry.mesh().is_none()) {
        if group.materials.iter().any(|material| emits(material.index())) {
            let message = "curves and points shine, but light is not sampled from them: rays find them by chance, and noise remains longer";
            diagnostics.push(Diagnostic::info(&group.origin, message));
        }
    }
}
