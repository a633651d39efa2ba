//! What the command line takes.

use clap::{Args, Parser, Subcommand, ValueEnum};
use gonio::bench::Stage;
use std::path::PathBuf;

/// Physically exact rendering of USD stages, with answers in cd/m² and lux.
#[derive(Debug, Parser)]
#[command(name = "gonio", version, about, propagate_version = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a USD stage to EXR, PNG or JPEG.
    Render(Box<RenderOptions>),
    /// Join the parts of a render's samples that 'gonio render --samples A:B --checkpoint PART' wrote, to the bits of one whole render.
    Merge(MergeArguments),
    /// Say what would be rendered: counts, memory, lights with units, what is unsupported.
    Info(Box<InfoOptions>),
    /// Compare two EXR files: relative mean squared error and block differences.
    Compare(CompareOptions),
    /// Dim and recolour the light groups of a rendered EXR file.
    Relight(RelightOptions),
    /// Say what an IES or EULUMDAT file holds: flux, efficacy, beam and field angle, problems; draw and convert it.
    Photometry(PhotometryOptions),
    /// Say what a measured material's file holds: angles, albedo, reciprocity, energy, problems; draw, convert and fit it.
    ///
    /// Takes MERL .binary, RGL .bsdf, pBRDF .pbsdf, UTIA .bin, BSDF XML of Radiance and WINDOW, Zemax .bsdf and gonio's own .gbsdf; content
    /// decides, not the name. Front is the side of the normal; 'reflected' and 'transmitted' are shares of the light that arrives from the
    /// angle named.
    #[command(after_long_help = BSDF_EXAMPLES)]
    Bsdf(BsdfOptions),
    /// Measure light at points and on calculation grids of a USD stage, in lux, cd/m² or per cent of the daylight outside.
    ///
    /// Measures what the stage's gonio:grid and gonio:meter attributes ask for, the prims that --grid names, and the points of --at.
    #[command(after_long_help = MEASURE_EXAMPLES)]
    Measure(Box<MeasureOptions>),
    /// Draw the luminance or the illuminance of an EXR file in fixed steps with a legend, or as isolines over the picture.
    Falsecolor(FalsecolorOptions),
    /// Rate glare in a fisheye picture of luminances: UGR and DGP, and the sources that cause it.
    Glare(GlareArguments),
    /// Measure every stage of rendering at every SIMD level against one lane.
    Bench(BenchOptions),
}

