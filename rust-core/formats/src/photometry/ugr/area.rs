//! The area that a luminous opening shows to a direction.

use crate::photometry::{Opening, OpeningShape};
use std::f64::consts::PI;

impl Opening {
    /// Square metres that the opening shows to a unit direction in the luminaire's frame (−Z is nadir, +X is C0); 0 of a point.
    ///
    /// Flat openings show their one side, bodies their outline. A box's sides are as high as each is stated.
    pub fn projected_area(&self, [x, y, z]: [f64; 3]) -> f64 {
        let [a, b, c] = self.size;
        let [h0, h90, h180, h270] = self.heights;
        // Two half axes, and what they show along the two axes of their plane.
        let round = |p: f64, q: f64, along: f64, across: f64| (p * along).hypot(q * across);
        match self.shape {
            OpeningShape::Point => 0.0,
            OpeningShape::Rectangle => a * b * (-z).max(0.0),
            OpeningShape::Disk => PI / 4.0 * a * b * (-z).max(0.0),
            OpeningShape::Box => {
                let sides = b * (h0 * x.max(0.0) + h180 * (-x).max(0.0)) + a * (h90 * y.max(0.0) + h270 * (-y).max(0.0));
                a * b * z.abs() + sides
            }
            OpeningShape::VerticalCylinder => PI / 4.0 * a * b * z.abs() + c * round(b, a, x, y),
            OpeningShape::CylinderAlongX => PI / 4.0 * b * c * x.abs() + a * round(c, b, y, z),
            OpeningShape::CylinderAlongY => PI / 4.0 * a * c * y.abs() + b * round(c, a, x, z),
            OpeningShape::Ellipsoid => PI / 4.0 * (b * c * x).hypot(a * c * y).hypot(a * b * z),
            OpeningShape::DiskFacingX => PI / 4.0 * b * c * x.max(0.0),
            OpeningShape::DiskFacingY => PI / 4.0 * a * c * y.max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(shape: OpeningShape, direction: [f64; 3]) -> f64 {
        Opening::new(shape, [0.6, 1.2, 0.1]).projected_area(direction)
    }

    #[test]
    fn along_the_axes_a_body_shows_its_faces() {
        let down = [0.0, 0.0, -1.0];
        for (shape, [x, y, z]) in [
            (OpeningShape::Rectangle, [0.0, 0.0, 0.72]),
            (OpeningShape::Box, [0.12, 0.06, 0.72]),
            (OpeningShape::Disk, [0.0, 0.0, PI / 4.0 * 0.72]),
            (OpeningShape::VerticalCylinder, [0.12, 0.06, PI / 4.0 * 0.72]),
            (OpeningShape::CylinderAlongX, [PI / 4.0 * 0.12, 0.06, 0.72]),
            (OpeningShape::CylinderAlongY, [0.12, PI / 4.0 * 0.06, 0.72]),
            (OpeningShape::Ellipsoid, [PI / 4.0 * 0.12, PI / 4.0 * 0.06, PI / 4.0 * 0.72]),
            (OpeningShape::DiskFacingX, [PI / 4.0 * 0.12, 0.0, 0.0]),
            (OpeningShape::DiskFacingY, [0.0, PI / 4.0 * 0.06, 0.0]),
            (OpeningShape::Point, [0.0; 3]),
        ] {
            for (direction, expected) in [([1.0, 0.0, 0.0], x), ([0.0, 1.0, 0.0], y), (down, z)] {
                assert!((shown(shape, direction) - expected).abs() < 1e-12, "{shape:?} {direction:?}");
            }
        }
        // Flat things have no back.
        assert_eq!(shown(OpeningShape::Rectangle, [0.0, 0.0, 1.0]), 0.0);
    }

    #[test]
    fn sides_count_with_the_height_that_each_has() {
        let opening = Opening { heights: [0.1, 0.0, 0.05, 0.0], ..Opening::new(OpeningShape::Box, [0.6, 1.2, 0.1]) };
        assert!((opening.projected_area([1.0, 0.0, 0.0]) - 0.12).abs() < 1e-12);
        assert!((opening.projected_area([-1.0, 0.0, 0.0]) - 0.06).abs() < 1e-12);
        assert_eq!(opening.projected_area([0.0, 1.0, 0.0]), 0.0);
    }
}
