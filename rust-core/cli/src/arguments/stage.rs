//! What of a stage is read.

use super::number::positive;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What of the stage is read.
#[derive(Args, Clone, Debug)]
pub(crate) struct StageArguments {
    /// The stage: a .usd, .usda, .usdc or .usdz file; or a honeybee model (.hbjson), a Radiance scene (.rad) or an IFC building model (.ifc).
    pub(crate) stage: PathBuf,
    /// Purposes shown beside 'default': render, proxy, guide, separated by commas; without it those of the render settings, or render.
    #[arg(long, value_name = "PURPOSES", value_delimiter = ',')]
    pub(crate) purposes: Vec<String>,
    /// How finely subdivision surfaces are refined.
    #[arg(long, short = 'C', value_enum, default_value_t = ComplexityArgument::High)]
    pub(crate) complexity: ComplexityArgument,
    /// Read only these prims, separated by commas, and what they refer to: bound materials, prototypes, prims that lights are linked to.
    #[arg(long, value_name = "PRIMPATHS", value_delimiter = ',')]
    pub(crate) mask: Vec<String>,
    /// Choose a variant: '/Prim{set=variant}'; may be given several times.
    #[arg(long, value_name = "SELECTION")]
    pub(crate) variant: Vec<String>,
    /// A layer put on top of the stage.
    #[arg(long = "session-layer", alias = "sessionLayer", value_name = "LAYER")]
    pub(crate) session_layer: Option<PathBuf>,
    /// The RenderSettings prim to follow.
    #[arg(long, short = 's', alias = "renderSettingsPrimPath", value_name = "PRIMPATH")]
    pub(crate) settings: Option<String>,
    /// The RenderPass prim to follow: what of the stage is shown, and whose settings count unless --settings says.
    #[arg(long = "render-pass", alias = "pass", value_name = "PRIMPATH")]
    pub(crate) render_pass: Option<String>,
    /// Everything stands still at the frame, whatever the camera's shutter says.
    #[arg(long = "disable-motion-blur", aliases = ["disable-motionblur", "disableMotionBlur"])]
    pub(crate) disable_motion_blur: bool,
    /// Models are shown themselves, not the cards, boxes and axes that stand for them.
    #[arg(long = "disable-draw-mode", alias = "disableDrawMode")]
    pub(crate) disable_draw_mode: bool,
    /// The camera does not see the shapes of lamps (suns and domes stay): they light, and stand in mirrors, as ever.
    #[arg(long = "hide-lights")]
    pub(crate) hide_lights: bool,
    /// Light has wavelengths, three a path, in place of red, green and blue: spectra of lamps, colours on colours and thin films come out as they are; colours
    /// become spectra.
    #[arg(long)]
    pub(crate) spectral: bool,
    /// Fill all of space with haze or fog in which a black thing before the sky keeps 5 % of its contrast after so many metres (the meteorological optical
    /// range of CIE and WMO); lights at infinity do not shine through it.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    pub(crate) haze: Option<f64>,
    /// Go on where a light's IES or EULUMDAT file is missing or cannot be read, with a warning: by its quantity's even light, else dark.
    #[arg(long, conflicts_with = "strict")]
    pub(crate) lenient: bool,
    /// Show a dynamic group of a honeybee model in its state N, counted from 0; may be given several times.
    #[arg(long, value_name = "GROUP=N")]
    pub(crate) state: Vec<String>,
    /// Treat every warning as an error.
    #[arg(long)]
    pub(crate) strict: bool,
    /// List all warnings and notes, and timings.
    #[arg(long, short = 'v')]
    pub(crate) verbose: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ComplexityArgument {
    /// No refinement.
    Low,
    /// Once.
    Medium,
    /// Twice.
    High,
    /// Three times.
    Veryhigh,
    /// Twice, and then until no edge is longer than a pixel of the camera.
    Auto,
}
