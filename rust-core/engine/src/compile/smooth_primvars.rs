//! Primvars of curves and points in the value tables, and what is known of strands of hair by reserved names.

use super::{
    cut::{CurveStart, Cut, place_of, starts, sum},
    primvars::{Elements, append, problem},
};
use crate::{
    error::Diagnostic,
    geometry::{FIRST_PIECE, GeometryTable, LAST_PIECE, NONE, PrimvarKind, PrimvarRef},
    scene::{Curves, Points, Primvar, PrimvarInterpolation},
};

/// Appends the columns of curves: the normals, which they have none of, and the named ones.
pub(super) fn append_curve_primvars(
    curves: &Curves,
    cut: &Cut,
    names: &[String],
    table: &mut GeometryTable,
    diagnostics: &mut Vec<Diagnostic>,
) {
    table.primvars.extend(PrimvarRef::ABSENT.words());
    let starts = starts(curves);
    for name in names {
        let reference = match (curves.primvar(name), name.strip_prefix("hair:")) {
            (Some(primvar), _) => match wrong(curves, primvar) {
                None => append_along(curves, &starts, cut, primvar, table),
                Some(message) => {
                    diagnostics.push(Diagnostic::warning(&curves.origin, format!("{message}; it is ignored")));
                    PrimvarRef::ABSENT
                }
            },
            (None, Some(value)) => append_hair(curves, &starts, cut, value, table),
            (None, None) => PrimvarRef::ABSENT,
        };
        table.primvars.extend(reference.words());
    }
}

/// Whether some value by these names is found by where on its curve a point lies.
pub(super) fn asks_places(curves: &Curves, names: &[String]) -> bool {
    names.iter().any(|name| match curves.primvar(name) {
        Some(primvar) => primvar.interpolation != PrimvarInterpolation::Constant,
        None => matches!(name.as_str(), "hair:random" | "hair:length" | "hair:intercept"),
    })
}

/// Appends the columns of points.
pub(super) fn append_point_primvars(points: &Points, names: &[String], table: &mut GeometryTable, diagnostics: &mut Vec<Diagnostic>) {
    let elements = Elements { uniform: 1, points: points.points.len(), corners: points.points.len() };
    let normals = points.normals.as_ref().filter(|normals| normals.components == 3);
    let named = names.iter().map(|name| points.primvar(name));
    for (column, primvar) in std::iter::once(normals).chain(named).enumerate() {
        let reference = match primvar.map(|primvar| (primvar, problem(primvar, elements))) {
            // One value for all points is what uniform ones are.
            Some((primvar, None)) if primvar.interpolation == PrimvarInterpolation::Uniform => {
                append(&Primvar { interpolation: PrimvarInterpolation::Constant, ..primvar.clone() }, table)
            }
            Some((primvar, None)) => append(primvar, table),
            Some((_, Some(message))) => {
                diagnostics.push(Diagnostic::warning(&points.origin, format!("{message}; it is ignored")));
                PrimvarRef::ABSENT
            }
            None => PrimvarRef::ABSENT,
        };
        table.any_normals |= column == 0 && reference.kind != PrimvarKind::Absent;
        table.primvars.extend(reference.words());
    }
}

/// What is wrong with a primvar of curves, if anything.
fn wrong(curves: &Curves, primvar: &Primvar) -> Option<String> {
    let expected = match primvar.interpolation {
        PrimvarInterpolation::Varying => curves.joints(),
        _ => curves.points.len(),
    };
    problem(primvar, Elements { uniform: curves.counts.len(), points: expected, corners: curves.points.len() })
}

/// Appends a primvar of curves: values along a curve are worked out where it is cut.
fn append_along(curves: &Curves, starts: &[CurveStart], cut: &Cut, primvar: &Primvar, table: &mut GeometryTable) -> PrimvarRef {
    match primvar.interpolation {
        PrimvarInterpolation::Constant => append(primvar, table),
        PrimvarInterpolation::Uniform => {
            let components = usize::from(primvar.components);
            let number = |curve: u32| (place_of(primvar, curve as usize) / components.max(1)) as u32;
            append_uniform(cut, &primvar.values, primvar.components, number, table)
        }
        _ => {
            let first_value = table.values.len() as u32;
            for place in &cut.places {
                let values = place.values(curves, &starts[place.curve as usize], primvar);
                table.values.extend((0..usize::from(primvar.components)).map(|component| sum(primvar, &values, component)));
            }
            vertex(primvar.components, first_value)
        }
    }
}

