//! Values of curves and points, checked against the number of elements that they belong to.

use crate::context::Context;
use crate::prim::Prim;
use gonio::mesh::{FacePrimvar, Interpolation};
use gonio::scene::{Primvar, PrimvarInterpolation};

/// How many values an interpolation has.
#[derive(Clone, Copy, Debug)]
pub struct Elements {
    /// Curves; 1 for points.
    pub uniform: usize,
    /// Joints of spans, or points.
    pub varying: usize,
    /// Points.
    pub vertex: usize,
}

impl Elements {
    fn of(&self, interpolation: Interpolation) -> (PrimvarInterpolation, usize) {
        match interpolation {
            Interpolation::Constant => (PrimvarInterpolation::Constant, 1),
            Interpolation::Uniform => (PrimvarInterpolation::Uniform, self.uniform),
            // Curves have no faces: what varies over faces varies along them.
            Interpolation::Varying | Interpolation::FaceVarying => (PrimvarInterpolation::Varying, self.varying),
            Interpolation::Vertex => (PrimvarInterpolation::Vertex, self.vertex),
        }
    }
}

/// The primvar as the scene has it; `None`, with a report, where its number of values does not fit.
pub fn fitting<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, primvar: FacePrimvar, elements: &Elements) -> Option<Primvar> {
    if primvar.components > 4 {
        return None;
    }
    let (interpolation, expected) = elements.of(primvar.interpolation);
    let count = primvar.element_count() as u32;
    let found = primvar.place_count();
    if found != expected || primvar.indices.iter().flatten().any(|index| *index >= count) {
        let name = &primvar.name;
        let what =
            if found == expected { "has indices out of range".to_owned() } else { format!("has {found} values, expected {expected}") };
        context.warn(&prim.origin(), format!("primvar '{name}' {what}; it is left out"));
        return None;
    }
    Some(Primvar {
        name: primvar.name,
        interpolation,
        components: primvar.components as u8,
        values: primvar.values.into(),
        indices: primvar.indices.map(Into::into),
    })
}

/// Diameters; `usual` for all where there are none that fit.
pub fn widths<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    authored: Option<FacePrimvar>,
    elements: &Elements,
    usual: f32,
) -> Primvar {
    let found = authored.filter(|widths| widths.components == 1).and_then(|widths| {
        // A single value is meant for all, whatever its interpolation says.
        let interpolation = if widths.place_count() == 1 { Interpolation::Constant } else { widths.interpolation };
        fitting(context, prim, FacePrimvar { interpolation, ..widths }, elements)
    });
    found.unwrap_or_else(|| {
        context.once("widths", "missing", &prim.origin(), || format!("there are no widths that fit; {usual} is used"));
        Primvar::constant("widths", usual)
    })
}
