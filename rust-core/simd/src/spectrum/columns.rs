//! Light that waits between stages: plain columns, and items that one load reads.

use super::Spectrum;
use crate::{Column, F, Lanes, M, U};

/// Spectra in plain columns, one for each component.
#[derive(Clone, Debug, Default)]
pub struct SpectrumColumns([Column; 3]);

impl SpectrumColumns {
    /// Room for `len` spectra, rounded up to whole registers.
    pub fn new(len: usize) -> Self {
        Self([Column::new(len), Column::new(len), Column::new(len)])
    }
    /// All columns, to be compared number by number.
    pub fn columns(&self) -> &[Column] {
        &self.0
    }
    /// A register of spectra from the one at `at` on.
    #[inline(always)]
    pub fn load<L: Lanes>(&self, l: L, at: usize) -> Spectrum<L> {
        let [r, g, b] = &self.0;
        Spectrum { r: l.load(r, at), g: l.load(g, at), b: l.load(b, at) }
    }
    /// The spectra of these places.
    #[inline(always)]
    pub fn gather<L: Lanes>(&self, l: L, index: U<L>) -> Spectrum<L> {
        let [r, g, b] = &self.0;
        Spectrum { r: l.gather(r, index), g: l.gather(g, index), b: l.gather(b, index) }
    }
    /// Writes a register of spectra from the place `at` on.
    #[inline(always)]
    pub fn store<L: Lanes>(&mut self, value: Spectrum<L>, at: usize) {
        let [r, g, b] = &mut self.0;
        value.r.store(r, at);
        value.g.store(g, at);
        value.b.store(b, at);
    }
    /// Writes the chosen lanes behind the first `len` spectra, and something behind them up to a whole register.
    #[inline(always)]
    pub fn append<L: Lanes>(&mut self, value: Spectrum<L>, chosen: M<L>, len: usize) {
        let [r, g, b] = &mut self.0;
        value.r.append(chosen, r, len);
        value.g.append(chosen, g, len);
        value.b.append(chosen, b, len);
    }
    /// Sets all to no light.
    pub fn clear(&mut self) {
        self.0.iter_mut().for_each(|column| column.fill(0.0));
    }
    /// Sum of the components' magnitudes of one spectrum.
    pub fn magnitude_of(&self, at: usize) -> f32 {
        self.0.iter().map(|column| column[at].abs()).sum()
    }
    /// Multiplies one spectrum by one of others.
    pub fn multiply(&mut self, at: usize, factors: &Self, from: usize) {
        self.0.iter_mut().zip(&factors.0).for_each(|(column, factors)| column[at] *= factors[from]);
    }
    /// Multiplies one spectrum by a number.
    pub fn scale(&mut self, at: usize, factor: f32) {
        self.0.iter_mut().for_each(|column| column[at] *= factor);
    }
    /// Adds one spectrum of others so many times.
    pub fn add(&mut self, at: usize, others: &Self, from: usize, times: f32) {
        self.0.iter_mut().zip(&others.0).for_each(|(column, others)| column[at] += others[from] * times);
    }
    /// Copies one spectrum over another.
    pub fn copy(&mut self, from: usize, to: usize) {
        self.0.iter_mut().for_each(|column| column[to] = column[from]);
    }
}

/// Spectra with a number each, in items of four words: one load a lane and a transposition read chosen ones.
#[derive(Clone, Debug, Default)]
pub struct SpectrumItems(Column);

/// Words of an item.
const WORDS: usize = 4;

impl SpectrumItems {
    /// Room for `len` items, rounded up to whole registers.
    pub fn new(len: usize) -> Self {
        Self(Column::new(WORDS * len))
    }
    /// The spectra and numbers of these items.
    #[inline(always)]
    pub fn gather<L: Lanes>(&self, l: L, index: U<L>) -> (Spectrum<L>, F<L>) {
        let [r, g, b, number] = l.gather_quads(&self.0, index << WORDS.ilog2());
        (Spectrum { r, g, b }, number)
    }
    /// Writes a register of items from the one at `at` on.
    #[inline(always)]
    pub fn store<L: Lanes>(&mut self, value: Spectrum<L>, number: F<L>, at: usize) {
        number.lanes().store_quads([value.r, value.g, value.b, number], &mut self.0, at);
    }
    /// Writes the chosen lanes' items behind the first `len` items, and something behind them up to a whole register.
    #[inline(always)]
    pub fn append<L: Lanes>(&mut self, value: Spectrum<L>, number: F<L>, chosen: M<L>, len: usize) {
        number.lanes().append_quads([value.r, value.g, value.b, number], chosen, &mut self.0, len);
    }
    /// Writes the first lanes to items of these places.
    #[inline(always)]
    pub fn scatter<L: Lanes>(&mut self, value: Spectrum<L>, number: F<L>, places: &[u32]) {
        let words = [value.r.to_array(), value.g.to_array(), value.b.to_array(), number.to_array()];
        for (lane, place) in places.iter().enumerate() {
            let item = &mut self.0[WORDS * *place as usize..][..WORDS];
            item.iter_mut().zip(&words).for_each(|(word, lanes)| *word = lanes[lane]);
        }
    }
    /// Multiplies the spectra of items of these places by the first lanes; their numbers stay.
    #[inline(always)]
    pub fn multiply<L: Lanes>(&mut self, factor: Spectrum<L>, places: &[u32]) {
        let factors = [factor.r.to_array(), factor.g.to_array(), factor.b.to_array()];
        for (lane, place) in places.iter().enumerate() {
            let item = &mut self.0[WORDS * *place as usize..][..WORDS];
            item.iter_mut().zip(&factors).for_each(|(word, lanes)| *word *= lanes[lane]);
        }
    }
    /// Makes the spectrum of an item this one; its number stays.
    pub fn set(&mut self, spectrum: [f32; 3], at: usize) {
        self.0[WORDS * at..][..spectrum.len()].copy_from_slice(&spectrum);
    }
    /// Copies one item over another.
    pub fn copy(&mut self, from: usize, to: usize) {
        self.0.copy_within(WORDS * from..WORDS * (from + 1), WORDS * to);
    }
}
