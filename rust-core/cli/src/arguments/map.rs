//! What `gonio map` takes.

use super::number::{count, finite, mebibytes};
use super::{DaylightArguments, ScaleArguments, StageArguments, TextureArguments, WorkArguments};
use clap::Args;
use std::path::PathBuf;

/// The end of `gonio map --help`.
pub(super) const MAP_EXAMPLES: &str = "Examples:
  gonio map office.usda --prim /Office/Floor --texel 0.05 -o floor.usda
  gonio map office.usda --prim /Office/Floor --uv st --texel 0.02 --error 2% -o floor.exr
  gonio map office.usda --view /Office/Camera -o lux.png --max 1000
  gonio map office.usda --prim /Office/Floor --view /Office/Camera --quantity cct -o cct.png";

#[derive(Args, Debug)]
pub(crate) struct MapArguments {
    #[command(flatten)]
    pub(crate) stage: StageArguments,
    /// The frame.
    #[arg(long, short = 'f', value_name = "FRAME", allow_hyphen_values = true, value_parser = finite::<f64>)]
    pub(crate) frame: Option<f64>,
    /// Keep light on this prim and all below it; may be given several times, without it all surfaces keep theirs.
    #[arg(long, value_name = "PRIMPATH")]
    pub(crate) prim: Vec<String>,
    /// Keep light on the texels of these texture coordinates; without it triangles are divided.
    #[arg(long, value_name = "PRIMVAR")]
    pub(crate) uv: Option<String>,
    /// Metres that texels are wide, or divided triangles at most as square metres; without it there are about 65,000 in all.
    #[arg(long, value_name = "METRES", value_parser = finite::<f64>)]
    pub(crate) texel: Option<f64>,
    /// Width and height in texels instead of their size.
    #[arg(long, num_args = 2, value_names = ["WIDTH", "HEIGHT"], requires = "uv", conflicts_with = "texel")]
    pub(crate) resolution: Option<Vec<u32>>,
    /// Stop where the standard error, averaged over the lit area, is this share of the illuminance; divided triangles are joined where theirs
    /// would be more. 0% never stops and joins nothing.
    #[arg(long, value_name = "SHARE", default_value = "5%")]
    pub(crate) error: String,
    /// Stop after so many light paths.
    #[arg(long, value_name = "COUNT", default_value = "64M", value_parser = count::<u64>(1..=u64::MAX))]
    pub(crate) paths: u64,
    /// Stop after so many seconds.
    #[arg(long = "time-limit", value_name = "SECONDS", default_value_t = 0.0, value_parser = finite::<f64>)]
    pub(crate) time_limit: f64,
    /// Keep red, green and blue too.
    #[arg(long)]
    pub(crate) colours: bool,
    /// Figures of the light's colour too, of every part with standard errors: CCT, Duv, Ra, Rf, Rg and melanopic EDI; lamps want spectra. They take several times as long.
    #[arg(long)]
    pub(crate) figures: bool,
    /// Most memory for maps, as 512M or 4G; digits alone are mebibytes.
    #[arg(long, value_name = "SIZE", default_value = "1G", value_parser = mebibytes)]
    pub(crate) memory: u64,
    /// Limit of the bounces; without one all count that matter.
    #[arg(long = "max-bounces", value_name = "COUNT", value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) max_bounces: Option<u32>,
    /// What to write: .exr (textures, with --uv), .usda (a layer over the stage with primvars, or the textures' names), .png (a view in false
    /// colour); may be given several times. With several textures the prims' names are put before the ending.
    #[arg(long, short = 'o', value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
    /// Put the divided triangles themselves into the .usda, as meshes of purpose guide.
    #[arg(long, conflicts_with = "uv")]
    pub(crate) divided: bool,
    /// The camera of the .png; without it the stage's own.
    #[arg(long, value_name = "CAMERA")]
    pub(crate) view: Option<String>,
    /// Width of the .png.
    #[arg(long = "image-width", short = 'w', value_name = "PIXELS")]
    pub(crate) image_width: Option<u32>,
    /// What the .png shows: illuminance, direct, indirect, or error (the standard error), all in lx; or a figure of the light's colour, which then is traced too: cct (K), duv, ra, rf, rg, melanopic-edi (lx).
    #[arg(long, value_name = "QUANTITY", default_value = "illuminance")]
    pub(crate) quantity: String,
    /// For machines.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) scale: ScaleArguments,
    #[command(flatten)]
    pub(crate) work: WorkArguments,
    #[command(flatten)]
    pub(crate) textures: TextureArguments,
    /// Write nothing but answers and errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) daylight: DaylightArguments,
}
