//! How much a measurement scatters to a view, and how far: estimated once from samples.

use super::PAIRS;
use super::angles::elevation;
use core::f32::consts::FRAC_PI_2;
use gonio_formats::bsdf::{Direction, Measured, Sampler};
use gonio_simd::{Lanes, Rgb, Vec3};
use gonio_table::{Axis, Colours};

/// Views along the polar angle, from the normal to nearly the horizon.
const VIEWS: usize = 16;
/// Azimuths that a view's albedo is the mean over.
const AZIMUTHS: usize = 4;
/// Samples for each view and azimuth.
const SAMPLES: usize = 256;
/// The last view's polar angle: grazing light has no albedo worth an estimate.
const LAST: f32 = FRAC_PI_2 * 0.98;

/// Shares of light that leave to a view.
#[derive(Clone, Debug)]
pub(super) struct Albedos {
    /// Over the view's polar angle, for a view at the front and at the back.
    sides: [Colours<1>; 2],
    peak: (f32, f32),
    roughness: f32,
}

impl Albedos {
    /// Estimates of a measurement.
    pub(super) fn new(measured: &Measured, sampler: &Sampler<'_>) -> Option<Self> {
        let weights = measured.channels().rgb_weights();
        let step = LAST / (VIEWS - 1) as f32;
        let knots: Vec<f32> = (0..VIEWS).map(|view| step * view as f32).collect();
        let mut spread = Vec::new();
        let mut peak = (0.0, 0.0);
        let mut side = |side: usize| {
            let albedos: Vec<[f32; 3]> = knots
                .iter()
                .map(|theta| {
                    let albedo = estimate(measured, sampler, &weights, (side, f64::from(*theta)), &mut spread);
                    let largest = albedo.into_iter().fold(0.0, f32::max);
                    if largest > peak.0 {
                        peak = (largest, theta.to_degrees());
                    }
                    albedo
                })
                .collect();
            Colours::new([Axis::new(knots.clone())?], |view| Some(albedos[view]))
        };
        let sides = [side(0)?, side(1)?];
        Some(Self { sides, peak, roughness: median(&mut spread).sqrt().clamp(0.0, 1.0) })
    }

    /// The largest share of any channel, and the view's angle in degrees.
    pub(super) fn peak(&self) -> (f32, f32) {
        self.peak
    }

    /// The roughness of GGX with as wide a distribution of half vectors.
    pub(super) fn roughness(&self) -> f32 {
        self.roughness
    }

    /// The share that leaves to a view on its side.
    #[inline(always)]
    pub(super) fn of_view<L: Lanes>(&self, l: L, side: usize, wo: Vec3<L>) -> Rgb<L> {
        self.sides[side].value(l, [elevation(wo)]).0
    }
}

/// The share of light that leaves to a view, the mean over its azimuth. Of the normal's view `spread` gets the tangents of half vectors and what they
/// scatter.
fn estimate(
    measured: &Measured,
    sampler: &Sampler<'_>,
    weights: &[[f64; 3]],
    (side, theta): (usize, f64),
    spread: &mut Vec<(f32, f32)>,
) -> [f32; 3] {
    let mut sum = [0.0; 3];
    if !PAIRS[side].iter().any(|pair| measured.has(*pair)) {
        return [0.0; 3];
    }
    let sign = if side == 0 { 1.0 } else { -1.0 };
    let mut values = vec![0.0; weights.len()];
    for number in 0..AZIMUTHS * SAMPLES {
        // Off the axes, along which measurements often have a knot.
        let phi = (number % AZIMUTHS) as f64 * std::f64::consts::FRAC_PI_2 + 0.3;
        let wo = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), sign * theta.cos()];
        let Some(sample) = sampler.sample(wo, spread_numbers(number / AZIMUTHS)) else { continue };
        measured.eval(sample.wi, wo, &mut values);
        let colour: [f64; 3] = core::array::from_fn(|c| values.iter().zip(weights).map(|(v, w)| v * w[c]).sum());
        sum.iter_mut().zip(colour).for_each(|(sum, x)| *sum += x / sample.pdf);
        if theta == 0.0 {
            spread.push((tangent(sample.wi, wo), ((colour[0] + colour[1] + colour[2]) / sample.pdf) as f32));
        }
    }
    sum.map(|x| (x / (AZIMUTHS * SAMPLES) as f64) as f32)
}

/// Evenly spread numbers (additive recurrence of the plastic number), in order in the first.
fn spread_numbers(i: usize) -> [f64; 3] {
    let fraction = |step: f64| (0.5 + i as f64 * step).fract();
    [(i as f64 + 0.5) / SAMPLES as f64, fraction(0.754_877_666_246_692_8), fraction(0.569_840_290_998_053_3)]
}

/// The tangent of the half vector's polar angle, light that passes through mirrored.
fn tangent(wi: Direction, wo: Direction) -> f32 {
    let half = [wi[0] + wo[0], wi[1] + wo[1], wi[2].abs() + wo[2].abs()];
    (half[0].hypot(half[1]) / half[2].max(1e-9)) as f32
}

/// The median of weighted numbers; 1 of none. Of GGX's half vectors seen from the normal the tangents' median is α.
fn median(spread: &mut [(f32, f32)]) -> f32 {
    spread.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let total: f32 = spread.iter().map(|(_, weight)| weight).sum();
    let mut sum = 0.0;
    let middle = spread.iter().find(|(_, weight)| {
        sum += weight;
        sum >= 0.5 * total
    });
    middle.map_or(1.0, |(tangent, _)| *tangent)
}
