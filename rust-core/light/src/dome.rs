//! Domes: constant ones by the cosine about the surface normal, textured ones by the luminance of their image and the size of its pixels on the sphere.

use super::record::LightTexture;
use gonio_simd::{F, Frame, Lanes, Vec3};
use gonio_table::Distribution2D;
use std::f32::consts::{PI, TAU};

/// Cells of the distribution, at most; finer images are averaged.
pub(super) const LARGEST: [usize; 2] = [1024, 512];
/// Every direction keeps this share of the mean: an even image has nothing else, and lights alone still find all there is.
const FLOOR: f64 = 0.05;
/// The same of rays that the dome sends, which nothing else would find.
const EMISSION_FLOOR: f64 = 0.01;

/// Where a textured dome is brighter than in the mean: scattered rays find the rest as well.
///
/// Karlík et al., MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling, ACM TOG 38(6), 2019, section 5.
#[derive(Clone, Debug)]
pub(crate) struct DomeDistribution {
    distribution: Distribution2D,
    /// Mean luminance over the sphere.
    pub(crate) mean_luminance: f64,
    /// The part of the light that light sampling is to bring: what is above the mean, and the floor.
    pub(crate) sampled_part: f64,
}

/// The same of a dome without an image.
pub(crate) const EVEN_SAMPLED_PART: f64 = FLOOR;

/// Luminance of each cell: the mean over its pixels and their neighbours.
pub(super) fn cells(image: &LightTexture, [width, height]: [usize; 2]) -> Vec<f64> {
    let pixel = |x: usize, y: usize| {
        let at = 3 * (y * image.width + x);
        super::build::luminance([image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]])
    };
    let clean = |v: f64| if v.is_finite() { v } else { 0.0 };
    let mut values = Vec::with_capacity(width * height);
    for row in 0..height {
        let (top, bottom) = (row * image.height / height, ((row + 1) * image.height).div_ceil(height));
        for column in 0..width {
            let (left, right) = (column * image.width / width, ((column + 1) * image.width).div_ceil(width));
            let (mut sum, mut count) = (0.0, 0.0);
            for y in top.saturating_sub(1)..(bottom + 1).min(image.height) {
                for x in left + image.width - 1..=right + image.width {
                    sum += clean(pixel(x % image.width, y));
                    count += 1.0;
                }
            }
            values.push(sum / count);
        }
    }
    values
}

impl DomeDistribution {
    /// For light sampling.
    pub(crate) fn new(image: &LightTexture) -> Self {
        Self::by(image, |v, mean| (v - mean).max(0.0) + FLOOR * mean)
    }
    /// For rays that the dome sends: in proportion to its luminance.
    pub(crate) fn of_emission(image: &LightTexture) -> Self {
        Self::by(image, |v, mean| v + EMISSION_FLOOR * mean)
    }
    fn by(image: &LightTexture, weight: impl Fn(f64, f64) -> f64) -> Self {
        let size = [image.width.min(LARGEST[0]), image.height.min(LARGEST[1])];
        let luminance = cells(image, size);
        let sine = |row: usize| (std::f64::consts::PI * (row as f64 + 0.5) / size[1] as f64).sin();
        let sines: f64 = (0..size[1]).map(sine).sum::<f64>() * size[0] as f64;
        let weighted: f64 = luminance.iter().enumerate().map(|(i, v)| v * sine(i / size[0])).sum();
        let mean = weighted / sines;
        let weights: Vec<f32> = luminance.iter().enumerate().map(|(i, v)| (weight(*v, mean) * sine(i / size[0])) as f32).collect();
        let sampled: f64 = weights.iter().map(|weight| f64::from(*weight)).sum();
        let sampled_part = if weighted > 0.0 { (sampled / weighted).min(1.0) } else { 1.0 };
        Self { distribution: Distribution2D::new(&weights, size[0]), mean_luminance: mean, sampled_part }
    }
    /// A direction in the dome's frame, its density and its place in the image.
    #[inline(always)]
    pub(crate) fn sample<L: Lanes>(&self, l: L, u: [F<L>; 2]) -> (Vec3<L>, F<L>, [F<L>; 2]) {
        let (place, pdf) = self.distribution.sample(l, u);
        let (sine, cosine) = (place[1] * 0.5).sin_cos_turns();
        // Longitude grows to the left from +z in the middle column.
        let (sin_longitude, cos_longitude) = (0.5 - place[0]).sin_cos_turns();
        (Vec3::new(sine * sin_longitude, cosine, sine * cos_longitude), pdf / (sine * (TAU * PI)), place)
    }
    /// Density of a direction whose place in the image is known.
    #[inline(always)]
    pub(crate) fn pdf<L: Lanes>(&self, l: L, direction: Vec3<L>, place: [F<L>; 2]) -> F<L> {
        let sine = (direction.x * direction.x + direction.z * direction.z).sqrt();
        (self.distribution.pdf(l, place) / (sine * (TAU * PI))).keep_if(sine.gt(0.0))
    }
}

/// The place in a latitude–longitude image of a unit direction in the dome's frame.
#[inline(always)]
pub(crate) fn place<L: Lanes>(direction: Vec3<L>) -> [F<L>; 2] {
    let sine = (direction.x * direction.x + direction.z * direction.z).sqrt();
    let longitude = direction.x.atan2(direction.z);
    [0.5 - longitude * (1.0 / TAU), sine.atan2(direction.y) * (1.0 / PI)]
}

/// A direction by the cosine about unit `n`, or any direction where `n` is zero; and its density.
#[inline(always)]
pub(crate) fn sample_constant<L: Lanes>(l: L, n: Vec3<L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>) {
    let nowhere = n.length_squared().lt(0.5);
    let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
    let height = nowhere.select(1.0 - u[0] * 2.0, (1.0 - u[0]).safe_sqrt());
    let sine = nowhere.select((1.0 - height * height).safe_sqrt(), u[0].sqrt());
    let pole = nowhere.select(Vec3::splat(l, [0.0, 0.0, 1.0]), n);
    let wi = Frame::from_normal(pole).to_world(Vec3::new(sine * cosine_turn, sine * sine_turn, height));
    (wi, pdf_constant(l, n, wi))
}

/// Density of [`sample_constant`].
#[inline(always)]
pub(crate) fn pdf_constant<L: Lanes>(l: L, n: Vec3<L>, wi: Vec3<L>) -> F<L> {
    let nowhere = n.length_squared().lt(0.5);
    nowhere.select(l.f(0.5 / TAU), n.dot(wi).max(0.0) * (1.0 / PI))
}
