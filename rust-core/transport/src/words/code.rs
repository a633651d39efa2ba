//! Which light pass a contribution counts for. 0 to 3 are direct light by the kind of the first scattering.

/// From here on: indirect light by the kind of the first scattering.
pub const INDIRECT: u32 = 4;
/// Emission that the camera sees.
pub const EMISSION: u32 = 8;
/// Infinite lights that the camera sees.
pub const ENVIRONMENT: u32 = 9;
/// From here on: albedos of surfaces by kind.
pub const COLOUR: u32 = 10;
/// Number of codes that have sums.
pub const COUNT: usize = 13;
/// Direct light at the first surface, shared among the kinds by what each of them scatters.
pub const SHARED: u32 = 13;
/// Bits of a code alone.
pub(crate) const CODES: u32 = 15;
/// Where expressions or openings are followed: above this bit the state of the path that brought the light.
pub(crate) const STATE_SHIFT: u32 = 4;
/// Above this bit: the number of the direction of light from given ones.
pub(crate) const NUMBER_SHIFT: u32 = 12;
/// Light of a light sample, whose last scattering is told by its shares.
pub(crate) const SAMPLED: u32 = 1 << 30;
/// A light sample behind the surface.
pub(crate) const THROUGH: u32 = 1 << 31;
