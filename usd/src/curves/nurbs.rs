//! NURBS curves as Bézier spans: exact for polynomials up to the third degree, else with the curve's own points and tangents at joints that lie
//! close together.

use super::Lines;
use crate::context::Context;
use crate::prim::Prim;
use crate::vt::FloatArray;
use gonio::mesh::{FacePrimvar, Interpolation};
use gonio::scene::{CurveBasis, CurveWrap};

/// Most and fewest spans between two knots, and about as many in a curve of few knots. They do not depend on points, which may move.
const SPANS: [usize; 3] = [32, 8, 64];
/// Highest order that is read.
const HIGHEST: usize = 32;

/// One curve's numbers.
struct Spline<'a> {
    order: usize,
    knots: &'a [f64],
    /// Of each control point: values times the weight, and the weight itself.
    control: Vec<Vec<f64>>,
}

/// A joint of the spans that are made.
struct Joint {
    /// Parameter, and the knot at or before it.
    t: f64,
    knot: usize,
}

/// The curves with all values that points have; what varies over knots is linear between them.
pub(super) fn spans<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, lines: Lines) -> Option<Lines> {
    let orders = context.get_authored::<Vec<i32>>(prim, "order").unwrap_or_default();
    let order = |curve: usize| orders.get(curve).copied().and_then(|order| usize::try_from(order).ok()).unwrap_or(4);
    let knots = knots(context, prim, &lines, &order)?;
    let ranges = context.get_authored::<FloatArray>(prim, "ranges").filter(|ranges| ranges.components == 2);
    let range = |curve: usize| ranges.as_ref()?.values.as_chunks::<2>().0.get(curve).map(|range| range.map(f64::from));
    let weights = context.get_authored::<Vec<f32>>(prim, "pointWeights").filter(|weights| weights.len() == lines.points.len());
    let mut values = Carried::new(&lines);
    let (mut points, mut counts) = (Vec::new(), Vec::new());
    let (mut first, mut knot) = (0, 0);
    for (curve, count) in lines.counts.iter().map(|count| *count as usize).enumerate() {
        let order = order(curve);
        let weight = |at: usize| weights.as_ref().map_or(1.0, |weights| f64::from(weights[at]));
        let control = (first..first + count).map(|at| values.control(&lines.points[at], at, weight(at))).collect();
        let spline = Spline { order, knots: &knots[knot..knot + count + order], control };
        let joints = spline.joints(range(curve));
        for (number, pair) in joints.windows(2).enumerate() {
            let [start, end] = [&pair[0], &pair[1]].map(|joint| spline.at(pair[0].knot, joint.t));
            let third = (pair[1].t - pair[0].t) / 3.0;
            let along = |(value, slope): &(Vec<f64>, Vec<f64>), way: f64| value.iter().zip(slope).map(|(x, d)| x + d * way).collect();
            let rows: [Vec<f64>; 4] = [along(&start, 0.0), along(&start, third), along(&end, -third), along(&end, 0.0)];
            // A joint stands once.
            for row in rows.iter().skip(usize::from(number > 0)) {
                points.push([row[0], row[1], row[2]].map(|x| x as f32));
                values.push(&row[3..]);
            }
        }
        joints.iter().for_each(|joint| values.push_at_knots(&spline, joint));
        counts.push((3 * joints.len()).saturating_sub(2) as u32);
        values.finish_curve(count + 2 - order);
        (first, knot) = (first + count, knot + count + order);
    }
    let lines = Lines { points, counts, basis: CurveBasis::Bezier, wrap: CurveWrap::Nonperiodic, ..lines };
    Some(values.put(lines))
}

