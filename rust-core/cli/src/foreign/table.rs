//! The options of usdrecord and husk, a row each.

/// Whose option it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Program {
    /// OpenUSD's usdrecord.
    Usdrecord,
    /// Houdini's husk.
    Husk,
    /// Both have it.
    Both,
}

impl Program {
    /// In words.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Usdrecord => "usdrecord",
            Self::Husk => "husk",
            Self::Both => "usdrecord and husk",
        }
    }
}

/// What becomes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    /// It is this option of gonio.
    Works(&'static str),
    /// Its words are worth a look of their own, and end as this option of gonio.
    Read(&'static str),
    /// It is taken and changes nothing; why is said.
    Idle,
    /// It would have changed the picture, and gonio cannot: an error.
    Refused,
}

#[cfg(test)]
impl State {
    /// In a word.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Works(_) | Self::Read(_) => "works",
            Self::Idle => "taken",
            Self::Refused => "refused",
        }
    }
}

/// One option.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// As it is written, the longest first.
    pub(crate) names: &'static [&'static str],
    /// Whose.
    pub(crate) program: Program,
    /// Words that follow it.
    pub(crate) takes: usize,
    /// What becomes of it.
    pub(crate) state: State,
    /// What differs, why it is not there, what to do in its place; may be empty.
    pub(crate) note: &'static str,
}

const fn row(names: &'static [&'static str], program: Program, takes: usize, state: State, note: &'static str) -> Row {
    Row { names, program, takes, state, note }
}

use Program::{Both, Husk, Usdrecord};
use State::{Idle, Read, Refused, Works};

const LICENCE: &str = "gonio asks for no licence";
const WINDOW: &str = "gonio render opens no window; gonio view STAGE is one";
const SNAPSHOT: &str = "snapshots are written over the picture itself";
const LOG: &str = "messages go to stdout and stderr; the shell sends them to files";
const RESOLVER: &str = "assets are found by ArResolver's own environment, such as PXR_AR_DEFAULT_SEARCH_PATH";

