//! Luminous openings by the signs of width, length and height, which each revision of LM-63 reads in its own way.

use super::Version;
use crate::photometry::{Opening, OpeningShape};

/// The opening of width, length and height in metres, and whether the file's own revision knows these signs.
///
/// Signs of other revisions are common in the wild, and none contradicts another's where the own revision is silent.
pub(super) fn opening(dimensions: [f64; 3], version: Version) -> (Opening, bool) {
    let signs = dimensions.map(|d| if d == 0.0 { 0 } else { d.signum() as i8 });
    let own = shape(signs, version);
    let other = || [Version::Lm1995, Version::Lm2002, Version::Lm1986].into_iter().find_map(|version| shape(signs, version));
    let [width, length, height] = dimensions.map(f64::abs);
    let shape = own.or_else(other).unwrap_or(OpeningShape::Box);
    let size = match shape {
        // Where one of the diameters is left out, it is the other one.
        OpeningShape::Disk | OpeningShape::VerticalCylinder => [or(length, width), or(width, length), height],
        OpeningShape::Ellipsoid => [or(length, width), or(width, length), or(height, width)],
        OpeningShape::CylinderAlongX => [length, or(width, height), or(height, width)],
        OpeningShape::CylinderAlongY => [or(length, height), width, or(height, length)],
        _ => [length, width, height],
    };
    (Opening::new(shape, size), own.is_some())
}

fn or(value: f64, otherwise: f64) -> f64 {
    if value == 0.0 { otherwise } else { value }
}

/// The shape that a revision gives to the signs of width, length and height.
fn shape(signs: [i8; 3], version: Version) -> Option<OpeningShape> {
    let common = match signs {
        [0, 0, 0] => Some(OpeningShape::Point),
        [0 | 1, 0 | 1, 0] => Some(OpeningShape::Rectangle),
        [1, 0 | 1, 1] | [0, 1, 1] => Some(OpeningShape::Box),
        _ => None,
    };
    common.or(match version {
        Version::Lm1986 | Version::Lm1991 => shape_1986(signs),
        Version::Lm1995 => shape_1995(signs),
        Version::Lm2002 | Version::Lm2019 => shape_2002(signs),
    })
}

fn shape_1986(signs: [i8; 3]) -> Option<OpeningShape> {
    match signs {
        [-1, 0 | 1, 0] => Some(OpeningShape::Disk),
        [-1, 0, 1] => Some(OpeningShape::VerticalCylinder),
        [-1, 1, 1] => Some(OpeningShape::Ellipsoid),
        _ => None,
    }
}

fn shape_1995(signs: [i8; 3]) -> Option<OpeningShape> {
    match signs {
        [-1, 0 | 1, 0] | [1, -1, 0] => Some(OpeningShape::Disk),
        [-1, 0 | 1, 1] | [1, -1, 1] => Some(OpeningShape::VerticalCylinder),
        [-1, 0 | 1, -1] | [1, -1, -1] => Some(OpeningShape::Ellipsoid),
        [0, 1, -1] => Some(OpeningShape::CylinderAlongX),
        [1, 0, -1] => Some(OpeningShape::CylinderAlongY),
        _ => None,
    }
}