/// The knots of all curves; `None`, with a report, where they do not fit. Modelling programs leave out the first and the last of each curve,
/// which change nothing but where they are counted.
fn knots<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, lines: &Lines, order: &dyn Fn(usize) -> usize) -> Option<Vec<f64>> {
    let stated = context.get_authored::<Vec<f32>>(prim, "knots").unwrap_or_default();
    let mut knots: Vec<f64> = stated.into_iter().map(f64::from).collect();
    let sizes: Vec<usize> = lines.counts.iter().enumerate().map(|(curve, count)| *count as usize + order(curve)).collect();
    let needed: usize = sizes.iter().sum();
    let is_sound = (0..sizes.len()).all(|curve| (2..=HIGHEST).contains(&order(curve)) && order(curve) <= lines.counts[curve] as usize);
    if is_sound && knots.len() + 2 * sizes.len() == needed {
        let mut rest = knots.as_slice();
        let mut filled = Vec::with_capacity(needed);
        for size in &sizes {
            let (own, after) = rest.split_at(size - 2);
            filled.extend(own.first().into_iter().chain(own).chain(own.last()));
            rest = after;
        }
        knots = filled;
    }
    let mut first = 0;
    let rises = sizes.iter().all(|size| {
        let own = knots.get(first..first + size).unwrap_or_default();
        first += size;
        own.windows(2).all(|pair| pair[0] <= pair[1])
    });
    if !is_sound || knots.len() != needed || knots.iter().any(|knot| !knot.is_finite()) {
        context.warn(&prim.origin(), format!("{} knots, expected {needed} for the curves' orders; the curves are left out", knots.len()));
        return None;
    }
    if !rises {
        context.warn(&prim.origin(), "the knots of a curve go back; the curves are left out");
        return None;
    }
    Some(knots)
}

impl Spline<'_> {
    /// Joints from the one end of what is shown to the other, several between two knots.
    fn joints(&self, range: Option<[f64; 2]>) -> Vec<Joint> {
        let whole = [self.knots[self.order - 1], self.knots[self.control.len()]];
        let [low, high] = range.map_or(whole, |[low, high]| [low.max(whole[0]), high.min(whole[1])]);
        // A range that holds nothing is taken for none.
        let [low, high] = if low < high { [low, high] } else { whole };
        let shown = (self.order - 1..self.control.len()).filter_map(|knot| {
            let [start, end] = [self.knots[knot].max(low), self.knots[knot + 1].min(high)];
            (start < end).then_some((knot, start, end))
        });
        let shown: Vec<(usize, f64, f64)> = shown.collect();
        let [most, fewest, all] = SPANS;
        let spans = if self.order == 2 { 1 } else { (all / shown.len().max(1)).clamp(fewest, most) };
        let mut joints = Vec::with_capacity(shown.len() * spans + 1);
        for (knot, start, end) in &shown {
            joints.extend((0..spans).map(|span| Joint { t: start + (end - start) * span as f64 / spans as f64, knot: *knot }));
        }
        joints.extend(shown.last().map(|(knot, _, end)| Joint { t: *end, knot: *knot }));
        joints
    }

    /// Values and their derivatives at a parameter by the span that begins at a knot (de Boor's algorithm).
    fn at(&self, span: usize, t: f64) -> (Vec<f64>, Vec<f64>) {
        let degree = self.order - 1;
        let mut rows = self.control[span - degree..=span].to_vec();
        let mut slope = Vec::new();
        for level in 1..=degree {
            if level == degree {
                let width = self.knots[span + 1] - self.knots[span];
                slope = rows[degree].iter().zip(&rows[degree - 1]).map(|(b, a)| degree as f64 * (b - a) / width).collect();
            }
            for at in (level..=degree).rev() {
                let knot = at + span - degree;
                let [low, high] = [self.knots[knot], self.knots[knot + degree + 1 - level]];
                let share = if high > low { (t - low) / (high - low) } else { 0.0 };
                rows[at] = rows[at - 1].iter().zip(&rows[at]).map(|(a, b)| a * (1.0 - share) + b * share).collect();
            }
        }
        let mut values = rows.swap_remove(degree);
        let (weight, bend) = (values.pop().unwrap_or(1.0), slope.pop().unwrap_or(0.0));
        let weight = if weight == 0.0 { 1.0 } else { weight };
        values.iter_mut().for_each(|value| *value /= weight);
        // The quotient rule.
        slope.iter_mut().zip(&values).for_each(|(slope, value)| *slope = (*slope - bend * value) / weight);
        (values, slope)
    }
}

/// Values that go along with the points, on their way from the control points to those of the spans.
struct Carried {
    /// Those that control points have, or knots, with the new values so far; others stay as they are.
    of_points: Vec<(FacePrimvar, Vec<f32>)>,
    of_knots: Vec<(FacePrimvar, Vec<f32>)>,
    /// Knots with a value of the curves before.
    knots: usize,
}

