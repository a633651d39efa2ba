//! Numbers as they lie in files.

use std::io::{Read, Result};

/// A whole number of 32 bits.
pub(super) fn number(input: &mut impl Read) -> Result<u32> {
    let mut bytes = [0; 4];
    input.read_exact(&mut bytes)?;
    Ok(u32::from_le_bytes(bytes))
}

/// So many floats.
pub(super) fn array<T: bytemuck::Pod>(input: &mut impl Read, count: usize) -> Result<Vec<T>> {
    let mut values = vec![T::zeroed(); count];
    input.read_exact(bytemuck::cast_slice_mut(&mut values))?;
    Ok(values)
}
