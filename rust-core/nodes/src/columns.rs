//! Columns that kernels read and write.

use gonio_simd::{Column, F, Lanes, PADDING};

/// Most scalar inputs of a kernel.
pub(crate) const MOST_INPUTS: usize = 24;
/// Most outputs of a kernel.
pub(crate) const MOST_OUTPUTS: usize = 4;

/// An input: a column, or one register of a constant that is read again and again.
#[derive(Clone, Copy, Debug)]
struct Source<'a> {
    values: &'a [f32],
    /// All ones for a column, zero for a constant.
    mask: usize,
}

/// What a kernel reads and writes: `count` entries of each.
#[derive(Debug)]
pub struct Io<'a> {
    /// Entries, of which the last register may go beyond.
    pub count: usize,
    inputs: [Source<'a>; MOST_INPUTS],
    len: usize,
    next: usize,
    outputs: &'a mut [Column],
}

impl<'a> Io<'a> {
    /// Without inputs yet.
    pub(crate) fn new(count: usize, outputs: &'a mut [Column]) -> Self {
        Self { count, inputs: [Source { values: &[], mask: 0 }; MOST_INPUTS], len: 0, next: 0, outputs }
    }
    /// Adds a column.
    pub(crate) fn push_column(&mut self, values: &'a [f32]) {
        self.push(Source { values, mask: usize::MAX });
    }
    /// Adds a constant.
    pub(crate) fn push_constant(&mut self, values: &'a [f32; PADDING]) {
        self.push(Source { values, mask: 0 });
    }
    fn push(&mut self, source: Source<'a>) {
        self.inputs[self.len] = source;
        self.len += 1;
    }
    /// The input of a number at an entry.
    #[inline(always)]
    pub fn input<L: Lanes>(&self, l: L, number: usize, at: usize) -> F<L> {
        let source = &self.inputs[number];
        l.load(source.values, at & source.mask)
    }
    /// The first inputs at an entry.
    #[inline(always)]
    pub fn load<L: Lanes, const N: usize>(&self, l: L, at: usize) -> [F<L>; N] {
        let mut out = [l.f(0.0); N];
        for (number, value) in out.iter_mut().enumerate() {
            *value = self.input(l, number, at);
        }
        out
    }
    /// The inputs that follow those read since [`Self::rewind`].
    #[inline(always)]
    pub(crate) fn load_next<L: Lanes, const N: usize>(&mut self, l: L, at: usize) -> [F<L>; N] {
        let mut out = [l.f(0.0); N];
        for (number, value) in out.iter_mut().enumerate() {
            *value = self.input(l, self.next + number, at);
        }
        self.next += N;
        out
    }
    /// Begins anew with the first input.
    #[inline(always)]
    pub(crate) fn rewind(&mut self) {
        self.next = 0;
    }
    /// A whole output, with padding behind the entries.
    pub fn output(&mut self, number: usize) -> &mut [f32] {
        &mut self.outputs[number]
    }
    /// Writes the outputs at an entry; values beyond them are left out.
    #[inline(always)]
    pub fn store<L: Lanes, const N: usize>(&mut self, at: usize, values: [F<L>; N]) {
        for (column, value) in self.outputs.iter_mut().zip(values) {
            value.store(column, at);
        }
    }
}
