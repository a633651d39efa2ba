//! How noisy a zone of a tile is, from two halves of its samples, and whether it goes on.
//!
//! Every other block of samples belongs to one half. A pixel's error is what separates the halves' luminances, on the scale of what is shown:
//! divided by the square root of the shown value below white, by the value itself above, whatever its sign, as Cycles has it, after Dammertz et al., A
//! Hierarchical Automatic Stopping Condition for Monte Carlo Global Illumination (2010). A zone's error is the root of the mean square over its pixels.
//!
//! Bias: for errors that are symmetric the sum of the halves, which is kept, and their difference, which decides, do not correlate. Where rare
//! samples are bright they do: a zone that has missed them looks quiet and stays dark. Taking 64 pixels together and a least number of samples
//! makes that small; neither alone does.

use super::{ZONES, raw, zone_of};
use crate::camera::sampler::BATCH;
use std::io::{Read, Result, Write};

/// Keeps values near black from counting too much.
const DARK: f64 = 1e-4;
/// Channels that a threshold is about; luminance stands for all.
const CHANNELS: f64 = 3.0;
/// Samples between two decisions, at least, and as a share of those that are there.
const LEAST_STEP: u32 = 16;
const STEP_SHARE: u32 = 8;

/// Whether zones that have so many samples are looked at, at the end of a block; `least` is the smallest number that they must have.
pub(crate) fn decides(samples: u32, least: u32) -> bool {
    samples >= least && (samples < LEAST_STEP || samples.is_multiple_of(LEAST_STEP.max((1 << samples.ilog2()) / STEP_SHARE)))
}

/// Sums of two halves of a tile's samples.
#[derive(Clone, Debug)]
pub(super) struct Halves {
    /// Luminance by the pixels' Morton numbers.
    sums: [Vec<f64>; 2],
    /// Samples by zone.
    samples: [[u32; ZONES]; 2],
}

impl Halves {
    pub(super) fn new() -> Self {
        Self { sums: [vec![0.0; BATCH], vec![0.0; BATCH]], samples: [[0; ZONES]; 2] }
    }

    /// Adds a block.
    pub(super) fn add(&mut self, number: u32, luminance: &[f32], samples: u32, zones: u64) {
        let half = (number % 2) as usize;
        self.sums[half].iter_mut().zip(luminance).for_each(|(sum, value)| *sum += f64::from(*value));
        let sampled = self.samples[half].iter_mut().enumerate().filter(|(zone, _)| zones >> zone & 1 == 1);
        sampled.for_each(|(_, count)| *count += samples);
    }

    /// Bits of the zones whose error is not below the threshold; `white` is the value that is shown as white, `pixels` how many a zone has.
    pub(super) fn noisy(&self, zones: u64, pixels: &[u8; ZONES], threshold: f32, white: f32) -> u64 {
        let noisy = |zone: &usize| zones >> zone & 1 == 1 && self.error(*zone, pixels[*zone], white) >= f64::from(threshold);
        (0..ZONES).filter(noisy).fold(0, |bits, zone| bits | 1 << zone)
    }

    /// The estimated error of a zone; infinite before both halves have samples.
    fn error(&self, zone: usize, pixels: u8, white: f32) -> f64 {
        let [first, second] = [0, 1].map(|half| f64::from(self.samples[half][zone]));
        if first == 0.0 || second == 0.0 {
            return f64::INFINITY;
        }
        let (all, scale) = (first + second, CHANNELS / f64::from(white));
        // What the mean of all has of the difference of two halves, which need not be equal.
        let share = (first * second).sqrt() / all;
        let codes = zone * (BATCH / ZONES)..(zone + 1) * (BATCH / ZONES);
        debug_assert_eq!(zone_of(codes.start), zone);
        let pixel = |code: usize| {
            let [a, b] = [self.sums[0][code], self.sums[1][code]];
            let shown = ((a + b) / all * scale).abs();
            let error = (a / first - b / second).abs() * share * scale;
            error / (DARK + if shown < 1.0 { shown.sqrt() } else { shown })
        };
        // A pixel without a value would never have enough samples.
        let squares = codes.map(pixel).filter(|error| error.is_finite()).map(|error| error * error);
        (squares.sum::<f64>() / f64::from(pixels.max(1))).sqrt()
    }

    pub(super) fn write(&self, out: &mut impl Write) -> Result<()> {
        self.sums.iter().try_for_each(|sums| out.write_all(bytemuck::cast_slice(sums)))?;
        self.samples.as_flattened().iter().try_for_each(|samples| out.write_all(&samples.to_le_bytes()))
    }

    pub(super) fn read(input: &mut impl Read) -> Result<Self> {
        let sums = [raw::array(input, BATCH)?, raw::array(input, BATCH)?];
        let mut samples = [[0; ZONES]; 2];
        for samples in samples.as_flattened_mut() {
            *samples = raw::number(input)?;
        }
        Ok(Self { sums, samples })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Halves of 16 blocks of a constant with evenly spread noise of a given deviation a sample.
    fn halves(value: f32, deviation: f32, blocks: u32) -> Halves {
        let mut halves = Halves::new();
        let mut state = 1_u32;
        let mut uniform = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0 - 0.5
        };
        for number in 0..blocks {
            // Sixteen samples' sum has four times the deviation of one.
            let block: Vec<f32> = (0..BATCH).map(|_| 16.0 * value + 4.0 * deviation * 12_f32.sqrt() * uniform()).collect();
            halves.add(number, &block, 16, u64::MAX);
        }
        halves
    }

    #[test]
    fn the_error_is_that_of_the_mean() {
        // 256 samples of deviation 0.1 about 0.08: the mean's is 0.00625, shown 3 · 0.00625 / sqrt(3 · 0.08).
        let halves = halves(0.08, 0.1, 16);
        let exact = 3.0 * 0.00625 / (DARK + 0.24_f64.sqrt());
        let mean = (0..ZONES).map(|zone| halves.error(zone, 64, 1.0)).sum::<f64>() / ZONES as f64;
        // 4096 pixels: one per cent is the standard error of their mean square's root.
        assert!((mean / exact - 1.0).abs() < 0.04, "{mean} instead of {exact}");
        // Twice as bright a white: half of the values, of which the roots are taken.
        let dimmed = halves.error(3, 64, 2.0) / halves.error(3, 64, 1.0);
        assert!((dimmed - 0.5_f64.sqrt()).abs() < 1e-3, "{dimmed}");
    }

    #[test]
    fn quiet_zones_stop_and_noisy_ones_go_on() {
        let pixels = [64; ZONES];
        assert_eq!(halves(1.0, 0.0, 4).noisy(u64::MAX, &pixels, 0.01, 1.0), 0);
        assert_eq!(halves(1.0, 4.0, 4).noisy(0b1010, &pixels, 0.01, 1.0), 0b1010);
        assert_eq!(halves(1.0, 0.0, 1).noisy(1, &pixels, 0.5, 1.0), 1, "one half knows nothing");
    }

    #[test]
    fn decisions_are_an_eighth_apart() {
        let at: Vec<u32> = (1..=1024).filter(|n| decides(*n, 64)).collect();
        assert_eq!(at[..6], [64, 80, 96, 112, 128, 144]);
        assert_eq!(at[at.len() - 4..], [832, 896, 960, 1024]);
        assert!(decides(8, 4) && !decides(24, 4));
    }
}