impl Carried {
    fn new(lines: &Lines) -> Self {
        let all = || lines.widths.iter().chain(&lines.primvars);
        let of_points =
            all().filter(|primvar| primvar.interpolation == Interpolation::Vertex && primvar.place_count() == lines.points.len());
        let is_of_knots = |primvar: &&FacePrimvar| matches!(primvar.interpolation, Interpolation::Varying | Interpolation::FaceVarying);
        let begin = |primvar: &FacePrimvar| (primvar.clone(), Vec::new());
        Self { of_points: of_points.map(begin).collect(), of_knots: all().filter(is_of_knots).map(begin).collect(), knots: 0 }
    }

    /// A control point in homogeneous coordinates, its values among them.
    fn control(&self, point: &[f32; 3], at: usize, weight: f64) -> Vec<f64> {
        let values = self.of_points.iter().flat_map(|(primvar, _)| {
            let value = primvar.at(at).unwrap_or_default();
            (0..primvar.components).map(move |component| value.get(component).copied().unwrap_or_default())
        });
        point.iter().copied().chain(values).map(|x| f64::from(x) * weight).chain([weight]).collect()
    }

    /// Takes the values of a new point.
    fn push(&mut self, mut row: &[f64]) {
        for (primvar, values) in &mut self.of_points {
            let (own, rest) = row.split_at(primvar.components);
            values.extend(own.iter().map(|x| *x as f32));
            row = rest;
        }
    }

    /// Takes the values of a joint between knots that have some.
    fn push_at_knots(&mut self, spline: &Spline<'_>, joint: &Joint) {
        let [low, high] = [spline.knots[joint.knot], spline.knots[joint.knot + 1]];
        let share = if high > low { ((joint.t - low) / (high - low)) as f32 } else { 0.0 };
        let place = self.knots + joint.knot + 1 - spline.order;
        for (primvar, values) in &mut self.of_knots {
            let (Some(a), Some(b)) = (primvar.at(place), primvar.at(place + 1)) else { continue };
            values.extend(a.iter().zip(b).map(|(a, b)| a + (b - a) * share));
        }
    }

    /// So many knots of a curve had values.
    fn finish_curve(&mut self, knots: usize) {
        self.knots += knots;
    }

    /// The lines with the new values; what did not have one a knot stays, and is told where values are checked.
    fn put(self, mut lines: Lines) -> Lines {
        let is_whole = |primvar: &FacePrimvar| primvar.place_count() == self.knots;
        let of_knots = self.of_knots.into_iter().filter(|(primvar, _)| is_whole(primvar));
        for (old, values) in self.of_points.into_iter().chain(of_knots) {
            let mut all = lines.widths.iter_mut().chain(&mut lines.primvars);
            if let Some(primvar) = all.find(|primvar| primvar.name == old.name && primvar.interpolation == old.interpolation) {
                (primvar.values, primvar.indices) = (values, None);
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of a circle as a rational curve of order 3.
    fn quarter() -> Spline<'static> {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let control = [[1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, half], [0.0, 1.0, 0.0, 1.0]];
        let control = control.iter().map(|[x, y, z, w]| vec![x * w, y * w, z * w, *w]).collect();
        Spline { order: 3, knots: &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], control }
    }

    #[test]
    fn spans_of_a_circle_are_round() {
        let spline = quarter();
        for pair in spline.joints(None).windows(2) {
            let [start, end] = [&pair[0], &pair[1]].map(|joint| spline.at(pair[0].knot, joint.t));
            let third = (pair[1].t - pair[0].t) / 3.0;
            for t in [0.25, 0.5, 0.75] {
                let s: f64 = 1.0 - t;
                let at = |k: usize| {
                    let [b, c] = [start.0[k] + third * start.1[k], end.0[k] - third * end.1[k]];
                    s * s * s * start.0[k] + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * end.0[k]
                };
                // 5.6e-8 is what so many spans are off at most.
                assert!((at(0).hypot(at(1)) - 1.0).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn ranges_cut_at_their_ends() {
        let joints = quarter().joints(Some([0.25, 0.5]));
        assert_eq!((joints[0].t, joints[joints.len() - 1].t), (0.25, 0.5));
        assert_eq!(quarter().joints(Some([2.0, 3.0])).len(), SPANS[0] + 1);
    }
}
