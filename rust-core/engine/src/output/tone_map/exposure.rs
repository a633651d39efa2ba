//! How bright a picture is, and how an eye follows from frame to frame.

use super::KEY;
use crate::{film::Image, scene::Aov};
use gonio_simd::{Execution, Lanes, Rgb, dispatch, padded};

/// Pixels that make one of the low-resolution copy.
const BLOCK: usize = 16;
/// Pixels whose luminance is at hand at a time; a multiple of `BLOCK` and of all registers.
const CHUNK: usize = 4096;
/// Darker blocks are left out.
const BLACK: f64 = 1e-9;

/// The geometric mean of the luminance of a low-resolution copy of the colour pass: runs of 16 pixels first averaged, black ones left out; 0.18
/// where all are black.
pub fn log_average(image: &Image, execution: Execution) -> f32 {
    let Some(layer) = image.layer(Aov::Color) else { return KEY };
    let (mut sum, mut count) = (0.0, 0.0);
    let mut luminance = [0.0; CHUNK];
    for pixels in layer.values.chunks(4 * CHUNK).filter(|pixels| pixels.len() >= 4) {
        let length = pixels.len() / 4;
        dispatch!(execution, l => luminance_batch(l, pixels, 1.0, &mut luminance[..padded(length)]));
        for block in luminance[..length].chunks(BLOCK) {
            let mean = f64::from(total(block)) / block.len() as f64;
            if mean > BLACK && mean.is_finite() {
                sum += mean.ln();
                count += 1.0;
            }
        }
    }
    if count > 0.0 { (sum / count).exp() as f32 } else { KEY }
}

/// Luminance of interleaved RGBA.
#[inline(always)]
pub(super) fn luminance_batch<L: Lanes>(l: L, rgba: &[f32], scale: f32, out: &mut [f32]) {
    for at in (0..out.len()).step_by(L::COUNT) {
        let [r, g, b, _] = l.gather_quads(rgba, (l.iota() + at as u32) << 2);
        (Rgb::new(r, g, b).luminance() * scale).store(out, at);
    }
}

/// In four sums, which take a register's lanes.
fn total(values: &[f32]) -> f32 {
    let (fours, rest) = values.as_chunks::<4>();
    let [a, b, c, d] = fours.iter().fold([0.0; 4], |sums, four| std::array::from_fn(|k| sums[k] + four[k]));
    a + b + c + d + rest.iter().sum::<f32>()
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
