//! Kinds of scattering, for bounce limits, ray visibility and light passes (Cycles' ray types).

/// Diffuse, fuzz and subsurface, reflected or transmitted.
pub(crate) const DIFFUSE: u32 = 0;
/// Reflection off facets.
pub(crate) const GLOSSY: u32 = 1;
/// Refraction.
pub(crate) const TRANSMISSION: u32 = 2;
/// Off what floats in a medium.
pub(crate) const VOLUME: u32 = 3;
