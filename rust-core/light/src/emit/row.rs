//! Rows of the emission sampler: how one light's rays are drawn.

use gonio_simd::{F, Lanes, U, Vec3};

/// Values in a row.
pub(super) const WIDTH: usize = 16;

/// Where a row keeps what.
pub(super) mod at {
    /// Axis that directions are drawn about, 3.
    pub(crate) const POLE: usize = 0;
    /// Unit axes across it, 3 and 3.
    pub(crate) const ACROSS: usize = 3;
    /// Emitting area of flat lights and facing disks.
    pub(crate) const AREA: usize = 9;
    /// First row of the beam's table, as bits.
    pub(crate) const FIRST: usize = 10;
    /// First value of its columns, as bits.
    pub(crate) const COLUMNS: usize = 11;
    /// Rows and columns of that table, as bits.
    pub(crate) const SIZE: usize = 12;
    /// How directions are drawn, as bits.
    pub(crate) const MODEL: usize = 14;
    /// Number of the distribution of places counted from 1, as bits; 0 for even ones.
    pub(crate) const PLACES: usize = 15;
}

/// How a light's directions are drawn about its pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(super) enum Model {
    /// By the cosine.
    Cosine,
    /// By the cosine, on both sides.
    BothSides,
    /// Evenly.
    Even,
    /// By a table.
    Table,
}

/// A row in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Own<'a, L: Lanes> {
    l: L,
    rows: &'a [f32],
    base: U<L>,
}

impl<'a, L: Lanes> Own<'a, L> {
    #[inline(always)]
    pub(super) fn new(l: L, rows: &'a [f32], light: U<L>) -> Self {
        Self { l, rows, base: light * WIDTH as u32 }
    }
    #[inline(always)]
    pub(super) fn value(&self, field: usize) -> F<L> {
        self.l.gather(self.rows, self.base + field as u32)
    }
    #[inline(always)]
    pub(super) fn integer(&self, field: usize) -> U<L> {
        self.value(field).to_bits()
    }
    #[inline(always)]
    pub(super) fn vector(&self, field: usize) -> Vec3<L> {
        Vec3::gather(self.l, self.rows, self.base + field as u32)
    }
    /// Axes x and y across the pole, and the pole.
    #[inline(always)]
    pub(super) fn frame(&self) -> [Vec3<L>; 3] {
        [self.vector(at::ACROSS), self.vector(at::ACROSS + 3), self.vector(at::POLE)]
    }
}
