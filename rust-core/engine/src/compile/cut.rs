//! Curves cut into straight pieces, and points, as the trees and the tables have them.

use super::{
    smooth_primvars::asks_places,
    times::{blurs, shows_vectors},
};
use crate::{
    error::Diagnostic,
    geometry::{FIRST_PIECE, LAST_PIECE},
    scene::{CurveBasis, CurveWrap, Curves, Origin, PointKey, Points, Primvar, PrimvarInterpolation, Scene, point_key_problem},
};
use rayon::prelude::*;
use std::ops::Range;

/// Curves or points laid out.
#[derive(Debug, Default)]
pub(super) struct Cut {
    /// Centres and radii, local units; a closed curve has copies of its ends beyond them.
    pub(super) points: Vec<[f32; 4]>,
    /// The same at evenly spaced times over the shutter; none where they stand still.
    pub(super) keys: Vec<Vec<[f32; 4]>>,
    /// Of each piece of a curve its first point, with the bits of its ends; none for points.
    pub(super) pieces: Vec<u32>,
    /// Where each point of curves lies; none where nobody asks.
    pub(super) places: Vec<Place>,
    /// Where the tables have points, radii and pieces.
    pub(super) laid: Laid,
}

/// Runs in the tables: of the coordinates, of the radii and of the pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Laid {
    pub(super) coordinates: Range<usize>,
    pub(super) radii: Range<usize>,
    pub(super) pieces: Range<usize>,
}

/// A place on a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) curve: u32,
    /// Span of the curve, and how far along it.
    pub(super) span: u32,
    pub(super) t: f32,
}

/// Where a curve's elements begin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CurveStart {
    pub(super) point: usize,
    pub(super) joint: usize,
    pub(super) count: usize,
}

/// All curves and behind them all points of a scene; materials ask for values by some names.
pub(super) fn cut_all(scene: &Scene, names: &[String], diagnostics: &mut Vec<Diagnostic>) -> Vec<Cut> {
    let mut cuts = Vec::with_capacity(scene.curves.len() + scene.points.len());
    let has_times = blurs(&scene.settings) || shows_vectors(&scene.settings);
    for curves in &scene.curves {
        let has_keys = has_times && !curves.motion.is_empty();
        let mut cut = cut_curves(curves, has_keys || asks_places(curves, names), diagnostics);
        if has_times && moves(&curves.motion, curves.points.len(), &curves.origin, diagnostics) {
            cut.keys = keys_of_curves(curves, &cut);
        }
        cuts.push(cut);
    }
    for points in &scene.points {
        let mut cut = cut_points(points, diagnostics);
        if has_times && moves(&points.motion, points.points.len(), &points.origin, diagnostics) {
            cut.keys = points.motion.iter().map(|key| placed(&key.points, &cut)).collect();
        }
        cuts.push(cut);
    }
    cuts
}

/// Whether keys can be used and differ; says why they cannot.
fn moves(keys: &[PointKey], count: usize, origin: &Origin, diagnostics: &mut Vec<Diagnostic>) -> bool {
    if let Some(problem) = point_key_problem(keys, count) {
        diagnostics.push(Diagnostic::warning(origin, format!("{problem}; the shape of the frame stands still")));
        return false;
    }
    keys.iter().any(|key| *key != keys[0])
}

/// Other centres with the radii of points.
fn placed(points: &[[f32; 3]], cut: &Cut) -> Vec<[f32; 4]> {
    points.iter().zip(&cut.points).map(|([x, y, z], [.., radius])| [*x, *y, *z, *radius]).collect()
}

/// Curves at their keys, cut where they are cut at the frame.
fn keys_of_curves(curves: &Curves, cut: &Cut) -> Vec<Vec<[f32; 4]>> {
    let starts = starts(curves);
    let at = |points: &[[f32; 3]], place: &Place, radius: f32| {
        let start = starts[place.curve as usize];
        let mut sum = [0.0, 0.0, 0.0, radius];
        for (point, weight) in weights(curves.basis, curves.wrap, start.count, place.span as usize, place.t) {
            if weight != 0.0 {
                (0..3).for_each(|k| sum[k] += weight * points[start.point + point][k]);
            }
        }
        sum
    };
    let key = |key: &PointKey| cut.places.par_iter().zip(&cut.points).map(|(place, rest)| at(&key.points, place, rest[3])).collect();
    curves.motion.iter().map(key).collect()
}

