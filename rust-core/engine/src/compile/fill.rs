//! Many values behind those of a table, by all cores: the first touch of its pages takes longer than the copy.

use rayon::prelude::*;

/// Values that one task copies at least.
const FEW: usize = 1 << 16;

/// Copies values behind those of a table.
pub(super) fn append_values<T: Copy + Send + Sync>(table: &mut Vec<T>, values: &[T]) {
    append_made(table, values, |value| value);
}

/// Puts what is made of each value behind those of a table.
pub(super) fn append_made<T: Copy + Send + Sync, U: Send>(table: &mut Vec<U>, values: &[T], make: impl Fn(T) -> U + Send + Sync) {
    table.par_extend(values.par_iter().with_min_len(FEW).map(|value| make(*value)));
}
