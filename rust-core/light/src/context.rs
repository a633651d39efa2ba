//! Where light is wanted.

use gonio_simd::{Lanes, U, Vec3};

/// A point that asks for light (pbrt's `LightSampleContext`): the vertex that next event estimation lights, or the one that sent the ray which found a light.
#[derive(Clone, Copy, Debug)]
pub struct LightSampleContext<L: Lanes> {
    /// Metres.
    pub position: Vec3<L>,
    /// Unit normal; zero where no side is dark, as there is no surface.
    pub normal: Vec3<L>,
    /// Its class as a receiver of light; 0 sees all lights.
    pub receiver: U<L>,
}
