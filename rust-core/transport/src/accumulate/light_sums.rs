//! Light passes (Cycles' diffuse direct, glossy indirect, emission, environment): radiance by where it comes from.

use crate::state::columns::{add_scaled, columns3};
use gonio_camera::sampler::BATCH;
use gonio_simd::{Column, Lanes, M, Rgb, U};

/// Sums by pixel slot, one triple a code; empty where no pass asks for them.
#[derive(Debug, Default)]
pub struct LightSums {
    parts: Vec<[Column; 3]>,
}

impl LightSums {
    /// Makes room for so many sums, as many as a render's passes want.
    pub fn prepare(&mut self, count: usize) {
        self.parts.resize_with(count, || columns3(BATCH));
    }
    /// Whether anything is to be summed.
    #[inline(always)]
    pub fn wanted(&self) -> bool {
        !self.parts.is_empty()
    }
    /// The sums of a code.
    pub fn part(&self, code: u32) -> &[Column; 3] {
        &self.parts[code as usize]
    }
    /// Adds other sums of the same codes, times a factor.
    pub(crate) fn add_scaled(&mut self, other: &Self, factor: f32) {
        self.parts.iter_mut().zip(&other.parts).for_each(|(to, from)| add_scaled(to, from, factor));
    }
    /// Adds to the sums whose bits are set.
    #[inline(always)]
    pub(crate) fn add_to_many<L: Lanes>(&mut self, wanted: U<L>, slot: U<L>, value: Rgb<L>) {
        let (wanted, slots) = (wanted.to_array(), slot.to_array());
        let value = [value.r.to_array(), value.g.to_array(), value.b.to_array()];
        for lane in 0..L::COUNT {
            let mut bits = wanted[lane];
            while bits != 0 {
                let part = &mut self.parts[bits.trailing_zeros() as usize];
                for (column, value) in part.iter_mut().zip(&value) {
                    column[slots[lane] as usize] += value[lane];
                }
                bits &= bits - 1;
            }
        }
    }
    pub(crate) fn clear(&mut self) {
        self.parts.iter_mut().flatten().for_each(|column| column.fill(0.0));
    }
    /// Adds to the sums of each chosen lane's code; slots of measured paths have none.
    #[inline(always)]
    pub(crate) fn add<L: Lanes>(&mut self, codes: U<L>, slot: U<L>, value: Rgb<L>, chosen: M<L>) {
        let mut bits = (chosen & slot.lt(BATCH as u32)).bits();
        let (codes, slots) = (codes.to_array(), slot.to_array());
        let value = [value.r.to_array(), value.g.to_array(), value.b.to_array()];
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize;
            let part = &mut self.parts[codes[lane] as usize];
            for (column, value) in part.iter_mut().zip(&value) {
                column[slots[lane] as usize] += value[lane];
            }
            bits &= bits - 1;
        }
    }
}
