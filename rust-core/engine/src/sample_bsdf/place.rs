//! Where the sample is: its axes, the window that light falls on, and the box about all of it.

use crate::{
    compile::Bounds,
    error::{Error, Result},
    goniometer::Frame,
    scene::{Origin, Transform},
};

/// Rays start so far in front of the sample, over its size.
const STAND_OFF: f64 = 1e-3;
/// Rays that go along the sample start no farther away than this cosine asks for.
const LEAST_COSINE: f64 = 1e-3;
/// What leaves so close to the sample's border, over its size, leaves through its face.
const BORDER: f64 = 1e-4;

/// How the sample lies in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    /// Where the front looks: z of the sample.
    pub front: [f64; 3],
    /// y of the sample, or what is nearest to it.
    pub up: [f64; 3],
}

impl Default for Orientation {
    fn default() -> Self {
        Self { front: [0.0, 0.0, 1.0], up: [0.0, 1.0, 0.0] }
    }
}

impl Orientation {
    /// The sample's axes in the world, about the world's origin.
    ///
    /// # Errors
    /// Axes along each other, and those without length.
    pub fn frame(&self) -> Result<Frame> {
        let Self { front: [a, b, c], up: [d, e, f] } = *self;
        let across = [e * c - f * b, f * a - d * c, d * b - e * a];
        let frame = Frame::of(&Transform::IDENTITY, [-a, -b, -c], across, &Origin::default());
        frame.map_err(|_| Error::setting("up", "it lies along the front's normal, expected a direction in the sample"))
    }
}

/// A rectangle of the sample's plane: least and greatest x and y along the sample's axes from the world's origin, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Least x and y.
    pub min: [f64; 2],
    /// Greatest x and y.
    pub max: [f64; 2],
}

impl Window {
    /// Width and height.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|k| self.max[k] - self.min[k])
    }

    /// # Errors
    /// An empty window.
    pub(super) fn checked(self) -> Result<Self> {
        let fits = self.size().iter().all(|size| *size > 0.0 && size.is_finite());
        let [min, max] = [self.min, self.max];
        fits.then_some(self).ok_or_else(|| Error::setting("window", format!("{min:?} to {max:?} is empty, expected a rectangle in metres")))
    }
}

/// The box about something in the sample's axes.
pub(super) fn box_in(frame: &Frame, bounds: &Bounds) -> Bounds {
    let mut found = Bounds::default();
    for corner in 0..8 {
        let corner = [0, 1, 2].map(|k| if corner >> k & 1 == 0 { bounds.min[k] } else { bounds.max[k] });
        found.extend(frame.point(corner));
    }
    found
}

/// The window before a sample, in its place.
#[derive(Clone, Debug)]
pub(super) struct Place {
    frame: Frame,
    window: Window,
    /// The box about the sample, in its axes.
    bounds: Bounds,
    /// World position of the rebased origin.
    rebased: [f64; 3],
    size: f64,
}

impl Place {
    /// # Errors
    /// A window that lies beside the sample.
    pub(super) fn new(frame: Frame, window: Window, bounds: Bounds, rebased: [f64; 3]) -> Result<Self> {
        let beside = (0..2).any(|k| window.max[k] <= bounds.min[k] || window.min[k] >= bounds.max[k]);
        if beside {
            let [[left, low, _], [right, high, _]] = [bounds.min, bounds.max];
            let problem = format!("it lies beside the sample, which reaches from x {left} to {right} and from y {low} to {high} m");
            return Err(Error::setting("window", problem));
        }
        let mut bounds = bounds;
        // What passes by the sample within the window is no loss.
        for k in 0..2 {
            (bounds.min[k], bounds.max[k]) = (bounds.min[k].min(window.min[k]), bounds.max[k].max(window.max[k]));
        }
        let [width, height] = window.size();
        let size = width.max(height).max(bounds.max[2] - bounds.min[2]);
        Ok(Self { frame, window, bounds, rebased, size })
    }

