//! The words of bits that paths, rays and contributions carry, below all that reads them.

pub mod code;
pub(crate) mod counts;
pub(crate) mod event;
pub(crate) mod flag;
pub mod ray_mask;
