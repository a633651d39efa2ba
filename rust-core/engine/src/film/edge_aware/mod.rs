//! A quick way to take noise out of a picture for looking at it: an à-trous filter that stops at edges.
//!
//! Dammertz et al., Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering (2010): levels of a 5 × 5 spline whose taps
//! lie twice as far apart each time, weighted by how like the pixels are. Normals and albedos tell surfaces apart, and light is divided by the albedo
//! before and multiplied by it after, so that textures stay. How much brightness may differ follows the noise, as in Schied et al., Spatiotemporal
//! Variance-Guided Filtering (2017); here the picture alone tells it (`noise`).

mod noise;
mod rows;
#[cfg(test)]
mod tests;

use super::Image;
use crate::{scene::Aov, threads::in_pool};
use gonio_simd::{Execution, F, Lanes, dispatch};
use rayon::prelude::*;
use rows::{GUIDE_CHANNELS, LIGHT_CHANNELS, LUMINANCE, Rows, VARIANCE};

/// Levels, and pixels from tap to tap at the last.
const LEVELS: u32 = 5;
const LONGEST: usize = 1 << (LEVELS - 1);
/// Pixels around a picture that taps may reach.
const MARGIN: usize = 2 * LONGEST;
/// The cubic spline's weights.
const SPLINE: [f32; 5] = [1.0 / 16.0, 1.0 / 4.0, 3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];
/// Squared difference of luminance that separates, in variances of the noise.
const VARIANCES: f32 = 20.0;
/// Squared relative difference of luminance that nobody sees.
const INVISIBLE: f32 = 1e-4;
/// Keeps black from being divided by.
const DARK: f32 = 1e-12;

/// What tells surfaces apart: three values a pixel, rows from the top.
#[derive(Clone, Copy)]
struct Guides<'a> {
    size: [usize; 2],
    albedo: &'a [f32],
    normal: &'a [f32],
}

/// Light on its way through the levels.
struct Picture {
    light: Rows,
    guides: Rows,
}

/// The colour pass with most of its noise taken out, RGBA as in its layer; alpha stays. `None` where the colour or one of its guides, the passes
/// [`Aov::DenoisingAlbedo`] and [`Aov::DenoisingNormal`], is missing.
pub fn edge_aware(image: &Image, execution: Execution) -> Option<Vec<f32>> {
    in_pool(|| filtered(image, execution))
}

fn filtered(image: &Image, execution: Execution) -> Option<Vec<f32>> {
    let values = |aov| image.layer(aov).map(|layer| layer.values.as_slice());
    let colour = values(Aov::Color)?;
    let guides = Guides { size: image.size(), albedo: values(Aov::DenoisingAlbedo)?, normal: values(Aov::DenoisingNormal)? };
    if colour.is_empty() {
        return Some(Vec::new());
    }
    let mut picture = Picture { light: rows::light(colour, guides), guides: rows::guides(guides) };
    noise::estimate(&mut picture, execution);
    let mut next = picture.light.clone();
    noise::quiet(&mut picture, &mut next, execution);
    for level in 0..LEVELS {
        smooth(&mut picture, &mut next, 1 << level, execution);
    }
    Some(rows::colours(&picture.light, colour, guides))
}

/// One level, its taps `step` pixels apart; `next` is room for it.
fn smooth(picture: &mut Picture, next: &mut Rows, step: isize, execution: Execution) {
    let (length, source) = (next.length(), &*picture);
    next.values.par_chunks_exact_mut(length).enumerate().for_each(|(y, out)| {
        dispatch!(execution, l => smooth_row(l, source, y, step, out));
    });
    std::mem::swap(&mut picture.light, next);
}

#[inline(always)]
fn smooth_row<L: Lanes>(l: L, picture: &Picture, y: usize, step: isize, out: &mut [f32]) {
    let Picture { light, guides } = picture;
    let stride = light.stride;
    for at in (MARGIN..stride - MARGIN).step_by(L::COUNT) {
        let centre = guides_at(l, guides.row(y), stride, at);
        let luminance = l.load(light.row(y), LUMINANCE * stride + at);
        let variance = l.load(light.row(y), VARIANCE * stride + at);
        let sharpness = (variance * VARIANCES + luminance.squared() * INVISIBLE + DARK).recip();
        let (mut sums, mut whole) = ([l.f(0.0); LIGHT_CHANNELS], l.f(0.0));
        for (offset, across) in (-2..=2).zip(SPLINE) {
            let (Some(values), Some(surfaces)) = (light.row_from(y, offset * step), guides.row_from(y, offset * step)) else { continue };
            for (offset, along) in (-2..=2).zip(SPLINE) {
                let tap = at.wrapping_add_signed(offset * step);
                let difference = l.load(values, LUMINANCE * stride + tap) - luminance;
                let apart = difference.squared().mul_add(sharpness, distance(centre, guides_at(l, surfaces, stride, tap)));
                let weight = likeness(apart) * (across * along);
                whole += weight;
                for (channel, sum) in sums.iter_mut().enumerate() {
                    let share = if channel == VARIANCE { weight.squared() } else { weight };
                    *sum = l.load(values, channel * stride + tap).mul_add(share, *sum);
                }
            }
        }
        for (channel, sum) in sums.into_iter().enumerate() {
            let share = if channel == VARIANCE { whole.squared() } else { whole };
            (sum / share).store(out, channel * stride + at);
        }
    }
}

/// About exp(-x) for a squared distance, and 0 from 4 on.
#[inline(always)]
fn likeness<L: Lanes>(apart: F<L>) -> F<L> {
    apart.mul_add(-0.25, 1.0).max(0.0).squared().squared()
}

/// Guides of a register of pixels.
#[inline(always)]
fn guides_at<L: Lanes>(l: L, row: &[f32], stride: usize, at: usize) -> [F<L>; GUIDE_CHANNELS] {
    let mut guides = [l.f(0.0); GUIDE_CHANNELS];
    for (channel, guide) in guides.iter_mut().enumerate() {
        *guide = l.load(row, channel * stride + at);
    }
    guides
}

/// Squared distance of pixels by their guides; 1 is another surface.
#[inline(always)]
fn distance<L: Lanes>(a: [F<L>; GUIDE_CHANNELS], b: [F<L>; GUIDE_CHANNELS]) -> F<L> {
    let mut sum = a[0].lanes().f(0.0);
    for (a, b) in a.iter().zip(&b) {
        let difference = *a - *b;
        sum = difference.mul_add(difference, sum);
    }
    sum
}
