//! When the shutter lets each slot's sample in. A path keeps its slot, so all its rays ask here; nothing is carried along.

use crate::tables::shutter::Shutter;
use gonio_camera::sampler::{BATCH, Runs, Sampler, dimension, morton_even};
use gonio_simd::{Execution, Lanes, One, U, dispatch};

/// Times of the samples of a batch, by the place of a slot's pixel; empty where nothing moves.
#[derive(Debug, Default)]
pub(crate) struct SlotTimes(Vec<f32>);

impl SlotTimes {
    /// All is at one time.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Draws the times of a batch whose first row of pixels is given.
    pub(crate) fn draw(&mut self, execution: Execution, shutter: Option<&Shutter>, sampler: &Sampler, runs: &Runs, first_row: u32) {
        let Some(shutter) = shutter else { return self.0.clear() };
        self.0.resize(BATCH, 0.5);
        dispatch!(execution, l => draw(l, sampler, runs, &mut self.0));
        for (slot, time) in self.0.iter_mut().enumerate() {
            let row = first_row + morton_even(U::<One>(runs.code(slot as u32) >> 1)).0;
            *time = shutter.time(*time, row);
        }
    }

    /// One after the other those of the pixels' own slots; empty where nothing moves.
    pub(crate) fn by_slot(&self) -> &[f32] {
        &self.0
    }

    /// Those of some slots of any kind, where anything moves.
    pub(crate) fn of<'a>(&'a self, slots: impl Iterator<Item = u32> + 'a) -> Option<impl Iterator<Item = f32> + 'a> {
        (!self.0.is_empty()).then(|| slots.map(|slot| self.0[slot as usize % BATCH]))
    }
}

/// Even numbers: a pixel's samples have one in each of as many parts, and are spread over the pixel and the time together.
#[inline(always)]
fn draw<L: Lanes>(l: L, sampler: &Sampler, runs: &Runs, times: &mut [f32]) {
    for slot in (0..BATCH).step_by(L::COUNT) {
        let index = runs.index(l, sampler, l.iota() + slot as u32);
        let u = sampler.third(l, index, dimension::PIXEL);
        u.store(times, slot);
    }
}
