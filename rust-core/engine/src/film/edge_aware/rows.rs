//! A picture as rows of planes, with margins, and its way there and back.

use super::{Guides, MARGIN};
use crate::colour::luminance_of_pixel;
use gonio_simd::padded;
use rayon::prelude::*;

/// Values of several channels: row after row, in each row channel after channel, each with a margin of [`MARGIN`] on both sides.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    pub(super) values: Vec<f32>,
    pub(super) channels: usize,
    /// Values of a channel in a row, margins included.
    pub(super) stride: usize,
    pub(super) height: usize,
}

impl Rows {
    /// Rows of one value everywhere.
    pub(super) fn new([width, height]: [usize; 2], channels: usize, value: f32) -> Self {
        let stride = padded(width) + 2 * MARGIN;
        Self { values: vec![value; stride * channels * height], channels, stride, height }
    }

    /// Empty rows of the same width and number.
    pub(super) fn like(other: &Self, channels: usize) -> Self {
        Self { values: vec![0.0; other.stride * channels * other.height], channels, ..*other }
    }

    /// Values of a row of all channels.
    pub(super) fn length(&self) -> usize {
        self.stride * self.channels
    }

    /// All channels of a row.
    pub(super) fn row(&self, y: usize) -> &[f32] {
        &self.values[y * self.length()..(y + 1) * self.length()]
    }

    /// The row `offset` rows further, if there is one.
    pub(super) fn row_from(&self, y: usize, offset: isize) -> Option<&[f32]> {
        y.checked_add_signed(offset).filter(|y| *y < self.height).map(|y| self.row(y))
    }
}

/// Channels of [`light`].
pub(super) const LUMINANCE: usize = 3;
pub(super) const VARIANCE: usize = 4;
pub(super) const LIGHT_CHANNELS: usize = 5;

/// Channels of [`guides`].
pub(super) const GUIDE_CHANNELS: usize = 6;

/// Guides of what lies outside the picture: too far from any pixel to count.
const OUTSIDE: f32 = 1e4;
/// Differences of normals and of albedos that separate surfaces.
const NORMAL_TOLERANCE: f32 = 0.25;
const ALBEDO_TOLERANCE: f32 = 0.15;

/// Albedos are at least this where light is divided by them.
const LEAST_ALBEDO: f32 = 0.02;

/// What light is divided by at a pixel.
fn divisor(albedo: &[f32], channel: usize) -> f32 {
    if albedo[channel].is_finite() { albedo[channel].max(LEAST_ALBEDO) } else { 1.0 }
}

/// Light before it met the surface's colour, and its luminance; the variance is empty.
pub(super) fn light(colour: &[f32], guides: Guides<'_>) -> Rows {
    let mut rows = Rows::new(guides.size, LIGHT_CHANNELS, 0.0);
    let (length, stride, width) = (rows.length(), rows.stride, guides.size[0]);
    let sources = colour.par_chunks_exact(4 * width).zip(guides.albedo.par_chunks_exact(3 * width));
    rows.values.par_chunks_exact_mut(length).zip(sources).for_each(|(row, (colours, albedos))| {
        for (x, (colour, albedo)) in colours.chunks_exact(4).zip(albedos.chunks_exact(3)).enumerate() {
            let values: [f32; 3] = std::array::from_fn(|channel| {
                let value = colour[channel] / divisor(albedo, channel);
                if value.is_finite() { value } else { 0.0 }
            });
            for (channel, value) in values.into_iter().enumerate() {
                row[channel * stride + MARGIN + x] = value;
            }
            row[LUMINANCE * stride + MARGIN + x] = luminance_of_pixel(values);
        }
    });
    rows
}

/// Normals and albedos, so that two pixels at a distance of 1 are of two surfaces.
pub(super) fn guides(guides: Guides<'_>) -> Rows {
    let mut rows = Rows::new(guides.size, GUIDE_CHANNELS, OUTSIDE);
    let (length, stride, width) = (rows.length(), rows.stride, guides.size[0]);
    let sources = guides.normal.par_chunks_exact(3 * width).zip(guides.albedo.par_chunks_exact(3 * width));
    rows.values.par_chunks_exact_mut(length).zip(sources).for_each(|(row, (normals, albedos))| {
        for (first, values, tolerance) in [(0, normals, NORMAL_TOLERANCE), (3, albedos, ALBEDO_TOLERANCE)] {
            for (x, value) in values.chunks_exact(3).enumerate() {
                for (channel, value) in value.iter().enumerate() {
                    row[(first + channel) * stride + MARGIN + x] = if value.is_finite() { value / tolerance } else { OUTSIDE };
                }
            }
        }
    });
    rows
}

/// The colours of light on its surfaces, with the alpha of those before; what has neither light nor alpha keeps none.
pub(super) fn colours(light: &Rows, before: &[f32], guides: Guides<'_>) -> Vec<f32> {
    let (stride, width) = (light.stride, guides.size[0]);
    let mut colours = before.to_vec();
    let sources = light.values.par_chunks_exact(light.length()).zip(guides.albedo.par_chunks_exact(3 * width));
    colours.par_chunks_exact_mut(4 * width).zip(sources).for_each(|(colours, (row, albedos))| {
        let there = |colour: &[f32]| colour.iter().any(|value| *value != 0.0);
        let pixels = colours.chunks_exact_mut(4).zip(albedos.chunks_exact(3)).enumerate();
        for (x, (colour, albedo)) in pixels.filter(|(_, (colour, _))| there(colour)) {
            for (channel, value) in colour[..3].iter_mut().enumerate() {
                *value = row[channel * stride + MARGIN + x] * divisor(albedo, channel);
            }
        }
    });
    colours
}