/// What of the stage is read.
#[derive(Args, Clone, Debug)]
pub(super) struct StageArguments {
    /// The stage: a .usd, .usda, .usdc or .usdz file.
    pub(super) stage: PathBuf,
    /// Purposes shown beside 'default': render, proxy, guide, separated by commas; without it those of the render settings, or render.
    #[arg(long, value_name = "PURPOSES", value_delimiter = ',')]
    pub(super) purposes: Vec<String>,
    /// How finely subdivision surfaces are refined.
    #[arg(long, short = 'C', value_enum, default_value_t = ComplexityArgument::High)]
    pub(super) complexity: ComplexityArgument,
    /// Read only these prims (and what they need), separated by commas.
    #[arg(long, value_name = "PRIMPATHS", value_delimiter = ',')]
    pub(super) mask: Vec<String>,
    /// Choose a variant: '/Prim{set=variant}'; may be given several times.
    #[arg(long, value_name = "SELECTION")]
    pub(super) variant: Vec<String>,
    /// A layer put on top of the stage.
    #[arg(long = "session-layer", alias = "sessionLayer", value_name = "LAYER")]
    pub(super) session_layer: Option<PathBuf>,
    /// The RenderSettings prim to follow.
    #[arg(long, short = 's', alias = "renderSettingsPrimPath", value_name = "PRIMPATH")]
    pub(super) settings: Option<String>,
    /// Treat every warning as an error.
    #[arg(long)]
    pub(super) strict: bool,
    /// List all warnings and notes, and timings.
    #[arg(long, short = 'v')]
    pub(super) verbose: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum ComplexityArgument {
    /// No refinement.
    Low,
    /// Once.
    Medium,
    /// Twice.
    High,
    /// Three times.
    Veryhigh,
}

#[derive(Args, Debug)]
pub(super) struct RenderOptions {
    #[command(flatten)]
    pub(super) stage: StageArguments,
    #[command(flatten)]
    pub(super) files: OutputArguments,
    /// Camera by name or path; without it the stage's own choice.
    #[arg(long, short = 'c', alias = "cam", value_name = "CAMERA")]
    pub(super) camera: Option<String>,
    /// Frames: '1', '1:10', '1:10x2', separated by commas.
    #[arg(long, short = 'f', alias = "frame", value_name = "FRAMES")]
    pub(super) frames: Option<String>,
    /// Width and height in pixels.
    #[arg(long, num_args = 2, value_names = ["WIDTH", "HEIGHT"], overrides_with = "res")]
    pub(super) res: Option<Vec<u32>>,
    /// Width in pixels; the height follows the camera's shape.
    #[arg(long = "image-width", short = 'w', alias = "imageWidth", value_name = "WIDTH", conflicts_with = "res")]
    pub(super) image_width: Option<u32>,
    /// Factor on the resolution.
    #[arg(long = "res-scale", value_name = "FACTOR", default_value_t = 1.0)]
    pub(super) res_scale: f64,
    /// Samples a pixel.
    #[arg(long, short = 'p', alias = "pixel-samples", value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub(super) spp: Option<u32>,
    /// Stop sampling where the estimated noise is below this, on Cycles' scale: 0.01 is a clean picture, 0.1 a preview; 0 is off. --spp is the most that a pixel gets, the pass sample_count shows what it got.
    #[arg(long = "noise-threshold", value_name = "ERROR", default_value_t = 0.0)]
    pub(super) noise_threshold: f32,
    /// Samples a pixel before its noise is estimated; 0 leaves it to the threshold (64 for 0.01).
    #[arg(long = "min-spp", value_name = "COUNT", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1 << 20))]
    pub(super) min_spp: u32,
    /// Bounces after the first surface.
    #[arg(long = "max-bounces", value_name = "COUNT")]
    pub(super) max_bounces: Option<u32>,
    /// The light transport: full global illumination, or direct light alone.
    #[arg(long, value_enum, default_value_t = IntegratorArgument::Path)]
    pub(super) integrator: IntegratorArgument,
    /// The pixel filter.
    #[arg(long, value_enum, default_value_t = FilterArgument::BlackmanHarris)]
    pub(super) filter: FilterArgument,
    /// Width of the pixel filter in pixels.
    #[arg(long = "filter-width", value_name = "PIXELS", default_value_t = 1.5)]
    pub(super) filter_width: f32,
    /// Passes to write, separated by commas: color, alpha, depth, normal, P, albedo, primId, luminance, illuminance, uv, mist, emission, environment, object_index, material_index, sample_count, denoising_normal, denoising_albedo, and direct, indirect and color of diffuse, glossy and transmission (diffuse_direct).
    #[arg(long, value_name = "PASSES", value_delimiter = ',')]
    pub(super) aov: Vec<String>,
    /// Write a pass for every light group, those that `gonio:lightGroup` names and 'other' for all other lights; together they are the colour.
    #[arg(long = "light-groups")]
    pub(super) light_groups: bool,
    /// Part of the picture: left, top, right, bottom in pixels, or from 0 to 1 if one has a decimal point.
    #[arg(long, num_args = 4, value_names = ["X0", "Y0", "X1", "Y1"], allow_hyphen_values = true, overrides_with = "crop")]
    pub(super) crop: Option<Vec<String>>,
    /// Stop after this many seconds, with whole passes over the picture.
    #[arg(long = "time-limit", aliases = ["timelimit", "time"], value_name = "SECONDS", default_value_t = 0.0)]
    pub(super) time_limit: f64,
    /// Seed of the random numbers.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    pub(super) seed: u32,
    /// Worker threads; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 0)]
    pub(super) threads: u32,
    /// Limit of a direct sample's components in nits; 0 is off.
    #[arg(long = "clamp-direct", value_name = "NITS", default_value_t = 0.0)]
    pub(super) clamp_direct: f32,
    /// Limit of an indirect sample's components in nits; 0 is off.
    #[arg(long = "clamp-indirect", value_name = "NITS", default_value_t = 0.0)]
    pub(super) clamp_indirect: f32,
    /// No neutral dome for stages without lights.
    #[arg(long = "disable-camera-light", alias = "disableCameraLight")]
    pub(super) disable_camera_light: bool,
    /// List the stage's cameras and end.
    #[arg(long = "list-cameras")]
    pub(super) list_cameras: bool,
    /// Write nothing but errors.
    #[arg(long, short = 'q')]
    pub(super) quiet: bool,
    #[command(flatten)]
    pub(super) checkpoint: CheckpointArguments,
    #[command(flatten)]
    pub(super) daylight: DaylightArguments,
}

/// Files that pictures are written to.
#[derive(Args, Clone, Debug)]
pub(super) struct OutputArguments {
    /// The file to write (.exr, .png, .jpg); '####' or '$F4' stand for the frame number. Several may be given.
    #[arg(long, short = 'o', value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Stops by which the displayed picture (PNG, JPEG) is brightened; EXR files keep their values.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(super) exposure: f32,
    /// How radiance becomes display values: 'photographic', 'local' (the same, compressed by each pixel's surroundings), 'none' (the display's curve as it is), or 'ev100=12'.
    #[arg(long, value_name = "OPERATOR", default_value = "photographic")]
    pub(super) tonemap: String,
    /// Luminance that the photographic operators show as white, where the picture's log-average is 0.18.
    #[arg(long, value_name = "LUMINANCE", default_value_t = 6.0, allow_hyphen_values = true)]
    pub(super) white: f32,
    /// Seconds in which the photographic operators follow the brightness of an animation's frames; 'inf' stays with the first. Without it each frame is by itself.
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub(super) adaptation: Option<f64>,
    /// What display values mean: srgb, display-p3 or rec2020-pq (PNG with 16 bits, 203 cd/m² for white without tone mapping).
    #[arg(long = "color-space", value_name = "SPACE", default_value = "srgb")]
    pub(super) color_space: String,
    /// Half floats for the passes of EXR files that are not absolute.
    #[arg(long)]
    pub(super) half: bool,
    /// Take the noise out of the colour with Intel's Open Image Denoise (pip install 'gonio[denoise]'); other passes stay as they were rendered.
    #[arg(long)]
    pub(super) denoise: bool,
}

/// Renders that are interrupted, and parts of renders.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Checkpoints")]
pub(super) struct CheckpointArguments {
    /// Keep the sums so far in this file, from time to time and at the end; '####' or '$F4' stand for the frame number.
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Seconds between checkpoints; where writing one takes long, at least twenty times as long as that.
    #[arg(long = "checkpoint-every", value_name = "SECONDS", default_value_t = 60.0, requires = "checkpoint")]
    pub(super) checkpoint_every: f64,
    /// Go on with the checkpoint where there is one, to the same bits as without the interruption.
    #[arg(long, requires = "checkpoint")]
    pub(super) resume: bool,
    /// Render a part of the samples, from the first to the one before the last number; 'gonio merge' joins the checkpoints of the parts.
    #[arg(long, value_name = "FIRST:END")]
    pub(super) samples: Option<String>,
}

#[derive(Args, Debug)]
pub(super) struct MergeArguments {
    /// The checkpoints of the parts, in any order.
    #[arg(required = true)]
    pub(super) parts: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) files: OutputArguments,
    /// Write nothing but errors.
    #[arg(long, short = 'q')]
    pub(super) quiet: bool,
}

