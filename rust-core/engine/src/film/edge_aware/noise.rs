//! How noisy the light is around each pixel, told from the picture alone.
//!
//! The difference of a pixel from the mean of its two neighbours on a line has 3/2 of the variance of the noise, and nothing of a gradient. The mean of
//! its square over a neighbourhood is taken along four lines; the least of the four is the one along which there is no edge.

use super::{
    MARGIN, Picture, distance, guides_at, likeness,
    rows::{LUMINANCE, Rows, VARIANCE},
};
use gonio_simd::{Execution, F, Lanes, dispatch};
use rayon::prelude::*;

/// From a pixel to its neighbour on each line: columns and rows.
const LINES: [(isize, isize); 4] = [(1, 0), (0, 1), (1, 1), (1, -1)];
/// Rows and columns around a pixel that tell its noise.
const REACH: isize = 2;
/// Where no neighbour is of the same surface.
const UNKNOWN: f32 = 1e30;

/// Fills in the variance of the light's luminance.
pub(super) fn estimate(picture: &mut Picture, execution: Execution) {
    let mut differences = Rows::like(&picture.light, 2 * LINES.len());
    let (length, light_length) = (differences.length(), picture.light.length());
    let source = &*picture;
    differences.values.par_chunks_exact_mut(length).enumerate().for_each(|(y, out)| {
        dispatch!(execution, l => differences_of_row(l, source, y, out));
    });
    picture.light.values.par_chunks_exact_mut(light_length).enumerate().for_each(|(y, out)| {
        dispatch!(execution, l => variance_of_row(l, &differences, y, out));
    });
}

/// The variance that each line tells of each pixel, and whether its two neighbours are of the pixel's surface: two channels a line.
#[inline(always)]
fn differences_of_row<L: Lanes>(l: L, picture: &Picture, y: usize, out: &mut [f32]) {
    let (light, stride) = (&picture.light, picture.light.stride);
    let row = LUMINANCE * stride;
    for (line, (dx, dy)) in LINES.into_iter().enumerate() {
        let (Some(before), Some(after)) = (light.row_from(y, -dy), light.row_from(y, dy)) else { continue };
        let (Some(before_guides), Some(after_guides)) = (picture.guides.row_from(y, -dy), picture.guides.row_from(y, dy)) else { continue };
        for at in (MARGIN..stride - MARGIN).step_by(L::COUNT) {
            let (left, right) = (at.wrapping_add_signed(-dx), at.wrapping_add_signed(dx));
            let mean = (l.load(before, row + left) + l.load(after, row + right)) * 0.5;
            let centre = guides_at(l, picture.guides.row(y), stride, at);
            let there = distance(centre, guides_at(l, before_guides, stride, left)).lt(1.0);
            let back = distance(centre, guides_at(l, after_guides, stride, right)).lt(1.0);
            let same = there & back;
            let variance = (l.load(light.row(y), row + at) - mean).squared() * (2.0 / 3.0);
            variance.keep_if(same).store(out, 2 * line * stride + at);
            l.f(1.0).keep_if(same).store(out, (2 * line + 1) * stride + at);
        }
    }
}

/// The least of the lines' means over a neighbourhood.
#[inline(always)]
fn variance_of_row<L: Lanes>(l: L, differences: &Rows, y: usize, out: &mut [f32]) {
    let stride = differences.stride;
    for at in (MARGIN..stride - MARGIN).step_by(L::COUNT) {
        let mut least = l.f(UNKNOWN);
        for line in 0..LINES.len() {
            let [mut sum, mut count]: [F<L>; 2] = [l.f(0.0); 2];
            for row in (-REACH..=REACH).filter_map(|offset| differences.row_from(y, offset)) {
                for dx in -REACH..=REACH {
                    let x = at.wrapping_add_signed(dx);
                    sum += l.load(row, 2 * line * stride + x);
                    count += l.load(row, (2 * line + 1) * stride + x);
                }
            }
            least = least.min(count.gt(0.5).select(sum / count.max(1.0), l.f(UNKNOWN)));
        }
        least.keep_if(least.lt(UNKNOWN)).store(out, VARIANCE * stride + at);
    }
}

/// Puts in the place of each luminance the mean of the neighbours of its surface, by which pixels are compared, and the variance of that mean: a pixel
/// that stands out alone has neighbours like any other's. `next` is room for it, equal to the light.
pub(super) fn quiet(picture: &mut Picture, next: &mut Rows, execution: Execution) {
    let (length, source) = (next.length(), &*picture);
    next.values.par_chunks_exact_mut(length).enumerate().for_each(|(y, out)| {
        dispatch!(execution, l => quiet_row(l, source, y, out));
    });
    std::mem::swap(&mut picture.light, next);
}

#[inline(always)]
fn quiet_row<L: Lanes>(l: L, picture: &Picture, y: usize, out: &mut [f32]) {
    let Picture { light, guides } = picture;
    let stride = light.stride;
    for at in (MARGIN..stride - MARGIN).step_by(L::COUNT) {
        let centre = guides_at(l, guides.row(y), stride, at);
        let [mut mean, mut variance, mut whole] = [l.f(0.0); 3];
        for offset in -REACH..=REACH {
            let (Some(values), Some(surfaces)) = (light.row_from(y, offset), guides.row_from(y, offset)) else { continue };
            for dx in -REACH..=REACH {
                let tap = at.wrapping_add_signed(dx);
                let weight = likeness(distance(centre, guides_at(l, surfaces, stride, tap)));
                whole += weight;
                mean = l.load(values, LUMINANCE * stride + tap).mul_add(weight, mean);
                variance = l.load(values, VARIANCE * stride + tap).mul_add(weight.squared(), variance);
            }
        }
        (mean / whole).store(out, LUMINANCE * stride + at);
        (variance / whole.squared()).store(out, VARIANCE * stride + at);
    }
}
