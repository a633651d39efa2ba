//! What every command takes that writes pictures.

use clap::Args;
use std::path::PathBuf;

/// Files that pictures are written to.
#[derive(Args, Clone, Debug)]
pub(crate) struct OutputArguments {
    /// The file to write (.exr, .png, .jpg); '####' or '$F4' stand for the frame number. Several may be given.
    #[arg(long, short = 'o', value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// A deep picture (.exr, OpenEXR's deepscanline) beside the others: of each pixel its surfaces one behind the other, for compositing by depth.
    #[arg(long, value_name = "FILE")]
    pub(crate) deep: Option<PathBuf>,
    /// The picture by wavelength (.exr in the layout of Fichet and others, .hsr of Radiance): spectral radiance in bands from 380 to 780 nm, as many samples for each band as a picture has. Without -o nothing else is rendered.
    #[arg(long = "by-wavelength", value_name = "FILE")]
    pub(crate) by_wavelength: Option<PathBuf>,
    /// Width of the bands of --by-wavelength in nm: 5, 10 or 20.
    #[arg(long = "band", value_name = "NM", default_value_t = 5.0, requires = "by_wavelength")]
    pub(crate) band: f64,
    /// Stops by which the displayed picture (PNG, JPEG) is brightened; EXR files keep their values.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) exposure: f32,
    /// How radiance becomes display values: 'photographic', 'local' (the same, compressed by each pixel's surroundings), 'none' (the display's curve as it is), or 'ev100=12'. Without it 'photographic', and 'none' for stages that are lit from the camera.
    #[arg(long, value_name = "OPERATOR")]
    pub(crate) tonemap: Option<String>,
    /// Luminance that the photographic operators show as white, where the picture's log-average is 0.18.
    #[arg(long, value_name = "LUMINANCE", default_value_t = 6.0, allow_hyphen_values = true)]
    pub(crate) white: f32,
    /// Seconds in which the photographic operators follow the brightness of an animation's frames; 'inf' stays with the first. Without it each frame is by itself.
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub(crate) adaptation: Option<f64>,
    /// What display values mean: srgb, display-p3 or rec2020-pq (PNG with 16 bits, 203 cd/m² for white without tone mapping).
    #[arg(long = "color-space", value_name = "SPACE", default_value = "srgb")]
    pub(crate) color_space: String,
    /// Half floats for the passes of EXR files that are not absolute.
    #[arg(long)]
    pub(crate) half: bool,
    /// Take the noise out of the colour with Intel's Open Image Denoise (pip install pyoidn); other passes stay as they were rendered.
    #[arg(long)]
    pub(crate) denoise: bool,
}
