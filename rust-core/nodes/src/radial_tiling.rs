//! Blender's Radial Tiling node (5.0 and later): the plane as segments around the origin, each with coordinates along a rounded polygon.
//!
//! Of a polygon with a broken number of sides the last segment is narrower. Its corners and those beside it are circles that touch both sides.

use crate::finite::all_finite;
use core::f32::consts::{PI, TAU};
use gonio_simd::{F, Lanes, M};
use serde::{Deserialize, Serialize};

/// Which outputs are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum TilingPart {
    /// The segment's coordinates x and y, and zero.
    Coordinates,
    /// The segment's number, width and rotation.
    Segment,
}

/// The node's settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct RadialTiling {
    /// Whether x goes from 0 to 1 over a segment; else both coordinates are zero at the polygon and to scale.
    pub normalize: bool,
    /// Which outputs.
    pub part: TilingPart,
}

/// How a corner is rounded, as seen from the middle of its side.
#[derive(Clone, Copy, Debug)]
struct Corner<L: Lanes> {
    /// The angle from the corner to where the circle ends and the straight side begins.
    start: F<L>,
    /// The angle from there to the middle of the side.
    rest: F<L>,
    /// The part of `start` over which x goes from straight to round.
    spline: F<L>,
    /// The part over which it is round.
    round: F<L>,
}

impl<L: Lanes> Corner<L> {
    #[inline(always)]
    fn new(half: F<L>, start: F<L>, roundness: F<L>) -> Self {
        Self { start, rest: half - start, spline: (1.0 - roundness) * start, round: roundness * start }
    }
    #[inline(always)]
    fn select(mask: M<L>, a: Self, b: Self) -> Self {
        Self {
            start: mask.select(a.start, b.start),
            rest: mask.select(a.rest, b.rest),
            spline: mask.select(a.spline, b.spline),
            round: mask.select(a.round, b.round),
        }
    }
    /// Half the width of a segment at the height `y`, where `tangent` is that of `rest`.
    #[inline(always)]
    fn half_width(&self, y: F<L>, tangent: F<L>) -> F<L> {
        y * tangent + self.spline * (0.5 * y + 0.5) + self.round
    }
    /// x in the corner at the distance `radius` and the angle `into` from the start, without its sign, and half the width there.
    #[inline(always)]
    fn rounded(&self, radius: F<L>, into: F<L>) -> [F<L>; 2] {
        let (sin, cos) = self.rest.sin_cos();
        let (across, along) = (radius * sin, radius * cos);
        let near = along * into + 0.5 * (1.0 - along) * into * into / self.spline;
        let far = self.spline * (0.5 * along - 0.5) + into;
        let x = across + into.lt(self.spline).select(near, far);
        [x, across + self.spline * (0.5 * along + 0.5) + self.round]
    }
}

/// What follows from the sides and the roundness alone.
#[derive(Clone, Copy, Debug)]
struct Polygon<L: Lanes> {
    /// Half a segment's angle, and half that of the last.
    half: F<L>,
    last_half: F<L>,
    /// Corners between equal segments, in the last segment, and beside it.
    regular: Corner<L>,
    inner: Corner<L>,
    outer: Corner<L>,
    /// The circle beside the last segment.
    centre: [F<L>; 2],
    radius: F<L>,
    /// The distance of sides over that of the last one.
    ratio: F<L>,
    /// Whether the last segment is narrower.
    irregular: M<L>,
    sharp: M<L>,
    roundness: F<L>,
}

impl<L: Lanes> Polygon<L> {
    #[inline(always)]
    fn new(l: L, sides: F<L>, roundness: F<L>) -> Self {
        let sharp = roundness.eq(0.0);
        let irregular = !sides.floor().eq(sides);
        let half = PI / sides;
        let last_half = irregular.select(PI - sides.floor() * half, half);
        let one = l.f(1.0);
        let (tangent, last_tangent) = (half.tan(), last_half.tan());
        // Sharp corners begin at the corner, without a rounding error.
        let start = (half - ((1.0 - roundness) * tangent).atan2(one)).keep_if(!sharp);
        let inner_start = (last_half - ((1.0 - roundness) * last_tangent).atan2(one)).keep_if(!sharp);
        let radius = roundness * last_tangent / (0.5 * (half + last_half)).tan();
        let ((inner_sin, inner_cos), (last_sin, last_cos)) = (inner_start.sin_cos(), last_half.sin_cos());
        let (sin, cos) = half.sin_cos();
        let to_start = (last_half - inner_start).cos();
        let centre = [inner_cos / to_start - radius * last_cos, radius * last_sin - inner_sin / to_start];
        let outer_start = ((centre[1] + radius * sin) / (centre[0] + radius * cos)).atan2(one);
        let outer_roundness = 1.0 - (half - outer_start).tan() / tangent;
        Self {
            half,
            last_half,
            regular: Corner::new(half, start, roundness),
            inner: Corner::new(last_half, inner_start, roundness),
            outer: Corner::new(half, outer_start, outer_roundness),
            centre,
            radius,
            ratio: cos / last_cos,
            irregular,
            sharp,
            roundness,
        }
    }

    /// The distance of a corner's circle along a ray at the angle `from` the corner, where the sides' distance is 1.
    #[inline(always)]
    fn circle(&self, in_regular: M<L>, from: F<L>) -> F<L> {
        let (sin, cos) = from.sin_cos();
        let middle = (1.0 - self.roundness) / self.half.cos();
        let [x, y] = self.centre;
        let along = in_regular.select(cos * middle, sin * y + cos * x);
        let beyond = in_regular.select(self.roundness * self.roundness - middle * middle, self.radius * self.radius - x * x - y * y);
        along + (along * along + beyond).safe_sqrt()
    }
}

