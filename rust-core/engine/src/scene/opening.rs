//! Luminous openings: the part of a luminaire that shines.

use gonio_formats::photometry;
use serde::{Deserialize, Serialize};

/// The form of a luminous opening (LM-63-2002 table 1; EULUMDAT lines 16 to 21), in the luminaire's frame: nadir −z, C0 +x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum OpeningShape {
    /// No extent.
    #[default]
    Point,
    /// Flat, facing −z.
    Rectangle,
    /// With luminous sides, a top and a bottom.
    Box,
    /// Round or elliptic, facing −z.
    Disk,
    /// Round or elliptic, its axis z, with caps.
    VerticalCylinder,
    /// Its axis x, with caps.
    CylinderAlongX,
    /// Its axis y, with caps.
    CylinderAlongY,
    /// Sphere or ellipsoid.
    Ellipsoid,
    /// Round or elliptic, facing x.
    DiskFacingX,
    /// Round or elliptic, facing y.
    DiskFacingY,
}

/// A luminous opening about the photometric centre.
///
/// What is flat and sends light beyond its plane all the same is as thick as a hundredth of its greatest extent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// The form.
    pub shape: OpeningShape,
    /// Extents along x, y and z, local units.
    pub size: [f64; 3],
    /// Heights of a box's luminous sides towards x, y, −x and −y (C0, C90, C180, C270), from its bottom; local units.
    pub heights: [f64; 4],
}

impl Opening {
    /// An opening whose sides are as high as itself.
    pub fn new(shape: OpeningShape, size: [f64; 3]) -> Self {
        Self { shape, size, heights: [size[2]; 4] }
    }
}

impl From<photometry::OpeningShape> for OpeningShape {
    fn from(found: photometry::OpeningShape) -> Self {
        match found {
            photometry::OpeningShape::Point => Self::Point,
            photometry::OpeningShape::Rectangle => Self::Rectangle,
            photometry::OpeningShape::Box => Self::Box,
            photometry::OpeningShape::Disk => Self::Disk,
            photometry::OpeningShape::VerticalCylinder => Self::VerticalCylinder,
            photometry::OpeningShape::CylinderAlongX => Self::CylinderAlongX,
            photometry::OpeningShape::CylinderAlongY => Self::CylinderAlongY,
            photometry::OpeningShape::Ellipsoid => Self::Ellipsoid,
            photometry::OpeningShape::DiskFacingX => Self::DiskFacingX,
            photometry::OpeningShape::DiskFacingY => Self::DiskFacingY,
        }
    }
}

impl From<photometry::Opening> for Opening {
    fn from(found: photometry::Opening) -> Self {
        Self { shape: found.shape.into(), size: found.size, heights: found.heights }
    }
}
