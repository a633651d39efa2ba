//! Cameras.

use super::{Origin, Transform};
use serde::{Deserialize, Serialize};

/// How directions map to the image plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Projection {
    /// A lens; all in the same unit.
    Perspective {
        /// Distance from the pinhole to the image plane.
        focal_length: f64,
    },
    /// Parallel rays; the aperture is in metres.
    Orthographic,
    /// The picture's columns are longitudes, its rows latitudes, evenly.
    Equirectangular {
        /// Radians at the left and the right edge; 0 is ahead, to the right is positive.
        longitude: [f64; 2],
        /// Radians at the bottom and the top edge; 0 is the horizon.
        latitude: [f64; 2],
    },
    /// The angle to the axis grows evenly from the picture's middle to its edges, in an ellipse that touches all four; nothing is seen beyond.
    FisheyeEquidistant {
        /// Full field of view in degrees, up to 360.
        fov_deg: f64,
    },
    /// A point at angle θ to the axis falls `2 f sin(θ/2)` from the picture's middle; nothing is seen beyond the field of view.
    FisheyeEquisolid {
        /// `f`, in the unit of `sensor`.
        focal_length: f64,
        /// Full field of view in degrees, up to 360.
        fov_deg: f64,
        /// Width and height of what the picture covers.
        sensor: [f64; 2],
    },
}

/// What multiplies a camera's colour (not its absolute passes).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraExposure(pub f32);

impl Default for CameraExposure {
    fn default() -> Self {
        Self(1.0)
    }
}

/// A camera at the origin of its own space, looking along −z with y up.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Camera {
    /// Where it came from.
    pub origin: Origin,
    /// Lens, parallel or panorama.
    pub projection: Projection,
    /// Width and height of the image plane, in the focal length's unit; panoramas do not use it.
    pub aperture: [f64; 2],
    /// Shift of the image plane, same unit; for panoramas in widths and heights of the picture.
    pub aperture_offset: [f64; 2],
    /// Lens radius in metres (to the corners of a polygonal opening); 0 is a pinhole.
    pub lens_radius: f64,
    /// Distance of what is sharp in metres: along −z, for panoramas in every direction.
    pub focus_distance: f64,
    /// Blades of the lens opening: it is a regular polygon of as many corners from 3 on, round with 0; 1 and 2 count as 3.
    #[serde(default)]
    pub blades: u32,
    /// Turn of the polygon in degrees, against the clock as the camera looks; at 0 the middle of an edge lies on +x.
    #[serde(default)]
    pub blade_rotation_deg: f64,
    /// Anamorphic ratio: the opening's width is divided by it.
    #[serde(default = "one")]
    pub lens_ratio: f64,
    /// Planes in the camera's own space, metres: what lies where a plane's `a x + b y + c z + d` is below zero is not seen.
    #[serde(default)]
    pub clipping_planes: Vec<[f64; 4]>,
    /// Near and far limits of what is seen in metres: along −z, for panoramas in every direction.
    pub clipping: [f64; 2],
    /// Camera to world, metres; the axes' lengths are left out.
    pub transform: Transform,
    /// The same at evenly spaced times over the shutter, two or more; empty where it stands still.
    #[serde(default)]
    pub motion: Vec<Transform>,
    /// Exposure of the colour pass.
    pub exposure: CameraExposure,
}

fn one() -> f64 {
    1.0
}

impl Default for Camera {
    /// A pinhole with 90° of view both ways.
    fn default() -> Self {
        Self {
            origin: Origin::default(),
            projection: Projection::Perspective { focal_length: 1.0 },
            aperture: [2.0; 2],
            aperture_offset: [0.0; 2],
            lens_radius: 0.0,
            focus_distance: 1.0,
            blades: 0,
            blade_rotation_deg: 0.0,
            lens_ratio: 1.0,
            clipping_planes: Vec::new(),
            clipping: [0.0, f64::MAX],
            transform: Transform::IDENTITY,
            motion: Vec::new(),
            exposure: CameraExposure::default(),
        }
    }
}

impl Camera {
    /// A pinhole camera with a vertical field of view in degrees and an aspect ratio (width / height).
    pub fn perspective(origin: Origin, transform: Transform, vertical_fov_deg: f64, aspect: f64) -> Self {
        let height = 2.0 * (vertical_fov_deg.to_radians() * 0.5).tan();
        Self { origin, transform, aperture: [height * aspect, height], ..Self::default() }
    }
    /// A camera of parallel rays that sees `size` metres.
    pub fn orthographic(origin: Origin, transform: Transform, size: [f64; 2]) -> Self {
        Self { origin, transform, projection: Projection::Orthographic, aperture: size, ..Self::default() }
    }
    /// A panoramic pinhole camera.
    pub fn panorama(origin: Origin, transform: Transform, projection: Projection) -> Self {
        Self { origin, transform, projection, ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_of_older_bundles_have_round_lenses() {
        let mut json = serde_json::to_value(Camera::default()).expect("plain data");
        let fields = json.as_object_mut().expect("a structure");
        for name in ["blades", "blade_rotation_deg", "lens_ratio"] {
            assert!(fields.remove(name).is_some(), "{name}");
        }
        let camera: Camera = serde_json::from_value(json).expect("older form");
        assert_eq!((camera.blades, camera.blade_rotation_deg, camera.lens_ratio), (0, 0.0, 1.0));
    }
}