/// The control points of a span with their weights.
type Weights = [(usize, f32); 4];

/// What a value is at `t` of span `span` of a curve of `count` points, as weights of its points.
pub(super) fn weights(basis: CurveBasis, wrap: CurveWrap, count: usize, span: usize, t: f32) -> Weights {
    let s = 1.0 - t;
    let at = |i: usize| i % count.max(1);
    match basis {
        CurveBasis::Linear => [(at(span), s), (at(span + 1), t), (0, 0.0), (0, 0.0)],
        CurveBasis::Bezier => {
            let w = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            [0, 1, 2, 3].map(|k| (at(3 * span + k), w[k]))
        }
        CurveBasis::BSpline => {
            let w = [s * s * s, 3.0 * t * t * t - 6.0 * t * t + 4.0, 3.0 * s * s * s - 6.0 * s * s + 4.0, t * t * t];
            spline(wrap, count, span, w.map(|w| w / 6.0))
        }
        CurveBasis::CatmullRom => {
            let w = [-t * s * s, 2.0 - 5.0 * t * t + 3.0 * t * t * t, 2.0 - 5.0 * s * s + 3.0 * s * s * s, -s * t * t];
            spline(wrap, count, span, w.map(|w| 0.5 * w))
        }
    }
}

/// The points that steer a span of a spline: pinned ones have a mirrored point beyond each end.
fn spline(wrap: CurveWrap, count: usize, span: usize, mut w: [f32; 4]) -> Weights {
    if wrap != CurveWrap::Pinned {
        return [0, 1, 2, 3].map(|k| ((span + k) % count.max(1), w[k]));
    }
    let mut points = [span.wrapping_sub(1), span, span + 1, span + 2];
    if span == 0 {
        // 2 a − b in place of the point before.
        (w[1], w[2], w[0], points[0]) = (w[1] + 2.0 * w[0], w[2] - w[0], 0.0, 0);
    }
    if span + 2 >= count {
        (w[2], w[1], w[3], points[3]) = (w[2] + 2.0 * w[3], w[1] - w[3], 0.0, 0);
    }
    [0, 1, 2, 3].map(|k| (points[k], w[k]))
}

/// Where the curves begin; those beyond the points that there are have none.
pub(super) fn starts(curves: &Curves) -> Vec<CurveStart> {
    let (mut point, mut joint) = (0, 0);
    let mut starts = Vec::with_capacity(curves.counts.len());
    for count in curves.counts.iter().map(|count| *count as usize) {
        let there = if point + count <= curves.points.len() { count } else { 0 };
        starts.push(CurveStart { point, joint, count: there });
        point += count;
        joint += curves.basis.spans(count, curves.wrap)[1];
    }
    starts
}

impl Place {
    /// First float of the values there of a primvar, and their weights; none where a value is missing.
    pub(super) fn values(&self, curves: &Curves, start: &CurveStart, primvar: &Primvar) -> [(usize, f32); 4] {
        let elements = match primvar.interpolation {
            PrimvarInterpolation::Constant => [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)],
            PrimvarInterpolation::Uniform => [(self.curve as usize, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)],
            PrimvarInterpolation::Varying => {
                let [_, joints] = curves.basis.spans(start.count, curves.wrap);
                let next = (self.span as usize + 1) % joints.max(1);
                [(start.joint + self.span as usize, 1.0 - self.t), (start.joint + next, self.t), (0, 0.0), (0, 0.0)]
            }
            PrimvarInterpolation::Vertex | PrimvarInterpolation::FaceVarying => {
                let weights = weights(curves.basis, curves.wrap, start.count, self.span as usize, self.t);
                weights.map(|(point, weight)| (start.point + point, weight))
            }
        };
        elements.map(|(element, weight)| (place_of(primvar, element), weight))
    }
}

/// First float of an element's value.
pub(super) fn place_of(primvar: &Primvar, element: usize) -> usize {
    let number = primvar.indices.as_ref().map_or(element, |indices| indices.get(element).map_or(usize::MAX, |i| *i as usize));
    number.saturating_mul(usize::from(primvar.components))
}

/// The sum of weighted values of one component.
pub(super) fn sum(primvar: &Primvar, values: &[(usize, f32); 4], component: usize) -> f32 {
    let value = |(at, weight): &(usize, f32)| primvar.values.get(at.saturating_add(component)).map_or(0.0, |value| value * weight);
    values.iter().filter(|(_, weight)| *weight != 0.0).map(value).sum()
}