fn shape_2002(signs: [i8; 3]) -> Option<OpeningShape> {
    match signs {
        [-1, -1, 0] => Some(OpeningShape::Disk),
        [-1, -1, 1] => Some(OpeningShape::VerticalCylinder),
        [-1, -1, -1] => Some(OpeningShape::Ellipsoid),
        [-1, 1, -1] => Some(OpeningShape::CylinderAlongX),
        [1, -1, -1] => Some(OpeningShape::CylinderAlongY),
        [-1, 0, -1] => Some(OpeningShape::DiskFacingX),
        [0, -1, -1] => Some(OpeningShape::DiskFacingY),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use OpeningShape::*;

    #[test]
    fn every_shape_of_every_revision() {
        use Version::*;
        let known = [
            (Lm1986, [0.0, 0.0, 0.0], Point, [0.0, 0.0, 0.0]),
            (Lm1991, [0.3, 1.2, 0.0], Rectangle, [1.2, 0.3, 0.0]),
            (Lm1986, [0.3, 1.2, 0.1], Box, [1.2, 0.3, 0.1]),
            (Lm1986, [0.0, 1.2, 0.1], Box, [1.2, 0.0, 0.1]),
            (Lm1986, [-0.2, 0.0, 0.0], Disk, [0.2, 0.2, 0.0]),
            (Lm1986, [-0.2, 0.0, 0.1], VerticalCylinder, [0.2, 0.2, 0.1]),
            (Lm1986, [-0.2, 0.4, 0.0], Disk, [0.4, 0.2, 0.0]),
            (Lm1991, [-0.2, 0.4, 0.1], Ellipsoid, [0.4, 0.2, 0.1]),
            (Lm1995, [-0.2, 0.0, 0.0], Disk, [0.2, 0.2, 0.0]),
            (Lm1995, [-0.2, 0.0, 0.1], VerticalCylinder, [0.2, 0.2, 0.1]),
            (Lm1995, [-0.2, 0.0, -0.2], Ellipsoid, [0.2, 0.2, 0.2]),
            (Lm1995, [0.0, 1.2, -0.1], CylinderAlongX, [1.2, 0.1, 0.1]),
            (Lm1995, [1.2, 0.0, -0.1], CylinderAlongY, [0.1, 1.2, 0.1]),
            (Lm1995, [-0.2, 0.4, 0.1], VerticalCylinder, [0.4, 0.2, 0.1]),
            (Lm1995, [0.2, -0.4, 0.1], VerticalCylinder, [0.4, 0.2, 0.1]),
            (Lm1995, [-0.2, 0.4, -0.1], Ellipsoid, [0.4, 0.2, 0.1]),
            (Lm1995, [0.2, -0.4, -0.1], Ellipsoid, [0.4, 0.2, 0.1]),
            (Lm2002, [-0.2, -0.2, 0.0], Disk, [0.2, 0.2, 0.0]),
            (Lm2002, [-0.2, -0.4, 0.0], Disk, [0.4, 0.2, 0.0]),
            (Lm2019, [-0.2, -0.4, 0.1], VerticalCylinder, [0.4, 0.2, 0.1]),
            (Lm2019, [-0.2, -0.2, -0.2], Ellipsoid, [0.2, 0.2, 0.2]),
            (Lm2002, [-0.1, 1.2, -0.1], CylinderAlongX, [1.2, 0.1, 0.1]),
            (Lm2002, [1.2, -0.1, -0.1], CylinderAlongY, [0.1, 1.2, 0.1]),
            (Lm2002, [-0.2, 0.0, -0.3], DiskFacingX, [0.0, 0.2, 0.3]),
            (Lm2002, [0.0, -0.2, -0.3], DiskFacingY, [0.2, 0.0, 0.3]),
        ];
        for (version, dimensions, shape, size) in known {
            let (found, own) = opening(dimensions, version);
            assert_eq!((found.shape, found.size, own), (shape, size, true), "{version:?} {dimensions:?}");
            let (again, _) = opening(found.lm63(), Version::Lm2002);
            assert_eq!(again, found, "written and read again: {dimensions:?}");
        }
    }

    #[test]
    fn signs_of_other_revisions_are_read_as_theirs() {
        assert_eq!(opening([-0.2, 0.0, 0.0], Version::Lm2002), (Opening::new(Disk, [0.2, 0.2, 0.0]), false));
        assert_eq!(opening([-0.2, -0.2, 0.0], Version::Lm1995), (Opening::new(Disk, [0.2, 0.2, 0.0]), false));
        assert_eq!(opening([0.0, 0.0, -0.2], Version::Lm2002), (Opening::new(Box, [0.0, 0.0, 0.2]), false));
    }
}