/// Sun and sky beside the stage's own lights.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Daylight")]
pub(super) struct DaylightArguments {
    /// Add sun and sky as seen from a place at a time: degrees north, degrees east, ISO 8601 with the offset from UTC, as in 48.14,11.58,2024-06-21T15:00+02:00.
    #[arg(long, value_name = "LAT,LON,TIME", allow_hyphen_values = true)]
    pub(super) sun: Option<String>,
    /// How luminance is spread over the sky: perez (all weathers), hosek-wilkie (clear), clear and overcast (CIE), or cie1 to cie15 of ISO 15469.
    #[arg(long, value_name = "MODEL", default_value = "perez", requires = "sun")]
    pub(super) sky: String,
    /// Haze from 1 to 10: 2 in the mountains, 3 in the country, 5 in a city (Linke's turbidity).
    #[arg(long, value_name = "NUMBER", default_value_t = 3.0, requires = "sun")]
    pub(super) turbidity: f64,
    /// Measured irradiances in W/m², direct normal and diffuse horizontal, instead of a cloudless sky.
    #[arg(long, value_name = "DIRECT,DIFFUSE", requires = "sun", conflicts_with = "weather")]
    pub(super) irradiance: Option<String>,
    /// Take the irradiances of the time's hour from an EPW or WEA file.
    #[arg(long, value_name = "FILE", requires = "sun")]
    pub(super) weather: Option<PathBuf>,
    /// Where true north lies: degrees clockwise, seen from above, of +Y where Z is up and of -Z where Y is up.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true, requires = "sun")]
    pub(super) north: f64,
    /// Albedo of the ground, 0 to 1; it is shown below the horizon, which is black without it.
    #[arg(long, value_name = "ALBEDO", default_value_t = 0.0, requires = "sun")]
    pub(super) ground: f64,
    /// Metres above the sea.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true, requires = "sun")]
    pub(super) elevation: f64,
    /// White sun and sky with the same luminances.
    #[arg(long = "white-daylight", requires = "sun")]
    pub(super) white: bool,
}

