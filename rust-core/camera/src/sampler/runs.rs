//! Which pixels and samples the paths of a batch belong to.
//!
//! A batch has 64 runs of 64 slots, a run belongs to one zone of the tile. Usually that is the zone of the same number, one sample of each
//! pixel at a time. Where few zones are left, several samples of theirs start together, so that registers stay full.

use super::Sampler;
use super::batch::{BATCH, pixel};
use gonio_simd::{Lanes, U};
use std::ops::Range;

/// Slots of a run, pixels of a zone: those whose Morton numbers differ in the last six bits.
pub const RUN: usize = 64;
const RUN_BITS: u32 = RUN.trailing_zeros();
/// Runs of a batch, zones of a tile.
pub const RUNS: usize = BATCH / RUN;

/// The runs of one batch.
#[derive(Clone, Debug)]
pub struct Runs {
    /// By run, its zone and its sample.
    zones: [u32; RUNS],
    samples: [u32; RUNS],
    /// Bits of the runs that are wanted.
    wanted: u64,
    /// Whether runs belong to other zones than those of their own numbers.
    packed: bool,
}

impl Runs {
    /// One sample of all pixels.
    pub fn whole(sample: u32) -> Self {
        Self::spread(u64::MAX, sample)
    }

    /// The batches for some samples of the zones whose bits are set.
    pub fn batches(zones: u64, samples: Range<u32>) -> impl Iterator<Item = Self> {
        let (together, end) = (samples_together(zones), samples.end);
        samples.step_by(together).map(move |first| match together {
            1 => Self::spread(zones, first),
            _ => Self::packed(zones, first..end.min(first + together as u32)),
        })
    }

    fn spread(zones: u64, sample: u32) -> Self {
        Self { zones: std::array::from_fn(|run| run as u32), samples: [sample; RUNS], wanted: zones, packed: false }
    }

    fn packed(zones: u64, samples: Range<u32>) -> Self {
        let mut runs = Self { zones: [0; RUNS], samples: [0; RUNS], wanted: 0, packed: true };
        let pairs = samples.flat_map(|sample| bits(zones).map(move |zone| (zone, sample)));
        for (run, (zone, sample)) in pairs.enumerate() {
            (runs.zones[run], runs.samples[run]) = (zone as u32, sample);
            runs.wanted |= 1 << run;
        }
        runs
    }

    /// The runs that are wanted: first slot, Morton number of the first pixel, sample.
    fn each(&self) -> impl Iterator<Item = [u32; 3]> {
        bits(self.wanted).map(|run| [(run * RUN) as u32, self.zones[run] << RUN_BITS, self.samples[run]])
    }

    /// The same for each register of so many lanes.
    pub fn registers(&self, lanes: usize) -> impl Iterator<Item = [u32; 3]> {
        self.each().flat_map(move |[slot, code, sample]| (0..RUN as u32).step_by(lanes).map(move |at| [slot + at, code + at, sample]))
    }

    /// The Morton number of the pixel that a slot of any kind of path belongs to.
    pub fn code(&self, slot: u32) -> u32 {
        let place = slot & (BATCH as u32 - 1);
        (self.zones[(place >> RUN_BITS) as usize] << RUN_BITS) | (place & (RUN as u32 - 1))
    }

    /// The number in the tile's sequence of the sample that a slot of any kind of path belongs to.
    #[inline(always)]
    pub fn index<L: Lanes>(&self, l: L, sampler: &Sampler, slot: U<L>) -> U<L> {
        let place = pixel(slot);
        if !self.packed {
            return sampler.index(place, l.u(self.samples[0]));
        }
        let run = place >> RUN_BITS;
        let code = (l.gather_integers(&self.zones, run) << RUN_BITS) | (place & (RUN as u32 - 1));
        sampler.index(code, l.gather_integers(&self.samples, run))
    }
}

/// Brings a block's sums by slot to the Morton numbers of the pixels, where the batches of its zones were packed; of `numbers` the first
/// that is not zero counts.
pub fn unpack(zones: u64, sums: &mut [f32], numbers: bool) {
    let together = samples_together(zones);
    if together == 1 {
        return;
    }
    let packed = sums.to_vec();
    sums.fill(0.0);
    let places = (0..together).flat_map(|_| bits(zones));
    for (zone, run) in places.zip(packed.chunks_exact(RUN)) {
        for (sum, value) in sums[zone * RUN..(zone + 1) * RUN].iter_mut().zip(run) {
            if !numbers {
                *sum += value;
            } else if *sum == 0.0 {
                *sum = *value;
            }
        }
    }
}

/// The Morton numbers of the pixels that a batch's slots belong to, where it was packed for some zones; slots without a sample are missing.
pub fn codes(zones: u64) -> Vec<u32> {
    let runs = (0..samples_together(zones)).flat_map(|_| bits(zones));
    match samples_together(zones) {
        1 => (0..(RUNS * RUN) as u32).collect(),
        _ => runs.flat_map(|zone| (0..RUN).map(move |at| (zone * RUN + at) as u32)).collect(),
    }
}

/// Samples of some zones that a batch has room for.
fn samples_together(zones: u64) -> usize {
    RUNS / zones.count_ones().max(1) as usize
}

/// Numbers of the bits that are set.
fn bits(set: u64) -> impl Iterator<Item = usize> {
    (0..RUNS).filter(move |bit| set >> bit & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_simd::One;

    const ZONES: u64 = 1 << 3 | 1 << 17 | 1 << 63;

    #[test]
    fn every_pixel_of_the_zones_gets_every_sample_once() {
        for zones in [ZONES, u64::MAX, u64::MAX >> 1, u64::MAX >> 32, 1] {
            let mut found: Vec<[u32; 2]> = Runs::batches(zones, 5..21)
                .flat_map(|runs| runs.each().collect::<Vec<_>>())
                .map(|[_, code, sample]| [code, sample])
                .collect();
            found.sort_unstable();
            let expected: Vec<[u32; 2]> = bits(zones).flat_map(|zone| (5..21).map(move |sample| [(zone * RUN) as u32, sample])).collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn slots_know_their_pixel_and_sample() {
        let sampler = Sampler::new(1, [2, 3], 64);
        for zones in [ZONES, u64::MAX] {
            for runs in Runs::batches(zones, 0..16) {
                for [slot, code, sample] in runs.each() {
                    let expected = sampler.index::<One>(U(code + 5), U(sample)).0;
                    assert_eq!(runs.index(One, &sampler, U(slot + 5 + 2 * BATCH as u32)).0, expected);
                }
            }
        }
    }

    #[test]
    fn sums_come_back_to_their_pixels() {
        let (mut sums, mut first) = (vec![0.0; BATCH], vec![0.0; BATCH]);
        for runs in Runs::batches(ZONES, 0..16) {
            for [slot, code, sample] in runs.each() {
                sums[slot as usize + 5] += (code + sample) as f32;
                first[slot as usize + 5] = if sample == 0 { 0.0 } else { code as f32 };
            }
        }
        unpack(ZONES, &mut sums, false);
        unpack(ZONES, &mut first, true);
        for zone in 0..RUNS {
            let (there, code) = (ZONES >> zone & 1 == 1, (zone * RUN) as f32);
            assert_eq!(sums[zone * RUN + 5], if there { 16.0 * code + 120.0 } else { 0.0 });
            assert_eq!(first[zone * RUN + 5], if there { code } else { 0.0 });
            assert_eq!(sums[zone * RUN + 6], 0.0);
        }
    }
}
