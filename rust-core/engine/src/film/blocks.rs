//! How a pixel's samples are cut into blocks: 1, 1, 2, 4, 8, 16, 16 … of them, so that a whole picture is there early.

use std::ops::Range;

/// Most samples of a block; sums of so few keep their precision in 32 bits.
pub(crate) const MOST_BLOCK: u32 = 16;
/// Blocks before the first that has that many.
const SHORTER: u32 = 5;

/// Samples of a group of blocks. Groups are summed by themselves, so that a run of samples that starts with a group needs no blocks from before it.
pub(crate) const GROUP: u32 = 256;

/// The samples of a block of a render that has so many a pixel; empty behind its last block.
pub(crate) fn block(number: u32, samples: u32) -> Range<u32> {
    let [start, end] = [number, number.saturating_add(1)].map(|number| start(number).min(samples));
    start..end
}

/// The block that starts with a sample, or the number of blocks where the sample is the end of the render; `None` where a block would be cut.
pub(crate) fn block_at(sample: u32, samples: u32) -> Option<u32> {
    let number = match sample {
        0 => 0,
        1..=MOST_BLOCK => sample.next_power_of_two().ilog2() + 1,
        _ => sample.div_ceil(MOST_BLOCK) + SHORTER - 1,
    };
    (sample == samples || start(number) == sample).then_some(number)
}

/// Samples before a block.
fn start(number: u32) -> u32 {
    match number {
        0 => 0,
        1..=SHORTER => 1 << (number - 1),
        _ => (number - SHORTER + 1).saturating_mul(MOST_BLOCK),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_cover_all_samples_once() {
        for samples in (1..40).chain([64, 1000]) {
            let blocks: Vec<_> = (0..).map(|number| block(number, samples)).take_while(|block| !block.is_empty()).collect();
            assert_eq!(blocks.iter().map(|b| b.end - b.start).sum::<u32>(), samples);
            assert!(blocks.windows(2).all(|pair| pair[0].end == pair[1].start));
            assert!(blocks.iter().all(|block| block.end - block.start <= MOST_BLOCK));
            assert_eq!(block_at(samples, samples), Some(blocks.len() as u32));
            for (number, block) in blocks.iter().enumerate() {
                assert_eq!(block_at(block.start, samples), Some(number as u32));
            }
        }
    }

    #[test]
    fn blocks_are_not_cut() {
        let whole: Vec<u32> = (0..100).filter(|sample| block_at(*sample, 99).is_some()).collect();
        assert_eq!(whole, [0, 1, 2, 4, 8, 16, 32, 48, 64, 80, 96, 99]);
        assert!(block(u32::MAX, 1 << 24).is_empty());
    }
}