    /// The box about the sample and the window, in the sample's axes.
    pub(super) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// A ray through a place of the window, from two numbers in [0, 1), that comes from a direction of the sample's axes: its start in the
    /// rebased world, and its direction. It meets the window where it meets the front of the box, or the back.
    pub(super) fn incoming(&self, u: [f64; 2], from: [f64; 3]) -> [[f64; 3]; 2] {
        let z = if from[2] > 0.0 { self.bounds.max[2] } else { self.bounds.min[2] };
        let [x, y] = [0, 1].map(|k| self.window.min[k] + u[k] * (self.window.max[k] - self.window.min[k]));
        let back = STAND_OFF * self.size / from[2].abs().max(LEAST_COSINE);
        let start = self.frame.world_point([x + back * from[0], y + back * from[1], z + back * from[2]]);
        [[0, 1, 2].map(|k| start[k] - self.rebased[k]), self.frame.world_vector(from.map(|x| -x))]
    }

    /// Where a ray that leaves goes to, in the sample's axes; none if it leaves sideways and not through front or back.
    pub(super) fn outgoing(&self, place: [f64; 3], direction: [f64; 3]) -> Option<[f64; 3]> {
        let place = self.frame.point([0, 1, 2].map(|k| place[k] + self.rebased[k]));
        let to = self.frame.direction(direction);
        let face = if to[2] > 0.0 { self.bounds.max[2] } else { self.bounds.min[2] };
        let way = ((face - place[2]) / to[2]).max(0.0);
        let border = BORDER * self.size;
        let inside = |k: usize| {
            let at = place[k] + way * to[k];
            at >= self.bounds.min[k] - border && at <= self.bounds.max[k] + border
        };
        (to[2] != 0.0 && inside(0) && inside(1)).then_some(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const Y: [f64; 3] = [0.0, 1.0, 0.0];
    const Z: [f64; 3] = [0.0, 0.0, 1.0];

    fn place(front: [f64; 3], up: [f64; 3]) -> Place {
        let frame = Orientation { front, up }.frame().expect("axes");
        let bounds = Bounds { min: [-1.0, -2.0, -0.1], max: [1.0, 2.0, 0.1] };
        Place::new(frame, Window { min: [0.0, 0.0], max: [0.5, 0.5] }, bounds, [3.0, 2.0, 1.0]).expect("within")
    }

    #[test]
    fn rays_meet_the_window_on_the_face() {
        for place in [place(Z, Y), place([-2.0, 0.0, 0.0], [1.0, 0.0, 3.0])] {
            for from in [[0.6, 0.0, 0.8], [0.0, -0.6, -0.8]] {
                let [start, along] = place.incoming([0.5, 0.25], from);
                let start = place.frame.point([0, 1, 2].map(|k| start[k] + place.rebased[k]));
                let along = place.frame.direction(along);
                let way = (0.1 * from[2].signum() - start[2]) / along[2];
                let met = [0, 1].map(|k| start[k] + way * along[k]);
                assert!((met[0] - 0.25).abs() < 1e-12 && (met[1] - 0.125).abs() < 1e-12 && way > 0.0, "{met:?} {way}");
            }
        }
    }

    #[test]
    fn what_leaves_by_the_sides_is_lost() {
        let place = place(Z, Y);
        let out = |at: [f64; 3], to| place.outgoing([0, 1, 2].map(|k| at[k] - place.rebased[k]), to);
        assert_eq!(out([0.0, 0.0, 0.1], [0.6, 0.0, 0.8]), Some([0.6, 0.0, 0.8]));
        assert_eq!(out([0.99, 0.0, 0.0], [0.6, 0.0, 0.8]), None);
        assert_eq!(out([0.99, 0.0, 0.0], [-0.6, 0.0, -0.8]), Some([-0.6, 0.0, -0.8]));
        assert_eq!(out([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]), None);
        assert_eq!(out([1.0, 2.0, 0.1], [0.999, 0.0, 0.04]), Some([0.999, 0.0, 0.04]));
    }

    #[test]
    fn windows_and_axes_that_make_no_sense_are_refused() {
        assert!(Orientation { front: Z, up: [0.0, 0.0, -2.0] }.frame().is_err());
        assert_eq!(Orientation::default().frame().expect("axes"), Frame::default());
        for max in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0]] {
            assert!(Window { min: [0.0; 2], max }.checked().is_err(), "{max:?}");
        }
        let bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };
        assert!(Place::new(Frame::default(), Window { min: [2.0; 2], max: [3.0; 2] }, bounds, [0.0; 3]).is_err());
    }
}
