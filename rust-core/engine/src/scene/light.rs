//! Light sources.

use super::{Origin, TextureId, Transform, Visibility};
use serde::{Deserialize, Serialize};

/// How a dome's image is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum DomeFormat {
    /// By the image's shape; latitude–longitude for every shape but those that say otherwise.
    #[default]
    Automatic,
    /// Latitude–longitude by the OpenEXR convention: top row +Y, centre column +Z, longitude growing to the left.
    LatLong,
    /// A mirrored ball.
    MirroredBall,
    /// An angular map.
    Angular,
    /// A cube map unfolded to a vertical cross.
    CubeMapVerticalCross,
}

/// The emitter's geometry, in the light's own space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum LightShape {
    /// `width` along x, `height` along y, emitting along −z.
    Rectangle {
        /// Local units.
        width: f64,
        /// Local units.
        height: f64,
    },
    /// In the plane z = 0, emitting along −z.
    Disk {
        /// Local units.
        radius: f64,
    },
    /// About the origin, emitting outward.
    Sphere {
        /// Local units.
        radius: f64,
    },
    /// About the x axis, emitting outward, without caps.
    Cylinder {
        /// Local units.
        radius: f64,
        /// Local units.
        length: f64,
    },
    /// Infinitely far, shining along −z, seen under `angle_deg` (full angle).
    Distant {
        /// Full angle in degrees; 0 gives parallel light.
        angle_deg: f64,
    },
    /// All around, +Y up in the light's own space.
    Dome {
        /// Layout of the image.
        format: DomeFormat,
    },
}

/// How strong the light is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emission {
    /// Radiance (linear Rec.709, luminance in cd/m²), or what `normalized` makes of it.
    pub radiance: [f32; 3],
    /// Divide by the emitter's size factor: area in square local-stage units for shapes, projected solid angle for distant lights.
    pub normalized: bool,
    /// Metres in the unit that `normalized` measures areas in.
    pub metres_per_unit: f64,
}

/// UsdLux's shaping: what narrows the beam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shaping {
    /// Half angle in degrees beyond which nothing is emitted; `None` means no cone.
    pub cone_angle_deg: Option<f32>,
    /// 0 is a hard edge, 1 falls off from the axis on.
    pub cone_softness: f32,
    /// Exponent of the cosine to the axis.
    pub focus: f32,
    /// Colour away from the axis.
    pub focus_tint: [f32; 3],
}

impl Default for Shaping {
    fn default() -> Self {
        Self { cone_angle_deg: None, cone_softness: 0.0, focus: 0.0, focus_tint: [0.0; 3] }
    }
}

/// A light source.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Light {
    /// Where it came from.
    pub origin: Origin,
    /// The emitter.
    pub shape: LightShape,
    /// Its strength.
    pub emission: Emission,
    /// Narrowing of the beam.
    pub shaping: Shaping,
    /// Multiplies the radiance over a rectangle or a dome.
    pub texture: Option<TextureId>,
    /// Local to world, metres.
    pub transform: Transform,
    /// Which rays see the emitter itself; `shadow` is not used.
    pub visibility: Visibility,
    /// Whether things block it.
    pub casts_shadow: bool,
}
