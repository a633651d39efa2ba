//! What the command line takes, by command.

mod annual;
mod bench;
mod bsdf;
mod checkpoint;
mod client_page;
mod completion;
mod daylight;
mod dim;
mod eyes;
mod falsecolor;
mod farm;
mod glare;
mod goniometer;
mod info;
mod integrator;
mod map;
mod measure;
mod norms;
mod number;
mod output;
mod photometry;
mod picture;
mod render;
mod report;
mod road;
mod spectrum;
mod stage;
mod sunlight;
mod texture;
mod verdict;
mod view;
mod view_out;
mod work;

pub(super) use annual::{
    AnnualGlareOptions, AnnualMetricsOptions, AnnualOptions, ControlArgument, FacadeArguments, LightingArguments, MetricArgument,
    SensorArgument, SunPositionArgument, YearArguments,
};
pub(super) use bench::BenchOptions;
pub(super) use bsdf::{BsdfOptions, SampleArguments};
pub(super) use checkpoint::{CheckpointArguments, MergeArguments, RoundArguments};
pub(super) use client_page::ShareOptions;
pub(super) use completion::{CompletionOptions, ShellArgument};
pub(super) use daylight::DaylightArguments;
pub(super) use dim::DimOptions;
pub(super) use eyes::EyeArguments;
pub(super) use falsecolor::{FalsecolorOptions, ScaleArguments};
pub(super) use farm::FarmArguments;
pub(super) use glare::GlareArguments;
pub(super) use goniometer::GoniometerOptions;
pub(super) use info::InfoOptions;
pub(super) use integrator::IntegratorArgument;
pub(super) use map::MapArguments;
pub(super) use measure::{GridArguments, MeasureOptions, MeasuringArguments};
pub(super) use norms::{EmergencyOptions, NormArguments, SportsOptions, ZonesOptions};
pub(super) use output::OutputArguments;
pub(super) use photometry::{PhotometryOptions, SymmetryName};
pub(super) use picture::{CompareOptions, RelightOptions};
pub(super) use render::{FilterArgument, HeadlightArgument, RenderOptions};
pub(super) use report::ReportOptions;
pub(super) use road::RoadOptions;
pub(super) use spectrum::{SensorOptions, SpectrumOptions};
pub(super) use stage::{ComplexityArgument, StageArguments};
pub(super) use sunlight::SunlightOptions;
pub(super) use texture::TextureArguments;
pub(super) use verdict::VerdictOptions;
pub(super) use view::{ShowArgument, ViewOptions};
pub(super) use view_out::ViewOutOptions;
pub(super) use work::WorkArguments;

use annual::{ANNUAL_EXAMPLES, ANNUAL_GLARE_EXAMPLES, ANNUAL_METRICS_EXAMPLES};
use bsdf::BSDF_EXAMPLES;
use clap::{Parser, Subcommand};
use client_page::SHARE_EXAMPLES;
use dim::DIM_EXAMPLES;
use goniometer::GONIOMETER_EXAMPLES;
use map::MAP_EXAMPLES;
use measure::MEASURE_EXAMPLES;
use norms::{EMERGENCY_EXAMPLES, SPORTS_EXAMPLES, ZONES_EXAMPLES};
use report::REPORT_EXAMPLES;
use road::ROAD_EXAMPLES;
use spectrum::{SENSOR_EXAMPLES, SPECTRUM_EXAMPLES};
use sunlight::SUNLIGHT_EXAMPLES;
use verdict::VERDICT_EXAMPLES;
use view::VIEW_EXAMPLES;
use view_out::VIEW_OUT_EXAMPLES;

/// What the process's status says.
const EXIT_STATUS: &str = "\
Exit status:
  0    done
  1    an error, told in one line; 'gonio compare' beyond --max; 'gonio dim' and 'gonio verdict' with something that is not met
  2    a command line that cannot be understood
  3    the USD library broke down over the stage; 'gonio verdict' within the error
  130  interrupted; the picture so far is written";

