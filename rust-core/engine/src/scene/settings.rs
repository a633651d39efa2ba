//! How a scene is rendered.

use serde::{Deserialize, Serialize};

/// A rectangle of pixels: `[min, max)`, rows counted from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Crop {
    /// First column and row.
    pub min: [u32; 2],
    /// Behind the last column and row.
    pub max: [u32; 2],
}

/// The pixel filter; it is sampled, not splatted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Filter {
    /// Constant over the width.
    Box,
    /// Linear to zero at half the width.
    Tent,
    /// Gaussian with a standard deviation of a sixth of the width, cut at half the width.
    Gaussian,
    /// Blackman–Harris window over the width.
    BlackmanHarris,
}

/// The light transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integrator {
    /// Path tracing with multiple importance sampling.
    Path,
    /// The same, stopped after direct light.
    Direct,
}

/// An output variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Aov {
    /// Radiance times the camera's exposure, with alpha.
    Color,
    /// Coverage.
    Alpha,
    /// Distance along the camera's axis in metres.
    Depth,
    /// Shading normal, world space.
    Normal,
    /// Position in metres, world space.
    P,
    /// Directional albedo.
    Albedo,
    /// Number of the instance set, as gonio counts them.
    PrimId,
    /// Luminance in cd/m².
    Luminance,
    /// Illuminance in lux at the first surface.
    Illuminance,
}

/// How a scene is rendered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Width of a pixel over its height.
    pub pixel_aspect: f64,
    /// The part of the image that is rendered.
    pub crop: Option<Crop>,
    /// Which camera of the scene.
    pub camera: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// Seed of the random numbers.
    pub seed: u32,
    /// The light transport.
    pub integrator: Integrator,
    /// Bounces after the first hit.
    pub max_bounces: u32,
    /// The same by kind: diffuse, glossy and transmitted scatterings, and surfaces seen straight through; at most 255.
    #[serde(default = "all_bounces")]
    pub kind_bounces: [u32; 4],
    /// Lights at infinity do not cover the background.
    #[serde(default)]
    pub film_transparent: bool,
    /// Pixel filter.
    pub filter: Filter,
    /// Width of the filter in pixels.
    pub filter_width: f32,
    /// Upper limit of a direct sample's components; 0 is off.
    pub clamp_direct: f32,
    /// Upper limit of an indirect sample's components; 0 is off.
    pub clamp_indirect: f32,
    /// Worker threads; 0 means one a core.
    pub threads: u32,
    /// Passes wanted.
    pub aovs: Vec<Aov>,
    /// Stop after this many seconds; 0 is off.
    pub time_limit_s: f64,
}

/// No other limit than that of all bounces.
fn all_bounces() -> [u32; 4] {
    [255; 4]
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            resolution: [1280, 720],
            pixel_aspect: 1.0,
            crop: None,
            camera: 0,
            samples: 64,
            seed: 0,
            integrator: Integrator::Path,
            max_bounces: 12,
            kind_bounces: all_bounces(),
            film_transparent: false,
            filter: Filter::BlackmanHarris,
            filter_width: 1.5,
            clamp_direct: 0.0,
            clamp_indirect: 0.0,
            threads: 0,
            aovs: vec![Aov::Color],
            time_limit_s: 0.0,
        }
    }
}
