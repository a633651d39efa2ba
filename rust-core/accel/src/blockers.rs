//! Shadow linking: rays that some instances alone block.

use crate::hit_callback::{AnyHitTransparent, HitCallback, RayQuery, UntilOpaque};
use crate::ray::{Hit, TransparentHit};

/// Which instances block which rays: rows of bits, a bit an instance.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Blockers {
    words: usize,
    bits: Vec<u64>,
}

impl Blockers {
    /// So many rows over so many instances, none of which blocks anything.
    pub fn new(rows: usize, instances: usize) -> Self {
        let words = instances.div_ceil(64);
        Self { words, bits: vec![0; rows * words] }
    }

    /// Lets an instance block the rays of a row.
    pub fn block(&mut self, row: usize, instance: usize) {
        if let Some(word) = self.bits.get_mut(row * self.words + instance / 64) {
            *word |= 1 << (instance % 64);
        }
    }

    /// A row; empty if there is none of the number.
    fn row(&self, row: u32) -> &[u64] {
        let first = row as usize * self.words;
        self.bits.get(first..first + self.words).unwrap_or_default()
    }
}

/// [`AnyHitTransparent`] by the instances that block each ray.
pub(crate) struct AnyHitLinked<'a> {
    pub(crate) all: AnyHitTransparent<'a>,
    pub(crate) blockers: &'a Blockers,
    /// By ray.
    pub(crate) row_of: &'a [u32],
}

impl<'a> AnyHitLinked<'a> {
    pub(crate) fn new(out: &'a mut [u8], transparent: &'a mut Vec<TransparentHit>, blockers: &'a Blockers, row_of: &'a [u32]) -> Self {
        Self { all: AnyHitTransparent { occluded: out, transparent }, blockers, row_of }
    }
}

/// Passes what does not block its ray.
pub(crate) struct Filtered<'a> {
    row: &'a [u64],
    inner: UntilOpaque,
}

impl HitCallback for Filtered<'_> {
    const ORDERED: bool = UntilOpaque::ORDERED;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.inner.t_max()
    }

    #[inline(always)]
    fn add(&mut self, hit: Hit, transparent: bool) -> bool {
        let word = self.row.get(hit.instance as usize / 64).copied().unwrap_or(0);
        word >> (hit.instance % 64) & 1 != 0 && self.inner.add(hit, transparent)
    }
}

impl<'a> RayQuery for AnyHitLinked<'a> {
    type Callback = Filtered<'a>;

    fn callback(&self) -> Filtered<'a> {
        Filtered { row: &[], inner: self.all.callback() }
    }

    #[inline(always)]
    fn begin(&self, filtered: &mut Filtered<'a>, i: usize, t_max: f32) {
        filtered.row = self.blockers.row(self.row_of[i]);
        self.all.begin(&mut filtered.inner, i, t_max);
    }

    #[inline(always)]
    fn end(&mut self, i: usize, filtered: &Filtered<'a>, ended: bool) {
        self.all.end(i, &filtered.inner, ended);
    }
}
