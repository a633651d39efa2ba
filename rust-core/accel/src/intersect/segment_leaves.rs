//! The leaves of a tree of curves, one behind the other, each as long as it has pieces.

use super::segment_block::{COUNT_SHIFT, ROWS, Segment, Segments};
use crate::build::wide_tree::count;
use crate::tree::node::{MAX_INDEX, WIDTH};
use gonio_simd::prefetch_at;
use rayon::prelude::*;

/// Leaves begin at multiples of 16 bytes, so that 29 bits of index reach 8 GB of them.
const STEP: u32 = 2;

/// Leaves that are written as one task.
const TASK: usize = 4096;

/// All leaves of a tree. A leaf's number is the place where it begins, in steps of some words.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentLeaves {
    words: Vec<u32>,
    /// Logarithm of the words of a step.
    step: u32,
}

impl SegmentLeaves {
    /// Puts leaves behind each other, given the pieces of each as [`count`] counts them; gives the numbers of the leaves too.
    pub(crate) fn pack(leaves: &[[u32; WIDTH]], segment: impl Fn(u32) -> Segment + Sync) -> (Self, Vec<u32>) {
        if leaves.is_empty() {
            return (Self::default(), Vec::new());
        }
        let most: usize = leaves.iter().map(|pieces| ROWS * count(pieces) + WIDTH).sum();
        let mut step = STEP;
        while most >> step > MAX_INDEX {
            step += 1;
        }
        let mut places = Vec::with_capacity(leaves.len());
        let mut end = 0usize;
        for pieces in leaves {
            places.push((end >> step) as u32);
            end += (ROWS * count(pieces)).next_multiple_of(1 << step);
        }
        // Eight words are read of each row.
        let mut words = vec![0u32; end + WIDTH];
        let mut tasks = Vec::with_capacity(leaves.len().div_ceil(TASK));
        let mut rest = words.as_mut_slice();
        for (number, leaves) in leaves.chunks(TASK).enumerate() {
            let first = (places[number * TASK] as usize) << step;
            let next = places.get((number + 1) * TASK).map_or(end, |place| (*place as usize) << step);
            let (own, behind) = rest.split_at_mut(next - first);
            tasks.push((own, leaves));
            rest = behind;
        }
        tasks.into_par_iter().for_each(|(mut own, leaves)| {
            for pieces in leaves {
                let (leaf, behind) = own.split_at_mut((ROWS * count(pieces)).next_multiple_of(1 << step));
                write(leaf, &pieces[..count(pieces)], &segment);
                own = behind;
            }
        });
        (SegmentLeaves { words, step }, places)
    }

    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Bytes held.
    pub(crate) fn memory(&self) -> usize {
        self.words.capacity() * size_of::<u32>()
    }

    /// Has memory fetch a leaf: as much as most of them have.
    #[inline(always)]
    pub(crate) fn fetch(&self, number: usize) {
        if let Some(word) = self.words.get(number << self.step) {
            prefetch_at(core::ptr::from_ref(word).addr(), 4 * 64);
        }
    }

    /// A leaf.
    #[inline(always)]
    pub(crate) fn leaf(&self, number: usize) -> Segments<'_> {
        Segments::of_tree(&self.words[number << self.step..])
    }
}

fn write(leaf: &mut [u32], pieces: &[u32], segment: &impl Fn(u32) -> Segment) {
    for (lane, piece) in pieces.iter().enumerate() {
        for (row, word) in segment(*piece).words(*piece).into_iter().enumerate() {
            leaf[row * pieces.len() + lane] = word;
        }
    }
    leaf[0] |= (pieces.len() as u32 - 1) << COUNT_SHIFT;
}