fn vertex(components: u8, first_value: u32) -> PrimvarRef {
    PrimvarRef { kind: PrimvarKind::Vertex, components: u32::from(components), first_value, first_index: NONE }
}

/// Values one a curve, found by the pieces.
fn append_uniform(cut: &Cut, values: &[f32], components: u8, number: impl Fn(u32) -> u32, table: &mut GeometryTable) -> PrimvarRef {
    let (first_value, first_index) = (table.values.len() as u32, table.value_indices.len() as u32);
    table.values.extend_from_slice(values);
    table.value_indices.extend(cut.pieces.iter().map(|piece| number(cut.places[point_of(*piece)].curve)));
    PrimvarRef { kind: PrimvarKind::Uniform, components: u32::from(components), first_value, first_index }
}

/// The first point of a piece.
fn point_of(piece: u32) -> usize {
    (piece & !(FIRST_PIECE | LAST_PIECE)) as usize
}

/// Appends what is known of strands by the name behind `hair:`.
fn append_hair(curves: &Curves, starts: &[CurveStart], cut: &Cut, name: &str, table: &mut GeometryTable) -> PrimvarRef {
    let first_value = table.values.len() as u32;
    match name {
        "strand" => append(&Primvar::constant("hair:strand", 1.0), table),
        "random" => {
            let values: Vec<f32> = (0..curves.counts.len() as u32).map(random_of).collect();
            append_uniform(cut, &values, 1, |curve| curve, table)
        }
        "length" => {
            let mut lengths = vec![0.0f32; curves.counts.len()];
            for first in cut.pieces.iter().map(|piece| point_of(*piece)) {
                let (a, b) = (cut.points[first], cut.points[first + 1]);
                let squared: f32 = (0..3).map(|k| (b[k] - a[k]).powi(2)).sum();
                lengths[cut.places[first].curve as usize] += squared.sqrt();
            }
            append_uniform(cut, &lengths, 1, |curve| curve, table)
        }
        "thickness" => {
            table.values.extend(cut.points.iter().map(|point| 2.0 * point[3]));
            vertex(1, first_value)
        }
        "intercept" => {
            let share = |place: &super::cut::Place| {
                let [spans, _] = curves.basis.spans(starts[place.curve as usize].count, curves.wrap);
                (place.span as f32 + place.t) / spans.max(1) as f32
            };
            table.values.extend(cut.places.iter().map(share));
            vertex(1, first_value)
        }
        "tangent" => {
            let mut tangents = vec![[0.0f32; 3]; cut.points.len()];
            for first in cut.pieces.iter().map(|piece| point_of(*piece)) {
                let (a, b) = (cut.points[first], cut.points[first + 1]);
                for end in [first, first + 1] {
                    (0..3).for_each(|k| tangents[end][k] += b[k] - a[k]);
                }
            }
            table.values.extend(tangents.iter().flatten());
            vertex(3, first_value)
        }
        _ => PrimvarRef::ABSENT,
    }
}

/// A number from 0 to 1 for a curve, which Cycles has as well: Bob Jenkins' lookup3 of its number and zero.
fn random_of(curve: u32) -> f32 {
    let start = 0xdead_beefu32.wrapping_add(2 << 2).wrapping_add(13);
    let [mut a, mut b, mut c] = [start.wrapping_add(curve), start, start];
    let mix = |x: &mut u32, y: u32, by: u32| *x = (*x ^ y).wrapping_sub(y.rotate_left(by));
    mix(&mut c, b, 14);
    mix(&mut a, c, 11);
    mix(&mut b, a, 25);
    mix(&mut c, b, 16);
    mix(&mut a, c, 4);
    mix(&mut b, a, 14);
    mix(&mut c, b, 24);
    c as f32 / u32::MAX as f32
}
