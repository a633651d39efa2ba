//! Placed meshes that hold what absorbs, among which is found what a place is in.

/// A placed mesh that is full of what absorbs.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its instance.
    pub instance: u32,
    /// Least and greatest coordinates, rebased world space, metres; where it stands at the middle of the shutter.
    pub bounds: [[f32; 3]; 2],
}

/// All of a scene.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Each of them.
    pub all: Vec<Body>,
    /// Those that lamps may stand in.
    pub around_lights: Vec<Body>,
}
