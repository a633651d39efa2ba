//! The luminous opening: which part of a luminaire shines.

use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_4;

/// What shines, in metres in the luminaire's frame, centred on the photometric centre.
///
/// LM-63's length runs along C0–C180 and its width along C90–C270. EULUMDAT's length is the lamps' direction, across C0, so that it runs
/// along C90–C270. Both are kept by axis here, and a file converted between the two formats keeps its body in step with its intensities.
///
/// A scene's lights have theirs in local units. What is flat and sends light beyond its plane all the same is as thick as a hundredth of its
/// greatest extent there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// The shape.
    pub shape: OpeningShape,
    /// Extents in metres along X (C0–C180), Y (C90–C270) and Z (up).
    pub size: [f64; 3],
    /// Heights in metres of the luminous sides towards C0, C90, C180 and C270.
    pub heights: [f64; 4],
}

/// The shape of a luminous opening (LM-63-2002 table 1 and its forerunners; EULUMDAT lines 16 to 21).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum OpeningShape {
    /// No extent.
    #[default]
    Point,
    /// Flat, facing down.
    Rectangle,
    /// With luminous sides; flat and upright where X or Y is 0.
    Box,
    /// Round or elliptic, facing down.
    Disk,
    /// Round or elliptic with luminous sides, its axis upright.
    VerticalCylinder,
    /// Its axis along C0–C180.
    CylinderAlongX,
    /// Its axis along C90–C270.
    CylinderAlongY,
    /// Sphere or ellipsoid.
    Ellipsoid,
    /// Upright round or elliptic face, looking along C0.
    DiskFacingX,
    /// Upright round or elliptic face, looking along C90.
    DiskFacingY,
}

impl Opening {
    /// An opening with sides of one height.
    pub fn new(shape: OpeningShape, size: [f64; 3]) -> Self {
        Self { shape, size, heights: [size[2]; 4] }
    }

    /// EULUMDAT's luminous area: length and width (0 for round, its diameter the length), heights at C0, C90, C180, C270; all in metres.
    pub fn from_eulumdat([length, width]: [f64; 2], heights: [f64; 4]) -> Self {
        let height = heights.iter().copied().fold(0.0, f64::max);
        let round = width == 0.0;
        let size = [if round { length } else { width }, length, height];
        let shape = match (round, height > 0.0) {
            (true, false) if length == 0.0 => OpeningShape::Point,
            (true, false) => OpeningShape::Disk,
            (true, true) => OpeningShape::VerticalCylinder,
            (false, false) => OpeningShape::Rectangle,
            (false, true) => OpeningShape::Box,
        };
        Self { shape, size, heights }
    }

    /// EULUMDAT's length and width in metres; width 0 for what is round. It knows no ellipses: they become rectangles of the same area.
    pub(crate) fn eulumdat_area(&self) -> [f64; 2] {
        let [x, y, _] = self.size;
        match self.shape {
            OpeningShape::Disk | OpeningShape::VerticalCylinder | OpeningShape::Ellipsoid if x == y => [y, 0.0],
            OpeningShape::Disk | OpeningShape::VerticalCylinder | OpeningShape::Ellipsoid => [y, x].map(|side| side * FRAC_PI_4.sqrt()),
            _ => [y, x],
        }
    }

    /// LM-63's width, length and height by the signs of 2002.
    pub(crate) fn lm63(&self) -> [f64; 3] {
        let [length, width, height] = self.size;
        match self.shape {
            OpeningShape::Point => [0.0; 3],
            OpeningShape::Rectangle => [width, length, 0.0],
            OpeningShape::Box => [width, length, height],
            OpeningShape::Disk => [-width, -length, 0.0],
            OpeningShape::VerticalCylinder => [-width, -length, height],
            OpeningShape::CylinderAlongX => [-width, length, -height],
            OpeningShape::CylinderAlongY => [width, -length, -height],
            OpeningShape::Ellipsoid => [-width, -length, -height],
            OpeningShape::DiskFacingX => [-width, 0.0, -height],
            OpeningShape::DiskFacingY => [0.0, -length, -height],
        }
    }

    /// The opening turned by quarter turns about Z, C0 to C90.
    pub(crate) fn turned(&self, quarters: usize) -> Self {
        let mut turned = *self;
        turned.heights.rotate_right(quarters % 4);
        if quarters % 2 == 1 {
            turned.size.swap(0, 1);
            turned.shape = match self.shape {
                OpeningShape::CylinderAlongX => OpeningShape::CylinderAlongY,
                OpeningShape::CylinderAlongY => OpeningShape::CylinderAlongX,
                OpeningShape::DiskFacingX => OpeningShape::DiskFacingY,
                OpeningShape::DiskFacingY => OpeningShape::DiskFacingX,
                other => other,
            };
        }
        turned
    }

    /// Whether it looks the same however it is turned about Z.
    pub fn is_round(&self) -> bool {
        let shape =
            matches!(self.shape, OpeningShape::Point | OpeningShape::Disk | OpeningShape::VerticalCylinder | OpeningShape::Ellipsoid);
        shape && self.size[0] == self.size[1] && self.heights.iter().all(|height| *height == self.heights[0])
    }
}
