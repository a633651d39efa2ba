//! Portals: light goes on from another place, in another direction.

use gonio_simd::{Lanes, Spectrum, Vec3};

/// Where a path goes on.
#[derive(Clone, Copy, Debug)]
pub struct Portal<L: Lanes> {
    /// World space, metres.
    pub position: Vec3<L>,
    /// World space, of any length; zero for straight on.
    pub direction: Vec3<L>,
    /// What passes.
    pub colour: Spectrum<L>,
}