/// The end of `gonio measure --help`.
const MEASURE_EXAMPLES: &str = "Examples:
  gonio measure office.usda --grid /Office/Floor --height 0.75 --margin 0.5 -o plane.png --csv plane.csv
  gonio measure office.usda --at 2,3,1.2 --quantity cylindrical
  gonio measure office.usda --grid /Office/Floor --quantity daylight-factor --sun 48.21,16.37,2025-03-21T12:00+01:00 --sky overcast";

#[derive(Args, Debug)]
pub(super) struct MeasureOptions {
    #[command(flatten)]
    pub(super) stage: StageArguments,
    /// The frame to measure.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true)]
    pub(super) frame: Option<f64>,
    /// Lay a grid over this prim's surface; may be given several times.
    #[arg(long, value_name = "PRIMPATH")]
    pub(super) grid: Vec<String>,
    /// Metres from point to point of these grids; without it as EN 12464-1 has it.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, requires = "grid")]
    pub(super) spacing: f64,
    /// Metres along the edges that these grids leave out.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, requires = "grid")]
    pub(super) margin: f64,
    /// Metres from the surface to these grids.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true, requires = "grid")]
    pub(super) height: f64,
    /// Measure at this point of the world, in metres; may be given several times.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(super) at: Vec<String>,
    /// The normal of the plane that these points measure, or the axis of their cylinders; without it up.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "at")]
    pub(super) normal: Option<String>,
    /// Where half cylinders and luminance meters at these points face; without it +Y where Z is up, -Z where Y is up.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "at")]
    pub(super) facing: Option<String>,
    /// What these grids and points measure: illuminance, cylindrical, semicylindrical (lx), daylight-factor (%), luminance (cd/m²).
    #[arg(long, value_name = "QUANTITY", default_value = "illuminance")]
    pub(super) quantity: String,
    /// Draw the grid in false colour with its values; with several grids the prim's name is put before the ending.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(super) output: Option<PathBuf>,
    /// Write every point with its value and standard error.
    #[arg(long, value_name = "FILE.csv")]
    pub(super) csv: Option<PathBuf>,
    /// For machines.
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) scale: ScaleArguments,
    /// Samples a point.
    #[arg(long, short = 'p', value_name = "COUNT", default_value_t = 4096, value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub(super) spp: u32,
    /// Limit of the bounces; without one all count that matter.
    #[arg(long = "max-bounces", value_name = "COUNT")]
    pub(super) max_bounces: Option<u32>,
    /// The light transport: full global illumination, or direct light alone.
    #[arg(long, value_enum, default_value_t = IntegratorArgument::Path)]
    pub(super) integrator: IntegratorArgument,
    /// Seed of the random numbers.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    pub(super) seed: u32,
    /// Worker threads; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 0)]
    pub(super) threads: u32,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(super) quiet: bool,
    #[command(flatten)]
    pub(super) daylight: DaylightArguments,
}

