//! Formulas of daylight that need no scene: Perez' all-weather sky with its clearness and luminous efficacies, and the CIE's general skies.
//!
//! Where the sun stands and what the weather is, the caller knows: [`Clearness`] takes air mass and extraterrestrial irradiance as numbers.

#![forbid(unsafe_code)]

mod cie;
mod efficacy;
mod perez;

pub use cie::{CIE_TYPES, CieSky};
pub use efficacy::{diffuse_efficacy, direct_efficacy};
pub use perez::{Clearness, Irradiance, PerezSky};
