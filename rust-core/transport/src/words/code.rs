//! Which light pass a contribution counts for. 0 to 2 are direct light by the kind of the first scattering.

/// From here on: indirect light by the kind of the first scattering.
pub const INDIRECT: u32 = 3;
/// Emission that the camera sees.
pub const EMISSION: u32 = 6;
/// Infinite lights that the camera sees.
pub const ENVIRONMENT: u32 = 7;
/// From here on: albedos by kind.
pub const COLOUR: u32 = 8;
/// Number of codes that have sums.
pub const COUNT: usize = 11;
/// Direct light at the first surface, shared among the kinds by what each of them scatters.
pub const SHARED: u32 = 11;
/// Bits of a code alone.
pub(crate) const CODES: u32 = 15;
/// Where expressions are followed: above this bit the state of the path that brought the light.
pub(crate) const STATE_SHIFT: u32 = 4;
/// Light of a light sample, whose last scattering is told by its shares.
pub(crate) const SAMPLED: u32 = 1 << 30;
/// A light sample behind the surface.
pub(crate) const THROUGH: u32 = 1 << 31;
