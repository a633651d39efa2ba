//! What lies between surfaces: the media that rays are in, and what these leave of light.
//!
//! [`set::MediaSet`] is what a ray is in, [`set::MediaColumns`] keep it where rays wait. Transmittance is asked for along a segment
//! ([`set::MediaSet::transmittance`], and [`track`] for media that vary), along shadow rays that pass surfaces ([`shadow`]), and by what happens between
//! surfaces (`stage/medium/way.rs`).

pub(crate) mod field;
pub(crate) mod phase;
pub mod set;
pub mod shadow;
pub(crate) mod track;