/// All of them: usdrecord's of OpenUSD 26.05, husk's of Houdini 20.5 and 21.
pub(crate) const ROWS: &[Row] = &[
    row(&["--mask"], Both, 1, Works("--mask"), ""),
    row(&["--purposes"], Usdrecord, 1, Works("--purposes"), "without it render, where usdrecord shows proxy"),
    row(&["--purpose"], Husk, 1, Works("--purposes"), "geometry is husk's word for default"),
    row(&["--sessionLayer"], Usdrecord, 1, Works("--session-layer"), ""),
    row(&["--disableGpu"], Usdrecord, 0, Idle, "gonio computes on the processor alone"),
    row(&["--disableDrawMode"], Usdrecord, 0, Works("--disable-draw-mode"), ""),
    row(&["--disableCameraLight"], Usdrecord, 0, Works("--disable-camera-light"), "the light is there only where the stage has none"),
    row(&["--camera"], Both, 1, Works("--camera"), "a name or a path"),
    row(&["-cam"], Usdrecord, 1, Works("--camera"), ""),
    row(
        &["-c"],
        Both,
        1,
        Read("--camera"),
        "low, medium, high and veryhigh are usdrecord's complexity, all else husk's camera; a camera called so wants --camera",
    ),
    row(&["--defaultTime", "-d"], Usdrecord, 0, Works("--default-time"), ""),
    row(&["--frames"], Usdrecord, 1, Works("--frames"), ""),
    row(&["--frame"], Husk, 1, Works("--frames"), ""),
    row(&["-f"], Both, 1, Works("--frames"), ""),
    row(&["--frame-count", "-n"], Husk, 1, Works("--frame-count"), ""),
    row(&["--frame-inc", "-i"], Husk, 1, Works("--frame-inc"), ""),
    row(&["--frame-list"], Husk, 1, Read("--frames"), "all numbers that follow"),
    row(&["--complexity"], Both, 1, Works("--complexity"), "without it high, where usdrecord has low"),
    row(
        &["--colorCorrectionMode", "-color"],
        Usdrecord,
        1,
        Read("--color-space"),
        "sRGB is what PNG and JPEG files are; EXR files are linear, which disabled asks for; openColorIO is refused: write EXR and convert that",
    ),
    row(&["--renderer"], Both, 1, Idle, "gonio is the renderer"),
    row(&["-R"], Husk, 1, Idle, "gonio is the renderer"),
    row(&["-r"], Both, 1, Read("--res"), "before two numbers husk's resolution, else usdrecord's renderer, which is gonio"),
    row(&["--imageWidth", "-w"], Usdrecord, 1, Works("--image-width"), ""),
    row(&["--enableDomeLightVisibility"], Usdrecord, 0, Idle, "the camera always sees domes"),
    row(&["--renderPassPrimPath", "-rp"], Usdrecord, 1, Works("--render-pass"), ""),
    row(&["--renderSettingsPrimPath", "-rs"], Usdrecord, 1, Works("--settings"), ""),
    row(&["--resolver"], Usdrecord, 1, Idle, "assets are found from the stage's own place and by ArResolver's environment"),
    row(&["--traceToFile"], Usdrecord, 1, Idle, "--verbose says what takes how long"),
    row(&["--traceFormat"], Usdrecord, 1, Idle, "--verbose says what takes how long"),
    row(&["--memstats"], Usdrecord, 0, Idle, "gonio info says what takes how much memory"),
    row(&["--usd-input"], Husk, 1, Read("STAGE"), ""),
    row(&["--list-cameras"], Husk, 0, Works("--list-cameras"), ""),
    row(&["--settings", "-s"], Husk, 1, Works("--settings"), ""),
    row(&["--pass"], Husk, 1, Works("--render-pass"), ""),
    row(
        &["--output", "-o"],
        Husk,
        1,
        Read("--output"),
        "names of pictures may be separated by commas; $F, $F4, <F>, <F4>, %d, %04d and #### stand for the frame",
    ),
    row(&["--res"], Husk, 2, Works("--res"), ""),
    row(&["--res-scale", "-S"], Husk, 1, Works("--res-scale"), "a factor; from 10 on per cent, as husk has it"),
    row(&["--pixel-aspect"], Husk, 1, Works("--pixel-aspect"), ""),
    row(&["--pixel-samples", "-p"], Husk, 1, Works("--spp"), ""),
    row(&["--threads", "-j"], Husk, 1, Works("--threads"), ""),
    row(&["--fps"], Husk, 1, Idle, "frames are time codes, whatever their rate"),
    row(&["--engine"], Husk, 1, Idle, "gonio has one engine, which runs on the processor"),
    row(&["--bucket-size"], Husk, 1, Idle, "tiles are 64 pixels wide and high, and change no picture"),
    row(&["--bucket-order"], Husk, 1, Idle, "the order of tiles changes no picture"),
    row(&["--image-mode"], Husk, 1, Idle, "how a picture comes about changes nothing of it"),
    row(&["--progressive-passes"], Husk, 1, Idle, "how a picture comes about changes nothing of it"),
    row(&["--convergence-mode"], Husk, 1, Idle, "all rays go one way; --noise-threshold ends pixels that are clean"),
    row(&["--optimize-offline"], Husk, 1, Idle, "gonio's trees are always made for whole renders"),
    row(&["--restart-delegate"], Husk, 1, Idle, "a frame is what it is alone, restarted or not"),
    row(&["--disable-scene-lights", "--disable-lighting"], Husk, 0, Works("--disable-scene-lights"), "surfaces that shine stay"),
    row(&["--disable-scene-materials"], Husk, 0, Works("--disable-scene-materials"), ""),
    row(&["--headlight"], Husk, 1, Works("--headlight"), "for stages without lights: none, distant or dome"),
    row(&["--autoheadlight"], Husk, 0, Idle, "stages without lights are lit from the camera anyway"),
    row(&["--disable-motionblur"], Husk, 0, Works("--disable-motion-blur"), ""),
    row(&["--snapshot"], Husk, 1, Works("--snapshot"), "over the file itself, whole or not at all; SIGUSR1 does the same once"),
    row(&["--snapshot-path"], Husk, 1, Idle, SNAPSHOT),
    row(&["--snapshot-suffix"], Husk, 1, Idle, SNAPSHOT),
    row(&["--snapshot-save-mode"], Husk, 1, Idle, SNAPSHOT),
    row(&["--autocrop"], Husk, 1, Works("--autocrop"), "names of passes, C and A among them, or *; EXR files alone become smaller"),
    row(&["--ocio"], Husk, 1, Idle, "--color-space names the space of EXR files; PNG and JPEG files are sRGB"),
    row(&["--disable-delegate-products"], Husk, 0, Idle, "products are written as the stage asks for them; -o names others"),
    row(&["--disable-dummy-raster-product"], Husk, 0, Idle, "products are written as the stage asks for them; -o names others"),
    row(&["--exrmode"], Husk, 1, Idle, "EXR files have one part with channels named as compositors expect"),
    row(&["--timelimit"], Husk, 1, Works("--time-limit"), "of each picture"),
    row(&["--timelimit-image"], Husk, 0, Idle, "the limit is each picture's anyway"),
    row(&["--timelimit-nosave-partial"], Husk, 0, Idle, "a picture at its limit is whole, with fewer samples, and is written"),
    row(&["--make-output-path"], Husk, 0, Idle, "folders that are not there are always made"),
    row(&["--lock-random"], Husk, 1, Works("--seed"), "without it all frames have the seed 0"),
    row(&["--dicingcamera"], Husk, 1, Idle, "surfaces are refined alike from all sides, by --complexity"),
    row(&["--fast-exit"], Husk, 1, Idle, "gonio ends when it is done"),
    row(&["--skip-licenses"], Husk, 1, Idle, LICENCE),
    row(&["--check-licenses"], Husk, 1, Idle, LICENCE),
    row(&["--list-license-checks"], Husk, 0, Idle, LICENCE),
    row(&["--skip-license-modes"], Husk, 1, Idle, LICENCE),
    row(&["--check-license-modes"], Husk, 1, Idle, LICENCE),
    row(&["--license-release-delay"], Husk, 1, Idle, LICENCE),
    row(&["--license-max-seat-hold"], Husk, 1, Idle, LICENCE),
    row(&["--apprentice"], Husk, 0, Idle, LICENCE),
    row(&["--indie"], Husk, 0, Idle, LICENCE),
    row(&["--core"], Husk, 0, Idle, LICENCE),
    row(&["--pdg"], Husk, 0, Idle, LICENCE),
    row(&["--no-mplay"], Husk, 0, Idle, WINDOW),
    row(&["--mplay-monitor"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-session"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-scale"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-update"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-bgimage"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-remotehost"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-gamma"], Husk, 1, Idle, WINDOW),
    row(&["--mplay-lut"], Husk, 1, Idle, WINDOW),
    row(&["--stdout"], Husk, 1, Idle, LOG),
    row(&["--stderr"], Husk, 1, Idle, LOG),
    row(&["--append-stdout"], Husk, 1, Idle, LOG),
    row(&["--append-stderr"], Husk, 1, Idle, LOG),
    row(&["--windows-console"], Husk, 1, Idle, LOG),
    row(&["--allowed-procedurals"], Husk, 1, Idle, "gonio has no procedurals; bake them into the stage"),
    row(&["--usd-trace"], Husk, 1, Idle, "--verbose says what takes how long"),
    row(&["--usd-chrome-file"], Husk, 1, Idle, "--verbose says what takes how long"),
    row(&["--verbose", "-V"], Husk, 1, Read("--verbose"), "0 is --quiet, from 3 on --verbose; letters change nothing"),
    row(&["--slap-comp"], Husk, 1, Refused, "gonio runs no compositing networks; write the passes with --aov and composite the EXR file"),
    row(
        &["--tile-count"],
        Husk,
        2,
        Refused,
        "parts of a picture are asked for by --part NUMBER/COUNT --checkpoint FILE, and 'gonio merge' joins them",
    ),
    row(
        &["--tile-index"],
        Husk,
        1,
        Refused,
        "parts of a picture are asked for by --part NUMBER/COUNT --checkpoint FILE, and 'gonio merge' joins them",
    ),
    row(
        &["--tile-suffix"],
        Husk,
        1,
        Refused,
        "parts of a picture are asked for by --part NUMBER/COUNT --checkpoint FILE, and 'gonio merge' joins them",
    ),
    row(&["--ao-samples"], Husk, 1, Refused, "gonio has no occlusion in place of light; --headlight dome is an even sky"),
    row(&["--ao-distance"], Husk, 1, Refused, "gonio has no occlusion in place of light; --headlight dome is an even sky"),
    row(&["--delegate-options"], Husk, 1, Refused, "gonio's own options are on the command line: gonio render --help"),
    row(&["--properties"], Husk, 0, Refused, "gonio's own options are on the command line: gonio render --help"),
    row(&["--property-definition"], Husk, 0, Refused, "gonio's own options are on the command line: gonio render --help"),
    row(&["--property-definition-file"], Husk, 1, Refused, "gonio's own options are on the command line: gonio render --help"),
    row(&["--procedurals"], Husk, 0, Refused, "gonio has no procedurals; bake them into the stage"),
    row(&["--capture-procedurals"], Husk, 0, Refused, "gonio has no procedurals; bake them into the stage"),
    row(&["--procedurals-capture-directory"], Husk, 1, Refused, "gonio has no procedurals; bake them into the stage"),
    row(&["--filters"], Husk, 0, Refused, "gonio's pixel filters stand under --filter in gonio render --help"),
    row(&["--list-renderers"], Husk, 0, Refused, "gonio is the only one"),
    row(&["--list-settings"], Husk, 0, Refused, "gonio info says what a stage holds; --settings names the prim"),
    row(&["--baking-info"], Husk, 0, Refused, "gonio map bakes illumination: gonio map --help"),
    row(&["--resolver-context"], Husk, 1, Refused, RESOLVER),
    row(&["--resolver-context-string"], Husk, 1, Refused, RESOLVER),
    row(&["--variant-fallback"], Husk, 1, Refused, "variants are chosen by prim: --variant 'PRIM{SET=NAME}'"),
    row(&["--prerender-script"], Husk, 1, Refused, "gonio runs no scripts; call it from one: import gonio"),
    row(&["--preframe-script"], Husk, 1, Refused, "gonio runs no scripts; call it from one: import gonio"),
    row(&["--postframe-script"], Husk, 1, Refused, "gonio runs no scripts; call it from one: import gonio"),
    row(&["--postrender-script"], Husk, 1, Refused, "gonio runs no scripts; call it from one: import gonio"),
];

/// The option that is written so.
pub(crate) fn find(name: &str) -> Option<&'static Row> {
    ROWS.iter().find(|row| row.names.contains(&name))
}
