//! The luminance of a pixel's surroundings: the largest that have no strong contrast in them (Reinhard et al. 2002, section 3.2).

use super::{KEY, exposure::luminance_batch};
use crate::film::Layer;
use gonio_simd::{Execution, Lanes, dispatch, padded};

/// Sizes of surroundings, each so many times the one before; the smallest is a pixel.
const SIZES: u8 = 8;
const RATIO: f32 = 1.6;
/// Standard deviation of the Gaussian that takes the surroundings of size 1, pixels.
const DEVIATION: f32 = 0.25;
/// Contrast that ends the growth, and how much less of it counts where it is dark, Reinhard's φ.
const CONTRAST: f32 = 0.05;
const SHARPNESS: f32 = 8.0;
/// Standard deviations after which a Gaussian is cut.
const REACH: f32 = 3.0;

/// A picture of one channel whose rows are padded to whole registers.
struct Plane {
    values: Vec<f32>,
    stride: usize,
}

/// By pixel, padded to a register: scaled luminance of the surroundings.
pub(super) fn surroundings(layer: &Layer, [width, height]: [usize; 2], scale: f32, execution: Execution) -> Vec<f32> {
    let stride = padded(width);
    let mut plane = Plane { values: vec![0.0; stride * height], stride };
    for (rgba, row) in layer.values.chunks_exact(4 * width).zip(plane.values.chunks_exact_mut(stride)) {
        dispatch!(execution, l => luminance_batch(l, rgba, scale, row));
    }
    let mut small = blurred(&plane, width, DEVIATION, execution);
    let (mut around, mut grows) = (small.values.clone(), vec![1.0; small.values.len()]);
    let (mut size, mut deviation) = (1.0, DEVIATION);
    for _ in 0..SIZES {
        // Of a Gaussian and one of this deviation together comes the next.
        let large = blurred(&small, width, deviation * (RATIO * RATIO - 1.0).sqrt(), execution);
        let dark = SHARPNESS.exp2() * KEY / (size * size);
        dispatch!(execution, l => grow(l, [&small.values, &large.values], dark, &mut around, &mut grows));
        (small, size, deviation) = (large, size * RATIO, deviation * RATIO);
    }
    let mut packed: Vec<f32> = around.chunks_exact(stride).flat_map(|row| &row[..width]).copied().collect();
    packed.resize(padded(width * height), 0.0);
    packed
}

/// Takes the surroundings of one size where those of all smaller sizes were without contrast, and these are.
#[inline(always)]
fn grow<L: Lanes>(l: L, [small, large]: [&[f32]; 2], dark: f32, around: &mut [f32], grows: &mut [f32]) {
    for at in (0..around.len()).step_by(L::COUNT) {
        let (inner, outer) = (l.load(small, at), l.load(large, at));
        let contrast = (inner - outer).abs() / (inner + dark);
        let still = l.load(grows, at).gt(0.5) & contrast.lt(CONTRAST);
        still.select(inner, l.load(around, at)).store(around, at);
        still.select(l.f(1.0), l.f(0.0)).store(grows, at);
    }
}

/// Blurred by a Gaussian, row by row and then column by column; edges go on beyond the picture.
fn blurred(plane: &Plane, width: usize, deviation: f32, execution: Execution) -> Plane {
    let weights = gaussian(deviation);
    let mut across = Plane { values: vec![0.0; plane.values.len()], stride: plane.stride };
    let mut both = Plane { values: vec![0.0; plane.values.len()], stride: plane.stride };
    dispatch!(execution, l => blur_rows(l, plane, width, &weights, &mut across));
    dispatch!(execution, l => blur_columns(l, &across, &weights, &mut both));
    both
}

/// Weights from the one end to the other, one in the middle, with a sum of 1.
fn gaussian(deviation: f32) -> Vec<f32> {
    let reach = (REACH * deviation).ceil() as i32;
    let weights: Vec<f32> = (-reach..=reach).map(|x| (-0.5 * (x as f32 / deviation).powi(2)).exp()).collect();
    let sum: f32 = weights.iter().sum();
    weights.iter().map(|weight| weight / sum).collect()
}

#[inline(always)]
fn blur_rows<L: Lanes>(l: L, plane: &Plane, width: usize, weights: &[f32], out: &mut Plane) {
    let reach = weights.len() / 2;
    let mut wide = vec![0.0; plane.stride + 2 * reach];
    for (row, out) in plane.values.chunks_exact(plane.stride).zip(out.values.chunks_exact_mut(plane.stride)) {
        let last = wide.len();
        wide[..reach].fill(row[0]);
        wide[reach..reach + width].copy_from_slice(&row[..width]);
        wide[reach + width..last].fill(row[width - 1]);
        for at in (0..plane.stride).step_by(L::COUNT) {
            let mut sum = l.f(0.0);
            for (offset, weight) in weights.iter().enumerate() {
                sum = l.load(&wide, at + offset).mul_add(*weight, sum);
            }
            sum.store(out, at);
        }
    }
}

#[inline(always)]
fn blur_columns<L: Lanes>(l: L, plane: &Plane, weights: &[f32], out: &mut Plane) {
    let (reach, stride) = (weights.len() / 2, plane.stride);
    let last = plane.values.len() / stride - 1;
    for (y, out) in out.values.chunks_exact_mut(stride).enumerate() {
        for at in (0..stride).step_by(L::COUNT) {
            let mut sum = l.f(0.0);
            for (offset, weight) in weights.iter().enumerate() {
                let from = (y + offset).saturating_sub(reach).min(last);
                sum = l.load(&plane.values, from * stride + at).mul_add(*weight, sum);
            }
            sum.store(out, at);
        }
    }
}