/// Where a point lies around the origin.
#[derive(Clone, Copy, Debug)]
struct Around<L: Lanes> {
    /// Distance, angle in (-π, π], and angle in [0, 2π].
    radius: F<L>,
    signed: F<L>,
    angle: F<L>,
    /// The angle from the segment's beginning, and the segment's number.
    within: F<L>,
    number: F<L>,
}

impl RadialTiling {
    /// The inputs of [`evaluate`](Self::evaluate), in order.
    pub const INPUTS: [&str; 4] = ["x", "y", "sides", "roundness"];
    /// How many outputs there are.
    pub const OUTPUTS: usize = 3;

    /// The outputs that [`TilingPart`] names.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 4]) -> [F<L>; 3] {
        let [x, y, sides, roundness] = *inputs;
        l.vectorize(
            #[inline(always)]
            || self.at(l, [x, y], sides.max(2.0), roundness.saturate()),
        )
    }

    #[inline(always)]
    fn at<L: Lanes>(&self, l: L, [x, y]: [F<L>; 2], sides: F<L>, roundness: F<L>) -> [F<L>; 3] {
        let polygon = Polygon::new(l, sides, roundness);
        let signed = y.atan2(x);
        let below = y.lt(0.0).select(l.f(1.0), l.f(0.0));
        let angle = signed + below * TAU;
        let segment = 2.0 * polygon.half;
        let number = (angle / segment).floor();
        let around = Around { radius: (x * x + y * y).sqrt(), signed, angle, within: angle - number * segment, number };
        let [x, y, width, turn] = self.in_segment(l, &polygon, &around);
        all_finite(match self.part {
            TilingPart::Coordinates => [x, y, l.f(0.0)],
            TilingPart::Segment => [(sides * (signed / TAU + below)).floor(), width, turn],
        })
    }

    /// The segment's coordinates, its width and its rotation.
    #[inline(always)]
    fn in_segment<L: Lanes>(&self, l: L, polygon: &Polygon<L>, around: &Around<L>) -> [F<L>; 4] {
        let Around { radius, angle, within, .. } = *around;
        let (half, last_half, irregular) = (polygon.half, polygon.last_half, polygon.irregular);
        let (regular, inner, outer) = (polygon.regular, polygon.inner, polygon.outer);
        let last_begins = TAU - 2.0 * last_half;
        let far = angle.ge(outer.start) & angle.lt(last_begins - outer.start);
        let in_regular = !irregular | polygon.sharp.select(angle.lt(last_begins), far);
        // Straight sides, where not a corner's circle counts.
        let by_last = irregular & (angle.ge(last_begins - regular.start) | angle.lt(regular.start));
        let straight_regular = (within.ge(regular.start) & within.lt(2.0 * half - regular.start)) | by_last;
        let straight_last = angle.ge(last_begins + inner.start) & angle.lt(TAU - inner.start);
        let straight = in_regular.select(straight_regular, straight_last) | polygon.sharp;
        // The angle from the nearest corner; beside the last segment mirrored, so that its inside is negative.
        let mirrored = angle.ge(last_begins - outer.start) & angle.lt(TAU - last_half);
        let from_last = mirrored.select(-(around.signed + 2.0 * last_half), around.signed);
        let from_regular = within - (2.0 * half).keep_if(within.gt(half));
        let from = in_regular.select(from_regular, from_last);
        let in_last = !in_regular & (straight | from_last.lt(0.0));
        let beside_last = irregular & in_regular & straight & (angle.ge(last_begins - half) | angle.lt(half));
        let corner = Corner::select(in_last, inner, Corner::select((beside_last | !in_regular) & !in_last, outer, regular));
        let middle = in_last.select(last_half, half);
        let ratio = polygon.ratio;
        // Heights over the origin: by the segment's own side, and as the other segments have it.
        let to_middle = middle - within;
        let own = straight.select(radius * to_middle.cos(), radius / polygon.circle(in_regular, from));
        let height = in_regular.select(own, ratio * own);
        let measured = (in_regular | in_last).select(own, height);
        let tangent = corner.rest.tan();
        let half_width = corner.half_width(measured, tangent);
        let into = corner.start - from.abs();
        let [rounded, rounded_width] = corner.rounded(radius, into);
        let x = straight.select(measured * to_middle.abs().tan(), rounded);
        let total = straight.select(half_width, half_width + (rounded_width - half_width) * (into / corner.start));
        let x = within.lt(middle).select(-x, x);
        let at_origin = radius.eq(0.0);
        let line = sides_of_line(polygon);
        let scale = in_last.select(ratio, l.f(1.0));
        let x = if self.normalize { line.select(x, x / total).keep_if(!at_origin) * 0.5 + 0.5 } else { (x * scale).keep_if(!at_origin) };
        let y = if self.normalize { height } else { height - 1.0 };
        let regular_width = regular.rest.tan() + regular.spline + regular.round;
        let last_width = inner.rest.tan() + ratio * (inner.spline * (0.5 / ratio + 0.5) + inner.round);
        let width = in_last.select(last_width, regular_width).keep_if(!line);
        [x, y, width, around.number * (2.0 * half) + middle]
    }
}

/// Whether the polygon is a line of two sharp sides, which has no end to measure by.
#[inline(always)]
fn sides_of_line<L: Lanes>(polygon: &Polygon<L>) -> M<L> {
    polygon.sharp & polygon.half.ge(0.5 * PI)
}
