//! Sums of octaves.

use super::metric::{self, length, measure};
use super::{Feature, Part, Shape, VoronoiTexture};
use gonio_simd::{F, Lanes, M};

/// Four outputs, as [`Part`] names them.
pub(super) type Octave<L> = [F<L>; 4];

/// The most octaves.
const MOST: usize = 16;

/// The wanted outputs of a point.
#[inline(always)]
pub(super) fn by_part<L: Lanes, const D: usize>(l: L, part: Part, distance: F<L>, color: [F<L>; 3], place: [F<L>; D]) -> Octave<L> {
    match part {
        Part::ColorDistance => [color[0], color[1], color[2], distance],
        Part::Position => {
            let mut octave = [l.f(0.0); 4];
            if D == 1 {
                octave[3] = place[0];
            } else {
                for (output, coordinate) in octave.iter_mut().zip(place) {
                    *output = coordinate;
                }
            }
            octave
        }
    }
}

/// The octave at hand: its frequency, its amplitude, and how far there are more.
#[derive(Clone, Copy, Debug)]
struct Step<L: Lanes> {
    number: usize,
    frequency: F<L>,
    amplitude: F<L>,
    detail: F<L>,
}

impl<L: Lanes> Step<L> {
    #[inline(always)]
    fn first(l: L, shape: &Shape<L>) -> Self {
        // Further octaves of no amplitude are left out.
        let detail = shape.detail.keep_if(shape.roughness.gt(0.0));
        Self { number: 0, frequency: l.f(1.0), amplitude: l.f(1.0), detail }
    }
    /// How much of this octave counts: all of it, a part of the last, or nothing.
    #[inline(always)]
    fn share(&self) -> F<L> {
        (self.detail - self.number as f32 + 1.0).saturate()
    }
    #[inline(always)]
    fn next(&mut self, shape: &Shape<L>) -> M<L> {
        self.number += 1;
        self.frequency *= shape.lacunarity;
        self.amplitude *= shape.roughness;
        self.share().gt(0.0)
    }
    #[inline(always)]
    fn place<const D: usize>(&self, at: [F<L>; D]) -> [F<L>; D] {
        let mut place = at;
        for coordinate in &mut place {
            *coordinate *= self.frequency;
        }
        place
    }
}

impl VoronoiTexture {
    /// Octaves of [`Feature::F1`], [`Feature::F2`] or [`Feature::SmoothF1`].
    #[inline(always)]
    pub(super) fn points<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: Shape<L>) -> [F<L>; 4] {
        let mut step = Step::first(l, &shape);
        let (mut sum, mut most) = ([l.f(0.0); 4], l.f(0.0));
        while step.number < MOST {
            let octave = self.octave(l, step.place(at), &shape);
            let weight = step.amplitude * step.share();
            let counts = weight.gt(0.0);
            for (sum, octave) in sum.iter_mut().zip(octave) {
                let added = match self.part {
                    Part::ColorDistance => octave * weight,
                    Part::Position => (octave / step.frequency - *sum) * weight,
                };
                *sum += added.keep_if(counts);
            }
            most += weight;
            if !step.next(&shape).any() {
                break;
            }
        }
        match self.part {
            Part::ColorDistance if self.normalize => {
                let farthest = self.farthest::<L, D>(l, &shape);
                [sum[0] / most, sum[1] / most, sum[2] / most, sum[3] / (most * farthest)]
            }
            Part::ColorDistance => sum,
            Part::Position => {
                let scaled = !shape.scale.eq(0.0);
                [
                    (sum[0] / shape.scale).keep_if(scaled),
                    (sum[1] / shape.scale).keep_if(scaled),
                    (sum[2] / shape.scale).keep_if(scaled),
                    (sum[3] / shape.scale).keep_if(scaled),
                ]
            }
        }
    }

    /// One octave.
    #[inline(always)]
    fn octave<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: &Shape<L>) -> Octave<L> {
        // Without smoothness it is the plain minimum, over fewer cells.
        let smooth = l.m(self.feature == Feature::SmoothF1) & shape.smoothness.gt(0.0);
        let mut octave = [l.f(0.0); 4];
        if smooth.any() {
            octave = self.smooth(l, at, shape);
        }
        if !smooth.all() {
            for (octave, plain) in octave.iter_mut().zip(self.nearest(l, at, shape)) {
                *octave = smooth.select(*octave, plain);
            }
        }
        octave
    }

    /// The greatest distance that an octave of points can have.
    #[inline(always)]
    fn farthest<L: Lanes, const D: usize>(&self, l: L, shape: &Shape<L>) -> F<L> {
        let metric = metric::of_dimensions(self.metric, D);
        let corner = [shape.randomness.mul_add(0.5, 0.5); D];
        let distance = length(metric, measure(metric, corner, shape.exponent), shape.exponent);
        distance * if self.feature == Feature::F2 { l.f(2.0) } else { l.f(1.0) }
    }

    /// Octaves of [`Feature::DistanceToEdge`], each of which can only bring edges nearer.
    #[inline(always)]
    pub(super) fn edges<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: Shape<L>) -> [F<L>; 4] {
        let zero = l.f(0.0);
        if self.part == Part::Position {
            return [zero; 4];
        }
        let farthest = shape.randomness.mul_add(0.5, 0.5);
        let mut step = Step::first(l, &shape);
        let (mut distance, mut most) = (l.f(8.0), farthest);
        while step.number < MOST {
            let own = self.edge(l, step.place(at), &shape) / step.frequency;
            let weight = step.amplitude * step.share();
            let counts = weight.gt(0.0);
            most += ((farthest / step.frequency - most) * weight).keep_if(counts);
            distance = (counts & own.lt(distance)).select(distance.lerp(own, weight), distance);
            if !step.next(&shape).any() {
                break;
            }
        }
        if self.normalize {
            distance /= most;
        }
        [zero, zero, zero, distance]
    }
}
