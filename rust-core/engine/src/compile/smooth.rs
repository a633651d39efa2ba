//! Trees of curves and points, kept from one compilation to the next.

use super::{
    bounds::Bounds,
    cut::{Cut, Laid},
    times,
};
use crate::{
    accel::{Blas, Care, Seen, Spheres},
    error::{Diagnostic, Error, Result},
    geometry::GeometryTable,
    scene::{CurveShape, Curves, PointShape, Points, Primvar, Scene},
};
use std::sync::{Arc, atomic::AtomicBool};

/// The tree of curves or points and what it was built from.
#[derive(Clone, Debug)]
pub(super) struct KeptSmooth {
    source: Source,
    pub(super) tree: Arc<Blas>,
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

/// What the tables have of a cut: points with radii, and pieces.
fn laid<'a>(cut: &Cut, table: &'a GeometryTable) -> (Spheres<'a>, &'a [u32]) {
    let Laid { coordinates, radii, pieces } = cut.laid.clone();
    (Spheres::Apart(table.points[coordinates].as_chunks().0, &table.radii[radii]), &table.pieces[pieces])
}

/// Trees of all curves and behind them all points, from the tables; those that are the very same as before are kept.
pub(super) fn build(
    scene: &Scene,
    cuts: &[Cut],
    table: &GeometryTable,
    previous: &[KeptSmooth],
    cancel: &AtomicBool,
) -> Result<Vec<KeptSmooth>> {
    let blurs = times::blurs(&scene.settings);
    let care = Care::of_scene(cuts.iter().map(|cut| cut.laid.pieces.len().max(cut.laid.radii.len())).sum());
    let mut built = Vec::with_capacity(cuts.len());
    for (curves, cut) in scene.curves.iter().zip(cuts) {
        let moves = blurs && !cut.keys.is_empty();
        if !moves && let Some(kept) = previous.iter().find(|kept| kept.tree.is_still() && kept.source.is_curves(curves)) {
            built.push(kept.clone());
            continue;
        }
        let seen = if curves.shape == CurveShape::Round { Seen::Solid } else { Seen::Facing };
        let (spheres, pieces) = laid(cut, table);
        let tree = match moves {
            true => Blas::of_moving_curves(cut.keys.clone(), pieces, seen, care, cancel),
            false => Blas::of_curves(spheres, pieces, seen, care, cancel),
        };
        let tree = tree.map_err(|_| Error::Cancelled)?;
        let source = Source::Curves(Curves { primvars: Vec::new(), ..curves.clone() });
        built.push(KeptSmooth { source, tree: Arc::new(tree) });
    }
    for (points, cut) in scene.points.iter().zip(&cuts[scene.curves.len()..]) {
        let moves = blurs && !cut.keys.is_empty();
        if !moves && let Some(kept) = previous.iter().find(|kept| kept.tree.is_still() && kept.source.is_points(points)) {
            built.push(kept.clone());
            continue;
        }
        let seen = if points.shape == PointShape::Sphere { Seen::Solid } else { Seen::Facing };
        let tree = match moves {
            true => Blas::of_moving_points(cut.keys.clone(), seen, care, cancel),
            false => Blas::of_points(laid(cut, table).0, seen, care, cancel),
        };
        let tree = tree.map_err(|_| Error::Cancelled)?;
        let source = Source::Points(Points { primvars: Vec::new(), ..points.clone() });
        built.push(KeptSmooth { source, tree: Arc::new(tree) });
    }
    Ok(built)
}

/// Bounds of spheres in their own space, at all times where they move.
pub(super) fn bounds(cut: &Cut, blurs: bool) -> Bounds {
    let mut bounds = Bounds::default();
    let keys = if blurs { cut.keys.as_slice() } else { &[] };
    for [x, y, z, radius] in keys.iter().flatten().chain(&cut.points).map(|point| point.map(f64::from)) {
        bounds.extend([x - radius, y - radius, z - radius]);
        bounds.extend([x + radius, y + radius, z + radius]);
    }
    bounds
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
