//! How bright a picture is, and how an eye follows from frame to frame.

use super::{CHUNK, KEY};
use crate::{colour::luminance_of_pixel, film::Image, scene::Aov};
use gonio_simd::{Execution, Lanes, Rgb, dispatch};

/// Pixels that make one of the low-resolution copy.
const BLOCK: usize = 16;
/// Blocks of a large picture that are looked at, at least.
const ENOUGH: usize = 1 << 16;
/// Darker blocks are left out.
const BLACK: f32 = 1e-9;

/// The geometric mean of the luminance of a low-resolution copy of the colour pass: runs of 16 pixels first averaged, of large pictures every few
/// runs, black ones left out; 0.18 where all are black.
pub fn log_average(image: &Image, execution: Execution) -> f32 {
    let Some(layer) = image.layer(Aov::Color) else { return KEY };
    let (blocks, rest) = layer.values.as_chunks::<{ 4 * BLOCK }>();
    let (mut sum, mut count) = (0.0, 0.0);
    let mut add = |mean: f32, logarithm: f64| {
        if mean > BLACK && mean.is_finite() {
            sum += logarithm;
            count += 1.0;
        }
    };
    let mut copy = SmallCopy { means: [0.0; CHUNK], logarithms: [0.0; CHUNK] };
    // Odd, so that columns of pictures are not passed over.
    let step = (blocks.len() / (2 * ENOUGH)) * 2 + 1;
    for blocks in blocks.chunks(CHUNK * step) {
        dispatch!(execution, l => shrink(l, blocks.as_flattened(), step, &mut copy));
        copy.means
            .iter()
            .zip(&copy.logarithms)
            .take(blocks.len().div_ceil(step))
            .for_each(|(mean, logarithm)| add(*mean, f64::from(*logarithm)));
    }
    if !rest.is_empty() {
        let total: f32 = rest.as_chunks::<4>().0.iter().map(|[r, g, b, _]| luminance_of_pixel([*r, *g, *b])).sum();
        let mean = total / (rest.len() / 4) as f32;
        add(mean, f64::from(mean).ln());
    }
    if count > 0.0 { (sum / count).exp() as f32 } else { KEY }
}

/// A part of the low-resolution copy.
struct SmallCopy {
    means: [f32; CHUNK],
    logarithms: [f32; CHUNK],
}

/// Averages the luminance of every `step`-th block of interleaved RGBA, a block a lane.
#[inline(always)]
fn shrink<L: Lanes>(l: L, rgba: &[f32], step: usize, copy: &mut SmallCopy) {
    for at in (0..rgba.len().div_ceil(4 * BLOCK * step)).step_by(L::COUNT) {
        let first = (l.iota() + at as u32) * ((4 * BLOCK * step) as u32);
        let mut sum = l.f(0.0);
        for pixel in 0..BLOCK as u32 {
            let [r, g, b, _] = l.gather_quads(rgba, first + 4 * pixel);
            sum += Rgb::new(r, g, b).luminance();
        }
        let mean = sum * (1.0 / BLOCK as f32);
        mean.store(&mut copy.means, at);
        mean.max(BLACK).ln().store(&mut copy.logarithms, at);
    }
}

/// Luminance of interleaved RGBA.
#[inline(always)]
pub(super) fn luminance_batch<L: Lanes>(l: L, rgba: &[f32], scale: f32, out: &mut [f32]) {
    for at in (0..out.len()).step_by(L::COUNT) {
        let [r, g, b, _] = l.gather_quads(rgba, (l.iota() + at as u32) << 2);
        (Rgb::new(r, g, b).luminance() * scale).store(out, at);
    }
}

/// An eye that adapts to the brightness of an animation's frames: exponentially in the logarithm, with a time constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptation {
    seconds: f64,
    /// Logarithm of what it is adapted to, and when.
    level: Option<(f64, f64)>,
}

impl Adaptation {
    /// An eye that takes so many seconds to go 63 % of the way; infinite ones stay with the first frame.
    pub fn new(seconds: f64) -> Self {
        Self { seconds, level: None }
    }

    /// The log-average luminance it is adapted to at a frame's time in seconds, whose own is `measured`.
    pub fn follow(&mut self, measured: f32, time: f64) -> f32 {
        let goal = f64::from(measured).ln();
        let level = self.level.map_or(goal, |(level, before)| {
            let share = if self.seconds > 0.0 { -((before - time).min(0.0) / self.seconds).exp_m1() } else { 1.0 };
            level + share * (goal - level)
        });
        self.level = Some((level, time));
        level.exp() as f32
    }
}