/// Most and fewest pieces of a span of a spline.
const PIECES: [f32; 2] = [1.0, 16.0];
/// A piece whose ends are on the curve may be off in its middle by these shares of the radius and of the chord. [`Cutter::fit`] halves that.
const MOST_OFF: [f32; 2] = [0.2, 2e-3];

/// One curve while it is cut.
struct Cutter<'a> {
    curves: &'a Curves,
    start: CurveStart,
    number: u32,
    /// Whether places are asked for.
    placed: bool,
}

impl Cutter<'_> {
    /// Centre and radius at a place; the radius as it was asked for.
    fn at(&self, span: usize, t: f32) -> [f32; 4] {
        let Curves { points, basis, wrap, .. } = self.curves;
        let mut sum = [0.0; 4];
        for (point, weight) in weights(*basis, *wrap, self.start.count, span, t) {
            // A weight of zero drops what is not finite elsewhere.
            if weight != 0.0 {
                let point = points[self.start.point + point];
                (0..3).for_each(|k| sum[k] += weight * point[k]);
            }
        }
        let place = self.place(span, t);
        sum[3] = 0.5 * self::sum(&self.curves.widths, &place.values(self.curves, &self.start, &self.curves.widths), 0);
        sum
    }

    fn place(&self, span: usize, t: f32) -> Place {
        Place { curve: self.number, span: span as u32, t }
    }

    /// Pieces of a span: as many as its bend asks for.
    fn pieces(&self, span: usize) -> usize {
        if self.curves.basis == CurveBasis::Linear {
            return 1;
        }
        let [a, p, q, r, b] = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| self.at(span, t));
        let off = |x: [f32; 4], t: f32| (0..4).map(|k| (x[k] - (a[k] + (b[k] - a[k]) * t)).powi(2)).sum::<f32>().sqrt();
        // A parabola is off most in the middle, and three quarters of that at the quarters.
        let off = (off(p, 0.25) / 0.75).max(off(q, 0.5)).max(off(r, 0.75) / 0.75);
        let chord = (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f32>().sqrt();
        let allowed = MOST_OFF[0] * a[3].max(b[3]).max(0.0) + MOST_OFF[1] * chord;
        let pieces = (off / allowed.max(f32::MIN_POSITIVE)).sqrt().ceil();
        if pieces.is_finite() { pieces.clamp(PIECES[0], PIECES[1]) as usize } else { 1 }
    }

    /// Moves the joints off the curve by half of what pieces between points on it are off in their middles: so they are off by half as much there.
    fn fit(&self, own: &mut [([f32; 4], Place)]) {
        let bend = |pair: &[([f32; 4], Place)]| {
            let ([(a, from), (b, to)], mut off) = ([pair[0], pair[1]], [0.0; 3]);
            let start = if from.span == to.span { from.t } else { 0.0 };
            let middle = self.at(to.span as usize, 0.5 * (start + to.t));
            (0..3).for_each(|k| off[k] = middle[k] - 0.5 * (a[k] + b[k]));
            // What is not finite stays where it is.
            if off.iter().all(|x| x.is_finite()) { off } else { [0.0; 3] }
        };
        let bends: Vec<[f32; 3]> = own.windows(2).map(bend).collect();
        for ((point, _), around) in own[1..].iter_mut().zip(bends.windows(2)) {
            (0..3).for_each(|k| point[k] += 0.25 * (around[0][k] + around[1][k]));
        }
    }

    /// Appends the curve.
    fn cut(&self, out: &mut Cut) {
        let [spans, _] = self.curves.basis.spans(self.start.count, self.curves.wrap);
        let mut own: Vec<([f32; 4], Place)> = Vec::new();
        for span in 0..spans {
            let pieces = self.pieces(span);
            let first = usize::from(span > 0);
            own.extend((first..=pieces).map(|i| i as f32 / pieces as f32).map(|t| (self.at(span, t), self.place(span, t))));
        }
        // Points that do not move on would be pieces without a direction.
        own.dedup_by(|next, kept| next.0[..3] == kept.0[..3]);
        if own.len() < 2 {
            return;
        }
        if self.curves.basis != CurveBasis::Linear {
            self.fit(&mut own);
        }
        let closed = self.curves.wrap == CurveWrap::Periodic;
        let mut first = out.points.len() as u32;
        let pieces = own.len() as u32 - 1;
        if closed && own.len() > 3 {
            let (before, after) = (own[own.len() - 2], own[1]);
            own.insert(0, before);
            own.push(after);
            first += 1;
            out.pieces.extend(first..first + pieces);
        } else {
            let bits = |i: u32| if i == 0 { FIRST_PIECE } else { 0 } | if i == pieces - 1 { LAST_PIECE } else { 0 };
            out.pieces.extend((0..pieces).map(|i| (first + i) | bits(i)));
        }
        out.points.extend(own.iter().map(|(point, _)| *point));
        if self.placed {
            out.places.extend(own.iter().map(|(_, place)| *place));
        }
    }
}