/// The steps of a false-colour picture.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "False colour")]
pub(super) struct ScaleArguments {
    /// The upper end of the scale; without it a round number that nearly all values stay below.
    #[arg(long, value_name = "VALUE")]
    pub(super) max: Option<f32>,
    /// Steps of the scale.
    #[arg(long, value_name = "COUNT", default_value_t = 10)]
    pub(super) steps: u32,
    /// Steps that are even in the logarithm, over so many decades.
    #[arg(long, value_name = "DECADES")]
    pub(super) log: Option<f32>,
}

#[derive(Args, Debug)]
pub(super) struct FalsecolorOptions {
    /// The EXR file.
    pub(super) image: PathBuf,
    /// The picture to write.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(super) output: PathBuf,
    /// What is shown: luminance, illuminance, or the name of any channel.
    #[arg(long, value_name = "QUANTITY", default_value = "luminance")]
    pub(super) quantity: String,
    #[command(flatten)]
    pub(super) scale: ScaleArguments,
    /// Draw lines where steps meet.
    #[arg(long)]
    pub(super) contours: bool,
    /// Draw the lines in colour over the tone-mapped picture instead of filling the steps.
    #[arg(long)]
    pub(super) lines: bool,
    /// Pixels to each side over which values are averaged before lines are drawn.
    #[arg(long, value_name = "PIXELS", default_value_t = 3)]
    pub(super) smooth: usize,
    /// No legend.
    #[arg(long = "no-legend")]
    pub(super) no_legend: bool,
}

#[derive(Args, Debug)]
pub(super) struct GlareArguments {
    /// The fisheye picture: an EXR file with luminances in cd/m², seen from the eye along its line of sight.
    pub(super) image: PathBuf,
    /// How the picture was projected: equidistant, equisolid, hemispherical.
    #[arg(long, value_name = "PROJECTION", default_value = "equidistant")]
    pub(super) projection: String,
    /// Full field of view in degrees; the circle touches the picture's edges.
    #[arg(long, value_name = "DEGREES", default_value_t = 180.0)]
    pub(super) fov: f64,
    /// The channel that holds the luminances.
    #[arg(long, value_name = "QUANTITY", default_value = "luminance")]
    pub(super) quantity: String,
    /// Luminance in cd/m² from which on a pixel glares; without it five times the picture's mean.
    #[arg(long, value_name = "LUMINANCE")]
    pub(super) threshold: Option<f64>,
    /// Radians within which sources count as one.
    #[arg(long, value_name = "RADIANS", default_value_t = 0.2)]
    pub(super) radius: f64,
    /// For machines.
    #[arg(long)]
    pub(super) json: bool,
    /// Draw the sources, each in a colour of its own.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum IntegratorArgument {
    /// Path tracing.
    Path,
    /// The same, stopped after direct light.
    Direct,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum FilterArgument {
    /// Constant.
    Box,
    /// Linear.
    Tent,
    /// Gaussian.
    Gaussian,
    /// Blackman–Harris.
    BlackmanHarris,
}

#[derive(Args, Debug)]
pub(super) struct InfoOptions {
    #[command(flatten)]
    pub(super) stage: StageArguments,
    /// The frame to look at.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true)]
    pub(super) frame: Option<f64>,
    /// For machines.
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Args, Debug)]
pub(super) struct CompareOptions {
    /// The image to judge.
    pub(super) image: PathBuf,
    /// The reference.
    pub(super) reference: PathBuf,
    /// Fail with status 1 if the 95th percentile of any channel's block differences is above this (0.03 is 3 %).
    #[arg(long, value_name = "DIFFERENCE")]
    pub(super) max: Option<f64>,
    /// Write a picture: red where the image is brighter, blue where it is darker, full at 10 %.
    #[arg(long, value_name = "FILE")]
    pub(super) difference: Option<PathBuf>,
    /// Compare only these channels, separated by commas.
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(super) channels: Vec<String>,
}

#[derive(Args, Debug)]
pub(super) struct RelightOptions {
    /// An EXR file that was rendered with --light-groups.
    pub(super) image: PathBuf,
    /// A group's factor, and the colour temperature in K that tints it: 'Kitchen=0.3' or 'Kitchen=0.3,2700'; may be given several times.
    #[arg(long, value_name = "NAME=FACTOR[,KELVIN]")]
    pub(super) group: Vec<String>,
    /// The EXR file to write: colour, luminance if the picture has it, and the groups.
    #[arg(long, short = 'o', value_name = "FILE.exr")]
    pub(super) output: PathBuf,
}

