//! NURBS curves, cut into straight pieces.

use super::Lines;
use crate::context::Context;
use crate::prim::Prim;
use gonio::mesh::Interpolation;
use gonio::scene::{CurveBasis, CurveWrap};

/// Pieces between two knots.
const PIECES: usize = 8;
/// Highest order that is read.
const HIGHEST: usize = 32;

/// One curve's numbers.
struct Spline<'a> {
    order: usize,
    knots: &'a [f64],
    range: [f64; 2],
}

/// The curves through points on the splines; widths go along, other values of points are left out.
pub(super) fn tessellated<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, lines: Lines) -> Option<Lines> {
    let orders = context.get_authored::<Vec<i32>>(prim, "order").unwrap_or_default();
    let knots = context.get_authored::<Vec<f32>>(prim, "knots").unwrap_or_default();
    let knots: Vec<f64> = knots.into_iter().map(f64::from).collect();
    let weights = context.get_authored::<Vec<f32>>(prim, "pointWeights").filter(|weights| weights.len() == lines.points.len());
    let order = |curve: usize| orders.get(curve).copied().and_then(|order| usize::try_from(order).ok()).unwrap_or(4);
    let needed: usize = lines.counts.iter().enumerate().map(|(curve, count)| *count as usize + order(curve)).sum();
    let is_sound =
        (0..lines.counts.len()).all(|curve| (2..=HIGHEST).contains(&order(curve)) && order(curve) <= lines.counts[curve] as usize);
    if !is_sound || knots.len() != needed || knots.iter().any(|knot| !knot.is_finite()) {
        context.warn(&prim.origin(), format!("{} knots, expected {needed} for the curves' orders; the curves are left out", knots.len()));
        return None;
    }
    let widths = lines.widths.as_ref().filter(|widths| widths.interpolation == Interpolation::Vertex && widths.components == 1);
    let width = |point: usize| widths.and_then(|widths| widths.at(point)).map_or(1.0, |width| f64::from(width[0]));
    let (mut points, mut counts, mut radii) = (Vec::new(), Vec::new(), Vec::new());
    let (mut first, mut knot) = (0, 0);
    for (curve, count) in lines.counts.iter().map(|count| *count as usize).enumerate() {
        let order = order(curve);
        let own = &knots[knot..knot + count + order];
        let spline = Spline { order, knots: own, range: [own[order - 1], own[count]] };
        // Homogeneous coordinates, and the width.
        let control: Vec<[f64; 5]> = (first..first + count)
            .map(|at| {
                let [x, y, z] = lines.points[at].map(f64::from);
                let weight = weights.as_ref().map_or(1.0, |weights| f64::from(weights[at]));
                [x * weight, y * weight, z * weight, width(at) * weight, weight]
            })
            .collect();
        let pieces = (count + 1 - order) * PIECES;
        for piece in 0..=pieces {
            let [low, high] = spline.range;
            let [x, y, z, width, weight] = spline.at(&control, low + (high - low) * piece as f64 / pieces as f64);
            let weight = if weight == 0.0 { 1.0 } else { weight };
            points.push([x, y, z].map(|x| (x / weight) as f32));
            radii.push((width / weight) as f32);
        }
        counts.push(pieces as u32 + 1);
        (first, knot) = (first + count, knot + count + order);
    }
    let mut lines = Lines { points, counts, basis: CurveBasis::Linear, wrap: CurveWrap::Nonperiodic, ..lines };
    if let Some(widths) = lines.widths.as_mut().filter(|widths| widths.interpolation == Interpolation::Vertex) {
        (widths.values, widths.indices) = (radii, None);
    }
    let is_kept = |interpolation| matches!(interpolation, Interpolation::Constant | Interpolation::Uniform);
    for primvar in lines.primvars.iter().filter(|primvar| !is_kept(primvar.interpolation)) {
        context.unsupported(&format!("primvar '{}' that varies along NurbsCurves", primvar.name), &prim.origin());
    }
    lines.primvars.retain(|primvar| is_kept(primvar.interpolation));
    Some(lines)
}

impl Spline<'_> {
    /// The value at a parameter in the range (de Boor's algorithm).
    fn at(&self, control: &[[f64; 5]], t: f64) -> [f64; 5] {
        let degree = self.order - 1;
        // The last span that begins before t and is not empty; the range's end belongs to the last one.
        let begins = |span: usize| self.knots[span] <= t && self.knots[span] < self.knots[span + 1];
        let span = (degree..control.len()).rev().find(|&span| begins(span)).unwrap_or(degree);
        let mut values: Vec<[f64; 5]> = control[span - degree..=span].to_vec();
        for level in 1..=degree {
            for at in (level..=degree).rev() {
                let knot = at + span - degree;
                let [low, high] = [self.knots[knot], self.knots[knot + degree + 1 - level]];
                let share = if high > low { (t - low) / (high - low) } else { 0.0 };
                values[at] = std::array::from_fn(|axis| values[at - 1][axis] * (1.0 - share) + values[at][axis] * share);
            }
        }
        values[degree]
    }
}
