//! Where north lies in a scene.

use crate::scene::Transform;

/// A scene's vertical axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y up; east is +X, north −Z.
    Y,
    /// +Z up; east is +X, north +Y.
    #[default]
    Z,
}

/// How the sky stands over a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// The vertical axis.
    pub up_axis: UpAxis,
    /// Degrees by which true north lies clockwise, seen from above, of the scene's own north.
    pub north_deg: f64,
}

impl Frame {
    /// A direction (east, north, up) in the scene.
    pub fn to_scene(&self, [east, north, up]: [f64; 3]) -> [f64; 3] {
        let (sin, cos) = self.north_deg.to_radians().sin_cos();
        let (right, ahead) = (east * cos + north * sin, north * cos - east * sin);
        match self.up_axis {
            UpAxis::Y => [right, up, -ahead],
            UpAxis::Z => [right, ahead, up],
        }
    }

    /// Of a dome whose image has the zenith on top and south in the middle.
    pub fn dome(&self) -> Transform {
        self.transform([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0])
    }

    /// Of a distant light that shines from a direction (east, north, up).
    pub fn from_direction(&self, towards: [f64; 3]) -> Transform {
        let [east, north, up] = towards;
        let flat = east.hypot(north);
        if flat < 1e-9 {
            return self.transform([1.0, 0.0, 0.0], [0.0, up, 0.0], [0.0, 0.0, up]);
        }
        let (sin, cos) = (east / flat, north / flat);
        self.transform([-cos, sin, 0.0], [-up * sin, -up * cos, flat], towards)
    }

    fn transform(&self, x: [f64; 3], y: [f64; 3], z: [f64; 3]) -> Transform {
        Transform { columns: [self.to_scene(x), self.to_scene(y), self.to_scene(z), [0.0; 3]] }
    }
}
