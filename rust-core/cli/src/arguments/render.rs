//! What `gonio render` takes.

use super::number::{count, finite};
use super::{
    CheckpointArguments, DaylightArguments, FarmArguments, IntegratorArgument, OutputArguments, StageArguments, TextureArguments,
    WorkArguments,
};
use clap::{Args, ValueEnum};
use gonio::scene::{Antialiasing, Caustics, Guiding, MOST_LIGHT_SAMPLES};
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct RenderOptions {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The picture to write, as -o.
    #[arg(value_name = "IMAGE")]
    pub(crate) image: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) files: OutputArguments,
    /// Camera by name or path; without it the stage's own choice.
    #[arg(long, short = 'c', alias = "cam", value_name = "CAMERA")]
    pub(crate) camera: Option<String>,
    /// Frames: '1', '1:10', '1:10x2', separated by commas.
    #[arg(long, short = 'f', value_name = "FRAMES", allow_hyphen_values = true)]
    pub(crate) frames: Option<String>,
    /// So many frames from the one that --frames names on, or from the stage's first.
    #[arg(long = "frame-count", short = 'n', value_name = "COUNT", value_parser = count::<u32>(1..=1_000_000))]
    pub(crate) frame_count: Option<u32>,
    /// From one frame to the next, with --frame-count.
    #[arg(long = "frame-inc", short = 'i', value_name = "STEP", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame_inc: Option<f64>,
    /// Default values of attributes, no time samples.
    #[arg(long = "default-time", short = 'd', conflicts_with_all = ["frames", "frame_count"])]
    pub(crate) default_time: bool,
    /// Width and height in pixels.
    #[arg(long, num_args = 2, value_names = ["WIDTH", "HEIGHT"], overrides_with = "res")]
    pub(crate) res: Option<Vec<u32>>,
    /// Width in pixels; the height follows the camera's shape.
    #[arg(long = "image-width", short = 'w', value_name = "WIDTH", conflicts_with = "res")]
    pub(crate) image_width: Option<u32>,
    /// Factor on the resolution; from 10 on it is per cent.
    #[arg(long = "res-scale", value_name = "FACTOR", default_value_t = 1.0)]
    pub(crate) res_scale: f64,
    /// Width of a pixel over its height.
    #[arg(long = "pixel-aspect", value_name = "RATIO", value_parser = finite::<f64>)]
    pub(crate) pixel_aspect: Option<f64>,
    /// Samples a pixel.
    #[arg(long, short = 'p', value_name = "COUNT", value_parser = count::<u32>(1..=1 << 20))]
    pub(crate) spp: Option<u32>,
    /// Stop sampling where the estimated noise is below this, on Cycles' scale: 0.01 is a clean picture, 0.1 a preview; 0 is off. --spp is the most that a pixel gets, the pass sample_count shows what it got.
    #[arg(long = "noise-threshold", value_name = "ERROR", default_value_t = 0.0, value_parser = finite::<f32>)]
    pub(crate) noise_threshold: f32,
    /// Samples a pixel before its noise is estimated; 0 leaves it to the threshold (64 for 0.01).
    #[arg(long = "min-spp", value_name = "COUNT", default_value_t = 0, value_parser = count::<u32>(0..=1 << 20))]
    pub(crate) min_spp: u32,
    /// Bounces after the first surface.
    #[arg(long = "max-bounces", value_name = "COUNT", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) max_bounces: Option<u32>,
    /// The light transport: full global illumination, direct light alone, direct light without noise with mirrors and clear glass, or paths from the lamps alone.
    #[arg(long, value_enum, default_value_t = IntegratorArgument::Path)]
    pub(crate) integrator: IntegratorArgument,
    /// Light paths from the lamps bring what mirrors and clear glass throw onto surfaces that the camera sees: where a few of them tell that they pay, always, or never.
    #[arg(long, value_enum, default_value_t = CausticsArgument::Auto)]
    pub(crate) caustics: CausticsArgument,
    /// Paths go more often where indirect light comes from, as through a door ajar, learned from small pictures of the view (path guiding); given up where they do not promise that it pays.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = GuidingArgument::Off)]
    pub(crate) guiding: GuidingArgument,
    /// Samples of each light that has an extent, with --integrator whitted; the same places on the light for every point.
    #[arg(long = "light-samples", value_name = "COUNT", default_value_t = MOST_LIGHT_SAMPLES, value_parser = count::<u32>(1..=u64::from(MOST_LIGHT_SAMPLES)))]
    pub(crate) light_samples: u32,
    /// Where in a pixel samples lie: 'adaptive' follows edges and shadows with about two rays a pixel, 'high' with more of them, 'paper' by one threshold; a number from 1 to 32 is a regular grid of so many places each way. It tells the number of samples and takes no filter; all but grids want --integrator whitted.
    #[arg(long, value_name = "adaptive|high|paper|GRID", value_parser = antialiasing, conflicts_with_all = ["spp", "filter", "filter_width"])]
    pub(crate) antialiasing: Option<Antialiasing>,
    /// The pixel filter.
    #[arg(long, value_enum, default_value_t = FilterArgument::BlackmanHarris)]
    pub(crate) filter: FilterArgument,
    /// Width of the pixel filter in pixels.
    #[arg(long = "filter-width", value_name = "PIXELS", default_value_t = 1.5, value_parser = finite::<f32>)]
    pub(crate) filter_width: f32,
    /// Passes to write, separated by commas: color, alpha, depth, normal, P, albedo, primId, luminance, illuminance, uv, mist, emission, environment, object_index, material_index, sample_count, denoising_normal, denoising_albedo, denoising_light, and direct, indirect and color of diffuse, glossy and transmission (diffuse_direct); shadow_catcher, ambient_occlusion, cost (seconds), instanceId, elementId, motion (vectors in pixels, where nothing is blurred); normal and position in the camera's space (Neye, Peye); cryptomatte_object, cryptomatte_material, cryptomatte_asset; primvars:NAME, lightgroup:NAME, and light path expressions such as lpe:C<RD>L.
    #[arg(long, value_name = "PASSES", value_delimiter = ',')]
    pub(crate) aov: Vec<String>,
    /// Ranks of the cryptomattes: how many names of a pixel are told apart. Odd numbers are rounded up.
    #[arg(long, value_name = "RANKS", value_parser = clap::value_parser!(u32).range(1..=16))]
    pub(crate) cryptomatte_depth: Option<u32>,
    /// Share by which depths of a deep picture may differ and still be one sample.
    #[arg(long = "deep-tolerance", value_name = "SHARE", default_value_t = 1e-3, value_parser = finite::<f32>)]
    pub(crate) deep_tolerance: f32,
    /// Write a pass for every light group, those that `gonio:lightGroup` names and 'other' for all other lights; together they are the colour.
    #[arg(long = "light-groups")]
    pub(crate) light_groups: bool,
    /// As --light-groups; where the stage names no group, each lamp is one by its own name, and lamps of one name are one.
    #[arg(long = "lamp-groups")]
    pub(crate) lamp_groups: bool,
    /// Part of the picture: left, top, right, bottom in pixels, or from 0 to 1 if one has a decimal point.
    #[arg(long, num_args = 4, value_names = ["X0", "Y0", "X1", "Y1"], allow_hyphen_values = true, overrides_with = "crop")]
    pub(crate) crop: Option<Vec<String>>,
    /// Stop after this many seconds, with whole passes over the picture.
    #[arg(long = "time-limit", alias = "time", value_name = "SECONDS", default_value_t = 0.0, value_parser = finite::<f64>)]
    pub(crate) time_limit: f64,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Limit of a direct sample in nits, as the mean of its components; 0 is off.
    #[arg(long = "clamp-direct", value_name = "NITS", default_value_t = 0.0, value_parser = finite::<f32>)]
    pub(crate) clamp_direct: f32,
    /// Limit of an indirect sample in nits, as the mean of its components; 0 is off, as for stages that have lights (else 2).
    #[arg(long = "clamp-indirect", value_name = "NITS", value_parser = finite::<f32>)]
    pub(crate) clamp_indirect: Option<f32>,
    /// No light at the camera for stages without lights.
    #[arg(long = "disable-camera-light")]
    pub(crate) disable_camera_light: bool,
    /// Light for stages without lights: none, from the camera, or an even sky that shows white as white.
    #[arg(long, value_enum, ignore_case = true, conflicts_with = "disable_camera_light")]
    pub(crate) headlight: Option<HeadlightArgument>,
    /// No light prims; surfaces that shine stay.
    #[arg(long = "disable-scene-lights")]
    pub(crate) disable_scene_lights: bool,
    /// All surfaces in the default material.
    #[arg(long = "disable-scene-materials")]
    pub(crate) disable_scene_materials: bool,
    /// Write the picture so far every so many seconds, over its file; SIGUSR1 does the same once.
    #[arg(long, value_name = "SECONDS", value_parser = finite::<f64>)]
    pub(crate) snapshot: Option<f64>,
    /// Leave out of EXR files what is black or empty all around, in these passes: names separated by commas, or '*' for all; C is the colour, A its coverage.
    #[arg(long, value_name = "PASSES", value_delimiter = ',')]
    pub(crate) autocrop: Vec<String>,
    /// Say what a prim has become and why, and end.
    #[arg(long, value_name = "PRIMPATH")]
    pub(crate) explain: Option<String>,
    /// List the stage's cameras and end.
    #[arg(long = "list-cameras")]
    pub(crate) list_cameras: bool,
    /// Write nothing but errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) checkpoint: CheckpointArguments,
    #[command(flatten)]
    pub(crate) farm: FarmArguments,
    #[command(flatten)]
    pub(crate) daylight: DaylightArguments,
}

