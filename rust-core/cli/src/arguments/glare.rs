//! What `gonio glare` takes.

use super::number::finite;
use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct GlareArguments {
    /// The picture, seen from the eye along its line of sight: an EXR file with luminances in cd/m², or a calibrated Radiance picture (.hdr).
    pub(crate) image: PathBuf,
    /// How the picture was projected: perspective, equidistant, equisolid, hemispherical; without it as the file says.
    #[arg(long, value_name = "PROJECTION")]
    pub(crate) projection: Option<String>,
    /// Full field of view in degrees, of a perspective across; a fisheye's circle touches the picture's edges, and is 180 unless stated.
    #[arg(long, value_name = "DEGREES", requires = "projection", value_parser = finite::<f64>)]
    pub(crate) fov: Option<f64>,
    /// The channel that holds the luminances.
    #[arg(long, value_name = "QUANTITY", default_value = "luminance")]
    pub(crate) quantity: String,
    /// Luminance in cd/m² from which on a pixel glares; 5x for five times the picture's mean.
    #[arg(long, value_name = "LUMINANCE", default_value = "2000")]
    pub(crate) threshold: String,
    /// Luminance in cd/m² from which on pixels of a source are one of their own, as the sun in a window; 0 for never.
    #[arg(long, value_name = "LUMINANCE", default_value_t = 50_000.0, value_parser = finite::<f64>)]
    pub(crate) peak: f64,
    /// Illuminance at the eye across the line of sight in lx, measured otherwise: a picture of less than a hemisphere does not tell it.
    #[arg(long, value_name = "LUX", value_parser = finite::<f64>)]
    pub(crate) illuminance: Option<f64>,
    /// Opening angle in radians of the circle within which what glares is of one source.
    #[arg(long, value_name = "RADIANS", default_value_t = 0.2, value_parser = finite::<f64>)]
    pub(crate) radius: f64,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the sources, each in a colour of its own.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(crate) output: Option<PathBuf>,
}
