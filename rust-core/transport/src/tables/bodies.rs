//! Placed meshes that hold what absorbs or refracts, among which is found what a place is in.

/// A placed mesh that is full of something.
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
    /// Each that absorbs.
    pub absorbing: Vec<Body>,
    /// Those of them that lamps may stand in.
    pub around_lights: Vec<Body>,
    /// Each that refracts.
    pub refracting: Vec<Body>,
}

impl Body {
    /// Whether a place is within the bounds.
    pub fn may_hold(&self, place: [f32; 3]) -> bool {
        let [min, max] = self.bounds;
        (0..3).all(|axis| (min[axis]..=max[axis]).contains(&place[axis]))
    }
}
