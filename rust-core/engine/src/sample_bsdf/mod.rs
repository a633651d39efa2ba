//! Measures the BSDF of a made-up sample (a prismatic sheet, a blind, a textile) as matrices over patches of directions, as Radiance's genBSDF
//! does: light from each patch falls on a window of the sample, and is counted by the patch that it leaves to.
//!
//! The frame is that of measured materials: x and y lie in the sample, z looks to its front, and directions point away from it.

mod incident;
mod measure;
mod place;
mod reading;
mod repeat;
mod run;
mod stop;
mod tally;

#[cfg(test)]
mod tests;

pub use crate::light_paths::Progress;
pub use measure::measure;
pub use place::{Orientation, Window};
pub use reading::{FromPatch, SampleReading, Side};
pub use repeat::MOST_REPEATS;
pub use stop::{MOST_RAYS, Stop};

use gonio_formats::bsdf::Basis;

/// What is measured of a sample, and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// How the sample lies in the world.
    pub orientation: Orientation,
    /// The part that light falls on; all of the sample without one.
    pub window: Option<Window>,
    /// How often the sample is repeated on every side, by the window's size.
    pub repeats: u32,
    /// The patches.
    pub basis: Basis,
    /// Whether light comes from the front, and from the back.
    pub sides: [bool; 2],
    /// Whether colours are kept, or luminance alone.
    pub colour: bool,
    /// When to stop.
    pub stop: Stop,
    /// Seed of the random numbers.
    pub seed: u32,
    /// Worker threads; 0 means one a core.
    pub threads: u32,
}
