//! What is asked for.

use super::{Angles, Frame, Rays, Screen, Stop};
use gonio_formats::photometry::Symmetry;

/// What is measured of a luminaire, and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// The photometric frame.
    pub frame: Frame,
    /// Directions.
    pub angles: Angles,
    /// When to stop.
    pub stop: Stop,
    /// The symmetry of the files that will be written, whose planes are averaged; none takes the highest that the errors bear out.
    pub symmetry: Option<Symmetry>,
    /// Sources that are known by their rays, beside the scene's lights.
    pub rays: Vec<Rays>,
    /// A screen near the luminaire.
    pub screen: Option<Screen>,
    /// Seed of the random numbers.
    pub seed: u32,
    /// Worker threads; 0 means one a core.
    pub threads: u32,
}
