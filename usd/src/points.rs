//! `Points` prims.

use crate::context::Context;
use crate::prim::Prim;
use crate::{mesh, primvar, strand_values};
use gonio::scene::{PointShape, Points};

/// Diameter where none is authored, local units, as Hydra has it.
const USUAL_WIDTH: f32 = 1.0;

/// Reads a prim of points; `None`, with a report, where there are none.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<Points> {
    let origin = prim.origin();
    let points = mesh::points(context, prim).unwrap_or_default();
    if points.is_empty() {
        context.once("points", "empty", &origin, || "the prim has no usable points".into());
        return None;
    }
    let elements = strand_values::Elements { uniform: 1, varying: points.len(), vertex: points.len() };
    let widths = primvar::widths(context, prim);
    let widths = strand_values::widths(context, prim, widths, &elements, USUAL_WIDTH);
    let normals = primvar::normals(context, prim).and_then(|normals| strand_values::fitting(context, prim, normals, &elements));
    let own = primvar::authored(context, prim).into_iter().filter(|primvar| primvar.name != "widths");
    let primvars = own.filter_map(|primvar| strand_values::fitting(context, prim, primvar, &elements)).collect();
    Some(Points { origin, points: points.into(), motion: Vec::new(), widths, normals, shape: PointShape::Sphere, primvars })
}
