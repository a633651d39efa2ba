//! Which settings look at other times than the frame.

use crate::scene::{Aov, Integrator, Settings};

/// Whether settings blur what moves. Trees of rays have no noise, and no time.
pub(super) fn blurs(settings: &Settings) -> bool {
    settings.shutter.blur && settings.integrator != Integrator::Whitted
}

/// Whether the pass of motion vectors is shown, and not empty.
pub(super) fn shows_vectors(settings: &Settings) -> bool {
    settings.aovs.contains(&Aov::Motion) && !blurs(settings)
}
