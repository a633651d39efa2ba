//! Many values behind those of a table, by all cores: the first touch of its pages takes longer than the copy.

use rayon::prelude::*;

/// Values that one task copies at least.
const FEW: usize = 1 << 16;

/// Bytes of a page at least, and pages that one task touches at least.
const PAGE: usize = 1 << 12;
const FEW_PAGES: usize = 1 << 8;

/// Makes room for so many values more and touches its pages: many small meshes would do so one after the other.
pub(super) fn reserve<T: Copy + Default + Send>(table: &mut Vec<T>, more: usize) {
    table.reserve_exact(more);
    let pages = table.spare_capacity_mut().par_chunks_mut(PAGE / size_of::<T>()).with_min_len(FEW_PAGES);
    pages.for_each(|page| {
        page[0].write(T::default());
    });
}

/// Copies values behind those of a table.
pub(super) fn append_values<T: Copy + Send + Sync>(table: &mut Vec<T>, values: &[T]) {
    append_made(table, values, |value| value);
}

/// Puts what is made of each value behind those of a table.
pub(super) fn append_made<T: Copy + Send + Sync, U: Send>(table: &mut Vec<U>, values: &[T], make: impl Fn(T) -> U + Send + Sync) {
    table.par_extend(values.par_iter().with_min_len(FEW).map(|value| make(*value)));
}
