//! What `gonio falsecolor` takes, and the steps that it shares with others.

use super::number::{count, finite};
use clap::Args;
use std::path::PathBuf;

/// The steps of a false-colour picture.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "False colour")]
pub(crate) struct ScaleArguments {
    /// The upper end of the scale; without it a round number that nearly all values stay below.
    #[arg(long, value_name = "VALUE", value_parser = finite::<f32>)]
    pub(crate) max: Option<f32>,
    /// Steps of the scale.
    #[arg(long, value_name = "COUNT", default_value_t = 10, value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) steps: u32,
    /// Steps that are even in the logarithm, over so many decades.
    #[arg(long, value_name = "DECADES", value_parser = finite::<f32>)]
    pub(crate) log: Option<f32>,
}

#[derive(Args, Debug)]
pub(crate) struct FalsecolorOptions {
    /// The EXR file, or a calibrated Radiance picture (.hdr).
    pub(crate) image: PathBuf,
    /// The picture to write.
    #[arg(long, short = 'o', value_name = "FILE.png")]
    pub(crate) output: PathBuf,
    /// What is shown: luminance, illuminance, or the name of any channel; of the colour cct (K) and duv; of pictures by wavelength melanopic (equivalent daylight luminance, cd/m²), and of the light on surfaces, where they have illuminance (--aov illuminance), ra, rf, rg and melanopic-edi (lx).
    #[arg(long, value_name = "QUANTITY", default_value = "luminance")]
    pub(crate) quantity: String,
    #[command(flatten)]
    pub(crate) scale: ScaleArguments,
    /// Draw lines where steps meet.
    #[arg(long)]
    pub(crate) contours: bool,
    /// Draw the lines in colour over the tone-mapped picture instead of filling the steps.
    #[arg(long)]
    pub(crate) lines: bool,
    /// Pixels to each side over which values are averaged before lines are drawn.
    #[arg(long, value_name = "PIXELS", default_value_t = 3)]
    pub(crate) smooth: usize,
    /// No legend.
    #[arg(long = "no-legend")]
    pub(crate) no_legend: bool,
}
