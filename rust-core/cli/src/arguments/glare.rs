//! What `gonio glare` takes.

use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct GlareArguments {
    /// The fisheye picture: an EXR file with luminances in cd/m², seen from the eye along its line of sight.
    pub(crate) image: PathBuf,
    /// How the picture was projected: equidistant, equisolid, hemispherical.
    #[arg(long, value_name = "PROJECTION", default_value = "equidistant")]
    pub(crate) projection: String,
    /// Full field of view in degrees; the circle touches the picture's edges.
    #[arg(long, value_name = "DEGREES", default_value_t = 180.0)]
    pub(crate) fov: f64,
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