#[derive(Args, Debug)]
pub(super) struct PhotometryOptions {
    /// The luminaire: an IES LM-63 or EULUMDAT file.
    pub(super) file: PathBuf,
    /// For machines.
    #[arg(long)]
    pub(super) json: bool,
    /// Draw the polar diagram, in cd/klm.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) polar: Option<PathBuf>,
    /// Draw the cone diagram: illuminance and the beam's diameter at 1 to 5 m.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) cone: Option<PathBuf>,
    /// Write the luminaire as LM-63-2002 or EULUMDAT.
    #[arg(long, value_name = "FILE.ies|FILE.ldt")]
    pub(super) convert: Option<PathBuf>,
    /// Take the file's alternative lamps of this number, from 1.
    #[arg(long = "lamp-set", value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) lamp_set: Option<u32>,
    /// Turn the luminaire about its vertical axis, from C0 towards C90.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    pub(super) rotate: Option<f64>,
}

/// The end of `gonio bsdf --help`.
const BSDF_EXAMPLES: &str = "Examples:
  gonio bsdf gold.binary                        what the file holds, and what is wrong with it
  gonio bsdf gold.binary --lobes gold.svg       lobes in the plane of incidence
  gonio bsdf blind.xml -o blind.gbsdf --text    as a table to read and edit
  gonio bsdf gold.binary --fit --material gold.usda
                                                the nearest OpenPBR surface, for a renderer that takes no measurements";

#[derive(Args, Debug)]
pub(super) struct BsdfOptions {
    /// The measured material.
    pub(super) file: PathBuf,
    /// For machines.
    #[arg(long)]
    pub(super) json: bool,
    /// Draw the lobes of light at 0°, 30°, 60° and 75° in the plane of incidence, four decades of 1/sr.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) lobes: Option<PathBuf>,
    /// Draw the same lobes over whole hemispheres, as colours.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) map: Option<PathBuf>,
    /// Write it as .gbsdf: tables as they are, everything else evaluated on a grid of angles; how far that is from the file is told.
    #[arg(long, short = 'o', value_name = "FILE.gbsdf")]
    pub(super) output: Option<PathBuf>,
    /// The grid to write: polar angles from 0° to 90°, and azimuths of a turn; for tables, too, if given.
    #[arg(long, num_args = 2, value_names = ["THETA", "PHI"], value_parser = clap::value_parser!(u32).range(2..=720), requires = "output")]
    pub(super) grid: Option<Vec<u32>>,
    /// Write numbers as text instead of binary.
    #[arg(long, requires = "output")]
    pub(super) text: bool,
    /// Fit an OpenPBR surface to the front's reflection: colour, metalness, roughness, anisotropy, index, and the residual.
    #[arg(long)]
    pub(super) fit: bool,
    /// Write the fitted surface as a USD material.
    #[arg(long, value_name = "FILE.usda")]
    pub(super) material: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub(super) struct BenchOptions {
    /// Only these stages, separated by commas: generation, traversal, triangle, texture, bsdf, light, function, tone, render.
    #[arg(long, value_name = "STAGES", value_delimiter = ',', value_parser = stage)]
    pub(super) stage: Vec<Stage>,
    /// Seconds for each row of the table.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.5, value_parser = seconds)]
    pub(super) seconds: f64,
    /// Worker threads of whole renders; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 1)]
    pub(super) threads: u32,
    /// Render this scene bundle instead of the benchmark's own scenes.
    #[arg(long, value_name = "BUNDLE")]
    pub(super) scene: Option<PathBuf>,
    /// For machines: everything as JSON, once all is measured.
    #[arg(long)]
    pub(super) json: bool,
    /// Write a bar chart.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) plot: Option<PathBuf>,
}

fn stage(name: &str) -> Result<Stage, String> {
    Stage::by_name(name).ok_or_else(Stage::expected)
}

fn seconds(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|s| (0.0..=86_400.0).contains(s)).ok_or_else(|| "expected a number from 0 to 86400".into())
}
