//! Kinds of scattering.

/// Diffuse, fuzz and subsurface, reflected or transmitted.
pub(super) const DIFFUSE: u32 = 0;
/// Reflection off facets.
pub(super) const GLOSSY: u32 = 1;
/// Refraction.
pub(super) const TRANSMISSION: u32 = 2;