/// Curves that are cut as one task.
const TASK: usize = 4096;

fn cut_curves(curves: &Curves, placed: bool, diagnostics: &mut Vec<Diagnostic>) -> Cut {
    let starts = starts(curves);
    let numbers: Vec<u32> = (0..starts.len() as u32).collect();
    let parts: Vec<Cut> = numbers
        .par_chunks(TASK)
        .map(|numbers| {
            let mut part = Cut::default();
            for number in numbers {
                Cutter { curves, start: starts[*number as usize], number: *number, placed }.cut(&mut part);
            }
            part
        })
        .collect();
    let mut cut = Cut::default();
    // As much as is needed: hair has millions of pieces.
    cut.points.reserve_exact(parts.iter().map(|part| part.points.len()).sum());
    cut.places.reserve_exact(parts.iter().map(|part| part.places.len()).sum());
    cut.pieces.reserve_exact(parts.iter().map(|part| part.pieces.len()).sum());
    for part in parts {
        let first = cut.points.len() as u32;
        cut.points.extend(part.points);
        cut.places.extend(part.places);
        cut.pieces.extend(part.pieces.iter().map(|piece| piece + first));
    }
    let short = starts.iter().filter(|start| curves.basis.spans(start.count, curves.wrap)[0] == 0).count();
    let sum: u64 = curves.counts.iter().map(|count| u64::from(*count)).sum();
    let mut tell = |message: String| diagnostics.push(Diagnostic::warning(&curves.origin, message));
    if sum != curves.points.len() as u64 {
        tell(format!("the curves have {sum} points by their counts, {} were found; curves beyond them are left out", curves.points.len()));
    } else if short > 0 {
        tell(format!("{short} of {} curves have too few points for a {:?} curve; they are left out", starts.len(), curves.basis));
    }
    report_sizes(&mut cut.points, &mut tell);
    cut
}

fn cut_points(points: &Points, diagnostics: &mut Vec<Diagnostic>) -> Cut {
    let radius = |i: usize| {
        let element =
            if matches!(points.widths.interpolation, PrimvarInterpolation::Vertex | PrimvarInterpolation::Varying) { i } else { 0 };
        0.5 * points.widths.values.get(place_of(&points.widths, element)).copied().unwrap_or(0.0)
    };
    let with_radius = |(i, point): (usize, &[f32; 3])| [point[0], point[1], point[2], radius(i)];
    let mut cut = Cut { points: points.points.par_iter().enumerate().map(with_radius).collect(), ..Cut::default() };
    report_sizes(&mut cut.points, &mut |message| diagnostics.push(Diagnostic::warning(&points.origin, message)));
    cut
}

/// Says which places and widths make no sense; those widths become zero.
fn report_sizes(points: &mut [[f32; 4]], tell: &mut dyn FnMut(String)) {
    let lost = points.iter().filter(|point| !point[..3].iter().all(|x| x.abs() <= 1e12)).count();
    let odd = points.iter().filter(|point| !(0.0..=1e12).contains(&point[3])).count();
    let thin = points.iter().filter(|point| point[3] == 0.0).count();
    let all = points.len();
    if lost > 0 {
        tell(format!("{lost} of {all} places are not finite or lie beyond 1e12; what is there is left out"));
    }
    if odd > 0 {
        tell(format!("widths are negative, too large or not a number at {odd} of {all} places; they count as 0"));
        points.iter_mut().filter(|point| !(0.0..=1e12).contains(&point[3])).for_each(|point| point[3] = 0.0);
    } else if thin == all && all > 0 {
        tell("all widths are 0, so that nothing is seen".to_owned());
    }
}
