//! Columns of batch state: aligned to a cache line and padded to the widest register.

use bytemuck::{Pod, Zeroable};
use core::ops::{Deref, DerefMut};

/// Batches are padded to this many entries, so that no kernel needs a remainder loop.
pub const PADDING: usize = 16;

/// `len` rounded up to whole registers.
#[inline]
pub const fn padded(len: usize) -> usize {
    len.div_ceil(PADDING) * PADDING
}

#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct CacheLine([u32; PADDING]);

// SAFETY: sixteen integers without padding, for which all bit patterns are valid.
unsafe impl Zeroable for CacheLine {}
// SAFETY: sixteen integers without padding (64 bytes, alignment 64), for which all bit patterns are valid.
unsafe impl Pod for CacheLine {}

/// A column of 32-bit values, aligned to 64 bytes, its length a multiple of [`PADDING`].
#[derive(Clone, Default)]
pub struct Column<T: Pod = f32> {
    lines: Vec<CacheLine>,
    element: core::marker::PhantomData<T>,
}

impl<T: Pod> Column<T> {
    /// A column of zeros with room for `len` values, rounded up.
    pub fn new(len: usize) -> Self {
        const { assert!(size_of::<T>() == 4, "columns hold 32-bit values") };
        Self { lines: vec![CacheLine::zeroed(); len.div_ceil(PADDING)], element: core::marker::PhantomData }
    }
}

impl<T: Pod> Deref for Column<T> {
    type Target = [T];
    #[inline(always)]
    fn deref(&self) -> &[T] {
        bytemuck::cast_slice(&self.lines)
    }
}

impl<T: Pod> DerefMut for Column<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        bytemuck::cast_slice_mut(&mut self.lines)
    }
}

impl<T: Pod> core::fmt::Debug for Column<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "Column({} values)", self.lines.len() * PADDING)
    }
}
