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
    /// Lens or parallel.
    pub projection: Projection,
    /// Width and height of the image plane, in the focal length's unit.
    pub aperture: [f64; 2],
    /// Shift of the image plane, same unit.
    pub aperture_offset: [f64; 2],
    /// Lens radius in metres; 0 is a pinhole.
    pub lens_radius: f64,
    /// Distance of what is sharp, metres along −z.
    pub focus_distance: f64,
    /// Near and far limits of what is seen, metres along −z.
    pub clipping: [f64; 2],
    /// Camera to world, metres; scale is left out by the renderer for perspective cameras.
    pub transform: Transform,
    /// Exposure of the colour pass.
    pub exposure: CameraExposure,
}

impl Camera {
    /// A pinhole camera with a vertical field of view in degrees and an aspect ratio (width / height).
    pub fn perspective(origin: Origin, transform: Transform, vertical_fov_deg: f64, aspect: f64) -> Self {
        let height = 2.0 * (vertical_fov_deg.to_radians() * 0.5).tan();
        Self {
            origin,
            projection: Projection::Perspective { focal_length: 1.0 },
            aperture: [height * aspect, height],
            aperture_offset: [0.0; 2],
            lens_radius: 0.0,
            focus_distance: 1.0,
            clipping: [0.0, f64::MAX],
            transform,
            exposure: CameraExposure::default(),
        }
    }
}
