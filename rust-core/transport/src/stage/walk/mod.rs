//! Random walks under surfaces.

pub(crate) mod exit;
pub(crate) mod subsurface;
