//! What `gonio glare` takes.

use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct GlareArguments {
    /// The fisheye picture, seen from the eye along its line of sight: an EXR file with luminances in cd/m², or a calibrated Radiance picture (.hdr).
    pub(crate) image: PathBuf,
    /// How the picture was projected: equidistant, equisolid, hemispherical; without it as a Radiance picture's VIEW says, else equidistant.
    #[arg(long, value_name = "PROJECTION")]
    pub(crate) projection: Option<String>,
    /// Full field of view in degrees; the circle touches the picture's edges. Without it as a Radiance picture's VIEW says, else 180.
    #[arg(long, value_name = "DEGREES")]
    pub(crate) fov: Option<f64>,
    /// The channel that holds the luminances.
    #[arg(long, value_name = "QUANTITY", default_value = "luminance")]
    pub(crate) quantity: String,
    /// Luminance in cd/m² from which on a pixel glares; without it five times the picture's mean.
    #[arg(long, value_name = "LUMINANCE")]
    pub(crate) threshold: Option<f64>,
    /// Radians within which sources count as one.
    #[arg(long, value_name = "RADIANS", default_value_t = 0.2)]
    pub(crate) radius: f64,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the sources, each in a colour of its own.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(crate) output: Option<PathBuf>,
}
