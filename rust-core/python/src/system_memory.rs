//! Memory where the system's allocator has all of it (Windows): it is told nothing. See `memory.rs` for the others.

/// Does nothing here.
pub(crate) fn give_back() {}

/// Does nothing here.
pub(crate) fn keep() {}