/// Command lines to start from.
const RENDER_EXAMPLES: &str = "\
Examples:
  gonio render stage.usda -o picture.exr -o picture.png --spp 256
  gonio render --frames 1:10x2 --camera Main -w 1920 stage.usda out.####.exr
  gonio render -f 1 -n 10 -i 2 --res 640 360 -o out.$F4.exr stage.usd
  gonio render stage.usda --settings /Render/Final        (all its products)

SIGUSR1 writes the picture so far.";

/// Physically exact rendering of USD stages, with answers in cd/m² and lux.
#[derive(Debug, Parser)]
#[command(name = "gonio", version, about, propagate_version = true, after_help = EXIT_STATUS)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a USD stage to EXR, PNG or JPEG.
    ///
    /// Takes the options of usdrecord and husk too; docs/usd.md lists what becomes of each.
    #[command(after_long_help = RENDER_EXAMPLES)]
    Render(Box<RenderOptions>),
    /// Show a USD stage in a window: a picture that becomes clearer, seen from where you like, with cd/m² and lux under the cursor.
    ///
    /// Reads the stage anew when one of its files is saved. Needs Qt: pip install PySide6-Essentials.
    #[command(after_long_help = VIEW_EXAMPLES)]
    View(Box<ViewOptions>),
    /// Join the parts of a render's samples that 'gonio render --samples A:B --checkpoint PART' wrote, to the bits of one whole render.
    Merge(MergeArguments),
    /// Say what would be rendered: counts, memory, lights with units, what is unsupported.
    ///
    /// Of an OpenVDB (.vdb) or NanoVDB (.nvdb) file, say what grids it holds: types, voxels, bounds, memory. Of a GLDF or GDTF file, say what its product is.
    Info(Box<InfoOptions>),
    /// Compare two EXR files: relative mean squared error and block differences.
    Compare(CompareOptions),
    /// Dim and recolour the light groups of a rendered EXR file.
    Relight(RelightOptions),
    /// Say what an IES, EULUMDAT, TM-33, GLDF or GDTF file holds: flux, efficacy, beam and field angle, problems; draw and convert it.
    Photometry(PhotometryOptions),
    /// Say what a lamp's spectrum means: chromaticity, CCT, Ra, TM-30's Rf and Rg, melanopic DER, lm/W; draw it with the colour vectors.
    ///
    /// Reads text of nanometres and power (CSV, semicolons, tabs, blanks) and IES TM-27 .spdx, and knows the CIE's illuminants, blackbodies and
    /// daylight by name. Several of them make a table. A figure that is undefined for a light, or outside its standard's range, says so.
    #[command(after_long_help = SPECTRUM_EXAMPLES)]
    Spectrum(SpectrumOptions),
    /// Say when the sun shines on points of a USD stage on a day, and for how long (sunlight exposure of EN 17037, sun on gardens and roofs).
    ///
    /// The sun goes over the sky minute by minute. What stands before it hides it; thin panes let it through. Hours are those in which any of its disc is seen.
    #[command(after_long_help = SUNLIGHT_EXAMPLES)]
    Sunlight(Box<SunlightOptions>),
    /// Say what is seen of the outside from points of a USD stage (view out of EN 17037): horizontal sight angle, outside distance, layers.
    ///
    /// Eyes send rays around, to 60° above and below the horizon, which go out through clear panes and open holes. Grids get the level that three quarters of
    /// their points reach. It is no certificate.
    #[command(name = "view-out", after_long_help = VIEW_OUT_EXAMPLES)]
    ViewOut(Box<ViewOutOptions>),
    /// See a picture by wavelength as a camera or another sensor does, by its response curves.
    ///
    /// Takes what 'gonio render --by-wavelength' writes and a table of the sensor's channels; writes an EXR file with a channel for each. 'gonio falsecolor' shows
    /// such a picture's CCT, Duv and melanopic luminance.
    #[command(after_long_help = SENSOR_EXAMPLES)]
    Sensor(SensorOptions),
    /// Say what a measured material's file holds: angles, albedo, reciprocity, energy, problems; draw, convert and fit it. Measure a sample.
    ///
    /// Takes MERL .binary, RGL .bsdf, pBRDF .pbsdf, UTIA .bin, BSDF XML of Radiance and WINDOW, Zemax .bsdf and gonio's own .gbsdf; content
    /// decides, not the name. Front is the side of the normal; 'reflected' and 'transmitted' are shares of the light that arrives from the
    /// angle named.
    ///
    /// --sample measures what a USD stage holds, as Radiance's genBSDF does, and goes on with that as with a file.
    #[command(after_long_help = BSDF_EXAMPLES)]
    Bsdf(Box<BsdfOptions>),
    /// Measure light at points and on calculation grids of a USD stage, in lux, cd/m² or per cent of the daylight outside.
    ///
    /// Measures what the stage's gonio:grid and gonio:meter attributes ask for and the prims that --grid names; with --at its points and those prims
    /// alone.
    #[command(after_long_help = MEASURE_EXAMPLES)]
    Measure(Box<MeasureOptions>),
    /// Find the dimming of a USD stage's light groups that meets lighting targets at least power; write it as a layer over the stage.
    ///
    /// Measures what each group of lights (gonio:lightGroup) brings to the points once, as 'gonio measure' does. Light adds up, so the levels are a linear
    /// program. Lights in no group, daylight as a rule, stay as they are. Where targets cannot be met, says which, and by how much.
    #[command(after_long_help = DIM_EXAMPLES)]
    Dim(Box<DimOptions>),
    /// Measure a luminaire of a USD stage as a goniophotometer does: intensities by direction, flux, light output ratio; write it as EULUMDAT, IES or TM-33.
    ///
    /// Light is followed from the sources within a prim (lights, glowing surfaces, ray files) through its reflectors, lenses and covers to where it
    /// leaves. Every value has a standard error. What is absorbed or cut off is told in lumens.
    #[command(after_long_help = GONIOMETER_EXAMPLES)]
    Goniometer(Box<GoniometerOptions>),
    /// Keep the light of a USD stage on its surfaces: illuminance in lux by light paths, as textures, primvars, and views from any camera.
    ///
    /// Front and back of a surface have values of their own, and direct light is told from all. Light counts that lamps send through lenses, glass
    /// and mirrors too.
    #[command(after_long_help = MAP_EXAMPLES)]
    Map(Box<MapArguments>),
    /// Draw the luminance or the illuminance of an EXR file or a Radiance picture in fixed steps with a legend, or as isolines over the picture.
    Falsecolor(FalsecolorOptions),
    /// Put a stage's light on one page: luminaires with flux and watts, pictures, calculation grids, polar diagrams.
    ///
    /// Writes one HTML file that holds everything, pictures too, and needs nothing from elsewhere. Luminaires are the lights that name an IES or
    /// EULUMDAT file; the other lights stand in the schedule with what is known of them.
    #[command(after_long_help = REPORT_EXAMPLES)]
    Report(Box<ReportOptions>),
    /// Write one HTML page on which a client plays with the light of a finished picture: dims, tints, measures and compares.
    ///
    /// The page holds everything and needs neither a server nor the network. Browsers mix the light groups as 'gonio relight' does and show them as
    /// 'gonio render -o picture.png' does.
    #[command(after_long_help = SHARE_EXAMPLES)]
    Share(Box<ShareOptions>),
    /// Calculate a road's lighting as EN 13201-3 and CIE 140 do: Lav, Uo, Ul, TI, EIR and illuminances, from luminaires' files and a TOML file.
    ///
    /// Says whether the values that the file requires are met, and looks for the largest spacing of luminaires that meets them. It is no certificate of a
    /// lighting class.
    #[command(after_long_help = ROAD_EXAMPLES)]
    Road(RoadOptions),
    /// Calculate emergency lighting as EN 1838 has it: illuminances on escape routes, in open areas and at places, and luminaires that may dazzle.
    ///
    /// A TOML file says where people flee, which lights shine then and how much of their flux is left. Light comes straight from the lamps; what the
    /// building holds throws shadows. 'gonio verdict' compares the figures with your own requirements.
    #[command(after_long_help = EMERGENCY_EXAMPLES)]
    Emergency(Box<EmergencyOptions>),
    /// Calculate sports lighting as EN 12193 has it: illuminances on fields and towards cameras, their uniformities, and glare (GR, CIE 112).
    ///
    /// A TOML file says where people play, who films and who may be dazzled. 'gonio verdict' compares the figures with your own requirements.
    #[command(after_long_help = SPORTS_EXAMPLES)]
    Sports(Box<SportsOptions>),
    /// Calculate zones of rooms as EN 12464-1 has them: task areas, their surround, the background, walls, the ceiling, and cylindrical illuminance.
    ///
    /// A TOML file says where rooms and tasks are, and which lights shine; daylight does not. Points stand as EN 12464-1 has them. 'gonio verdict' compares
    /// the figures with your own requirements.
    #[command(after_long_help = ZONES_EXAMPLES)]
    Zones(Box<ZonesOptions>),
    /// Say whether what was measured meets what is required, line by line and by the standard errors: met, not met, or within the error.
    ///
    /// Requirements are a TOML file of your own numbers; figures come from 'gonio measure', 'gonio annual', 'gonio view-out', 'gonio road',
    /// 'gonio emergency', 'gonio sports' and 'gonio zones' with --json. Writes the
    /// planner's sheet as HTML or PDF. It is no certificate of conformity with a standard.
    #[command(after_long_help = VERDICT_EXAMPLES)]
    Verdict(VerdictOptions),
    /// Calculate a year of daylight on grids of a USD stage: sDA, ASE, daylight autonomy, UDI, EN 17037, with standard errors.
    ///
    /// Paths from the points find what each patch of the sky brings; a weather file says how bright each is, hour by hour, and where the sun stands.
    /// Grids are the stage's own and those over prims that --grid names, as 'gonio measure' has them.
    #[command(after_long_help = ANNUAL_EXAMPLES)]
    Annual(Box<AnnualOptions>),
    /// Rate daylight glare over a year for eyes in a USD stage: DGP by hour, how often it is exceeded, and the class of EN 17037.
    ///
    /// Light at the eye comes by coefficients as 'gonio annual' traces them, contrast by the sun and by patches of the sky that the eye sees.
    #[command(after_long_help = ANNUAL_GLARE_EXAMPLES)]
    AnnualGlare(Box<AnnualGlareOptions>),
    /// Calculate a year of daylight from coefficients and a weather file: sDA, ASE, daylight autonomy, UDI, EN 17037, with standard errors.
    ///
    /// No light is traced: coefficients say what each patch of the sky brings to each point, the weather file how bright each patch is, hour by
    /// hour, as Radiance's gendaymtx has it.
    #[command(name = "annual-metrics", after_long_help = ANNUAL_METRICS_EXAMPLES)]
    AnnualMetrics(Box<AnnualMetricsOptions>),
    /// Rate glare in a picture of luminances, a fisheye or a perspective: UGR and DGP, and the sources that cause it.
    Glare(GlareArguments),
    /// Measure every stage of rendering at every SIMD level against one lane.
    Bench(BenchOptions),
    /// Write what a shell needs to complete gonio's options.
    Completion(CompletionOptions),
}

impl Command {
    /// Whether it asks now and then if a signal wants it to end in order; the others are ended at once.
    pub(super) fn hears_signals(&self) -> bool {
        !matches!(
            self,
            Self::Merge(_)
                | Self::Compare(_)
                | Self::Relight(_)
                | Self::Photometry(_)
                | Self::Spectrum(_)
                | Self::Sensor(_)
                | Self::Falsecolor(_)
                | Self::Glare(_)
                | Self::Completion(_)
        )
    }
}
