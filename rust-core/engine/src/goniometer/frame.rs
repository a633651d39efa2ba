//! The photometric frame: where the luminaire is, which way is down, and where C0 looks.

use crate::{
    error::{Error, Result},
    scene::{Origin, Transform},
};

/// A luminaire's place and axes in the world: C0 along x, C90 along y, γ = 0 against z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The origin, metres.
    pub origin: [f64; 3],
    /// Unit axes x, y, z.
    pub axes: [[f64; 3]; 3],
}

impl Default for Frame {
    fn default() -> Self {
        Self { origin: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] }
    }
}

impl Frame {
    /// The frame of something that a transform has placed: its own axes, without scale and shear; mirrored things have mirrored C planes.
    /// `down` is where γ = 0 looks and `c0` where C0 does, in the thing's own axes.
    ///
    /// # Errors
    /// Axes without length, or along each other.
    pub fn of(transform: &Transform, down: [f64; 3], c0: [f64; 3], origin: &Origin) -> Result<Self> {
        let wrong = || Error::scene(origin, "the luminaire's axes are flat or not finite; C planes cannot be laid about them");
        let across = cross(c0, down);
        let z = unit(transform.vector(down).map(|x| -x)).ok_or_else(wrong)?;
        let x = unit(without(transform.vector(c0), z)).ok_or_else(wrong)?;
        let y = unit(without(without(transform.vector(across), z), x)).ok_or_else(wrong)?;
        Ok(Self { origin: transform.columns[3], axes: [x, y, z] })
    }

    /// The map from the world to the frame.
    pub fn from_world(&self) -> Transform {
        let column = |k: usize| self.axes.map(|axis| axis[k]);
        let moved = self.point([0.0; 3]);
        Transform { columns: [column(0), column(1), column(2), moved] }
    }

    /// A world vector in the frame's axes.
    #[inline]
    pub fn direction(&self, v: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, v))
    }

    /// A world point in the frame.
    #[inline]
    pub fn point(&self, p: [f64; 3]) -> [f64; 3] {
        self.direction([0, 1, 2].map(|k| p[k] - self.origin[k]))
    }

    /// A vector of the frame's axes in the world.
    pub fn world_vector(&self, v: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| (0..3).map(|axis| self.axes[axis][k] * v[axis]).sum())
    }

    /// A point of the frame in the world.
    pub fn world_point(&self, p: [f64; 3]) -> [f64; 3] {
        let v = self.world_vector(p);
        [0, 1, 2].map(|k| v[k] + self.origin[k])
    }
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}

/// What of a vector is at right angles to a unit one.
fn without(v: [f64; 3], axis: [f64; 3]) -> [f64; 3] {
    let along = dot(v, axis);
    [0, 1, 2].map(|k| v[k] - along * axis[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(transform: &Transform, down: [f64; 3], c0: [f64; 3]) -> Result<Frame> {
        Frame::of(transform, down, c0, &Origin::new("/Lamp"))
    }

    #[test]
    fn frames_follow_what_is_placed() {
        let plain = frame(&Transform::IDENTITY, [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]).expect("axes");
        assert_eq!(plain, Frame::default());
        // Turned by 90° about z, scaled and moved.
        let turned = Transform { columns: [[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 0.0, 2.0], [1.0, 2.0, 3.0]] };
        let turned = frame(&turned, [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]).expect("axes");
        assert_eq!(turned.direction([0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]);
        assert_eq!(turned.point([1.0, 2.0, 2.0]), [0.0, 0.0, -1.0]);
        assert_eq!(turned.world_point([1.0, 0.0, 0.0]), [1.0, 3.0, 3.0]);
        assert_eq!(turned.from_world().point([1.0, 2.0, 2.0]), [0.0, 0.0, -1.0]);
        // What hangs along −y.
        let hung = frame(&Transform::IDENTITY, [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]).expect("axes");
        assert_eq!(hung.axes, [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
    }

    #[test]
    fn flat_things_have_no_frame() {
        assert!(frame(&Transform::scale(0.0), [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]).is_err());
        assert!(frame(&Transform::IDENTITY, [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]).is_err());
    }
}