impl RenderOptions {
    /// What other options than their own stand for.
    pub(crate) fn settle(&mut self) {
        self.files.output.extend(self.image.take());
    }

    /// The files that are read.
    pub(crate) fn inputs(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        [&mut self.stage.stage].into_iter().chain(&mut self.stage.session_layer).chain(&mut self.daylight.weather)
    }
}

fn antialiasing(text: &str) -> Result<Antialiasing, String> {
    Antialiasing::by_name(text).ok_or_else(|| "expected adaptive, high, paper, or a number of places from 1 to 32".to_owned())
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FilterArgument {
    /// Constant.
    Box,
    /// Linear.
    Tent,
    /// Gaussian.
    Gaussian,
    /// Blackman–Harris.
    BlackmanHarris,
}

/// Light for stages without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum HeadlightArgument {
    /// Darkness.
    None,
    /// From the camera.
    Distant,
    /// From everywhere.
    Dome,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum GuidingArgument {
    /// Never; nothing is learned.
    Off,
    /// Learned whatever that costs.
    On,
    /// Learned where that is a small part of the render.
    Auto,
}

impl From<GuidingArgument> for Guiding {
    fn from(argument: GuidingArgument) -> Self {
        match argument {
            GuidingArgument::Auto => Self::Auto,
            GuidingArgument::On => Self::On,
            GuidingArgument::Off => Self::Off,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum CausticsArgument {
    /// Where a few light paths tell that they pay.
    Auto,
    /// Always.
    On,
    /// Never: camera paths find what they happen to hit.
    Off,
}

impl From<CausticsArgument> for Caustics {
    fn from(argument: CausticsArgument) -> Self {
        match argument {
            CausticsArgument::Auto => Self::Auto,
            CausticsArgument::On => Self::On,
            CausticsArgument::Off => Self::Off,
        }
    }
}
