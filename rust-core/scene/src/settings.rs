//! How a scene is rendered.

use super::antialiasing::Antialiasing;
use super::aov::{Aov, LIGHT_GROUP, LIGHT_PATH, ShaderValue, standard_pass};
use super::cryptomatte::{MATTE_RANKS, MOST_MATTE_RANKS, MatteKind};
use super::light_path::{LightPath, light_path};
use super::shutter::Shutter;
use serde::{Deserialize, Serialize};
use std::{ops::Range, path::PathBuf};

/// A rectangle of pixels: `[min, max)`, rows counted from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Crop {
    /// First column and row.
    pub min: [u32; 2],
    /// Behind the last column and row.
    pub max: [u32; 2],
}

/// The pixel filter; it is sampled, not splatted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Filter {
    /// Constant over the width.
    Box,
    /// Linear to zero at half the width.
    Tent,
    /// Gaussian with a standard deviation of a sixth of the width, cut at half the width.
    Gaussian,
    /// Blackman–Harris window over the width.
    BlackmanHarris,
}

/// The light transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integrator {
    /// Path tracing with multiple importance sampling.
    Path,
    /// The same, stopped after direct light.
    Direct,
    /// Direct light of every light by fixed samples, and all that is mirrored and refracted sharply: without noise, without light from
    /// surface to surface (Whitted 1980).
    Whitted,
    /// Paths from the lights alone (light tracing): what surfaces send straight to the camera. Lights are seen, also in mirrors and through clear glass,
    /// where nothing else is.
    Light,
}

impl Integrator {
    /// All of them with their names.
    pub const NAMES: [(Self, &'static str); 4] =
        [(Self::Path, "path"), (Self::Direct, "direct"), (Self::Whitted, "whitted"), (Self::Light, "light")];
}

/// Whether light paths bring the light that comes by mirrors and smooth glass to surfaces that the camera sees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Caustics {
    /// Where a few light paths tell, when the scene is compiled, that they pay.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never: camera paths find what they happen to hit.
    Off,
}

impl Caustics {
    /// All of them with their names.
    pub const NAMES: [(Self, &'static str); 3] = [(Self::Auto, "auto"), (Self::On, "on"), (Self::Off, "off")];
}

/// Whether paths go more often where indirect light was found to come from (path guiding). Where the small pictures that it is learned from do not
/// promise that it pays, it is given up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Guiding {
    /// Never; nothing is learned.
    #[default]
    Off,
    /// Learned whatever that costs.
    On,
    /// Learned where a render is so large that learning is a small part of it.
    Auto,
}

impl Guiding {
    /// All of them with their names.
    pub const NAMES: [(Self, &'static str); 3] = [(Self::Off, "off"), (Self::On, "on"), (Self::Auto, "auto")];
}

/// What sees light that has wavelengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Observer {
    /// The CIE's of 1931: colour, whose luminance is in cd/m².
    #[default]
    Luminous,
    /// Melanopsin (CIE S 026): grey, in cd/m² of D65 that would bring as much.
    Melanopic,
}

impl Observer {
    /// Whether it sees colours.
    pub fn is_luminous(&self) -> bool {
        *self == Self::Luminous
    }
}

/// What is where the camera sees no surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Background {
    /// Lights at infinity, without coverage.
    #[default]
    Seen,
    /// Lights at infinity, with coverage as if they were a wall.
    Covering,
    /// Nothing.
    Transparent,
}

/// Where the mist pass starts and how deep it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mist {
    /// Distance from the camera at which it begins, metres.
    pub start: f32,
    /// Metres until it is full.
    pub depth: f32,
    /// Exponent of the way between.
    pub falloff: f32,
}

impl Default for Mist {
    fn default() -> Self {
        Self { start: 5.0, depth: 25.0, falloff: 2.0 }
    }
}

/// How a scene is rendered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Width of a pixel over its height.
    pub pixel_aspect: f64,
    /// The part of the image that is rendered.
    pub crop: Option<Crop>,
    /// Pixels at the left, top, right and bottom of the resolution that lie outside the picture proper, as EXR files say (overscan).
    #[serde(default)]
    pub overscan: [u32; 4],
    /// Which camera of the scene.
    pub camera: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// Which of them are rendered, `[first, behind the last]`; `None` is all. Ranges start and end where blocks of samples do.
    #[serde(default)]
    pub sample_range: Option<[u32; 2]>,
    /// Which tiles of 64 × 64 pixels are rendered, `[first, behind the last]`, counted row by row in the part of the image; `None` is all.
    #[serde(default)]
    pub tile_range: Option<[u32; 2]>,
    /// Estimated error of 8 × 8 pixels, relative to what is shown, at which they have enough samples; 0 is off. On Cycles' scale.
    #[serde(default)]
    pub noise_threshold: f32,
    /// Samples before any estimate; 0 leaves it to the threshold.
    #[serde(default)]
    pub min_samples: u32,
    /// Value of the colour pass that is shown as white, for the estimate and for adaptive antialiasing; 0 takes it from a small picture of the view.
    #[serde(default)]
    pub noise_white: f32,
    /// Seed of the random numbers.
    pub seed: u32,
    /// The light transport.
    pub integrator: Integrator,
    /// Bounces after the first hit.
    pub max_bounces: u32,
    /// Samples of each light that has an extent, for [`Integrator::Whitted`]: 1 to [`MOST_LIGHT_SAMPLES`].
    #[serde(default = "light_samples")]
    pub light_samples: u32,
    /// Bounces by kind: diffuse, glossy and transmitted scatterings, and surfaces seen straight through; at most 255.
    #[serde(default = "all_bounces")]
    pub kind_bounces: [u32; 4],
    /// Scatterings in media; at most 255.
    #[serde(default = "volume_bounces")]
    pub volume_bounces: u32,
    /// What is where the camera sees no surface.
    #[serde(default)]
    pub background: Background,
    /// The mist pass.
    #[serde(default)]
    pub mist: Mist,
    /// Whether light paths bring caustics; for [`Integrator::Path`].
    #[serde(default)]
    pub caustics: Caustics,
    /// Whether paths go more often where indirect light comes from; for [`Integrator::Path`].
    #[serde(default)]
    pub guiding: Guiding,
    /// Whether light has wavelengths, three a path, in place of red, green and blue.
    #[serde(default)]
    pub spectral: bool,
    /// What sees light that has wavelengths.
    #[serde(default, skip_serializing_if = "Observer::is_luminous")]
    pub observer: Observer,
    /// Whether there are caustics at all: of what reflects, and of what refracts. Without, light that surfaces scatter diffusely does not come from
    /// either. For [`Integrator::Path`].
    #[serde(default = "all_caustics")]
    pub caustic_paths: [bool; 2],
    /// Before a transparent background glass of this roughness at most is transparent too; `None` is never.
    #[serde(default)]
    pub clear_roughness: Option<f32>,
    /// Where in a pixel samples lie; but for [`Antialiasing::Sampled`] it takes the number of samples that it tells and no filter.
    #[serde(default)]
    pub antialiasing: Antialiasing,
    /// When and how the shutter is open.
    #[serde(default)]
    pub shutter: Shutter,
    /// Pixel filter.
    pub filter: Filter,
    /// Width of the filter in pixels.
    pub filter_width: f32,
    /// Upper limit of a direct sample, as the mean of its components; 0 is off.
    pub clamp_direct: f32,
    /// Upper limit of an indirect sample, as the mean of its components; 0 is off.
    pub clamp_indirect: f32,
    /// Worker threads; 0 means one a core.
    pub threads: u32,
    /// Passes wanted.
    pub aovs: Vec<Aov>,
    /// Names of the shader outputs that passes show.
    #[serde(default)]
    pub shader_passes: Vec<String>,
    /// Names of the light groups that passes show.
    #[serde(default)]
    pub light_groups: Vec<String>,
    /// What the passes of light paths are called: their expressions.
    #[serde(default)]
    pub light_paths: Vec<String>,
    /// Metres up to which surfaces count for ambient occlusion.
    #[serde(default = "occlusion_distance")]
    pub occlusion_distance: f32,
    /// Ranks of the cryptomattes that are asked for as a whole: 2 to [`MOST_MATTE_RANKS`], even.
    #[serde(default = "matte_ranks")]
    pub cryptomatte_depth: u32,
    /// Share by which depths of deep pictures may differ and still be one sample.
    #[serde(default = "deep_tolerance")]
    pub deep_tolerance: f32,
    /// Stop after this many seconds; 0 is off.
    pub time_limit_s: f64,
    /// Bytes that textures of materials may take at once; 0 is no limit.
    #[serde(default)]
    pub texture_memory: u64,
    /// Folder for the tiles of textures, which are made where there is a limit; `None` is the user's folder for caches.
    #[serde(default)]
    pub texture_cache: Option<PathBuf>,
    /// Bytes that displaced meshes may take; what goes beyond keeps its shape.
    #[serde(default = "displacement_memory")]
    pub displacement_memory: u64,
}

/// Bytes by a number and a unit of powers of 1024: `64M`, `1.5G`, `2 GiB`, `800 MB`; without a unit bytes.
pub fn parse_bytes(text: &str) -> Result<u64, String> {
    let expected = || format!("'{text}' was found, expected a size such as 512M or 1.5G");
    let text = text.trim();
    let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
    let number: f64 = text[..end].parse().map_err(|_| expected())?;
    let unit = text[end..].trim().to_ascii_uppercase();
    let unit = unit.strip_suffix("IB").or_else(|| unit.strip_suffix('B')).unwrap_or(&unit);
    let power = ["", "K", "M", "G", "T"].iter().position(|known| *known == unit).ok_or_else(expected)?;
    let bytes = number * 1024_f64.powi(power as i32);
    if bytes.is_finite() && bytes < 1e18 { Ok(bytes.ceil() as u64) } else { Err(expected()) }
}

/// Bytes that displaced meshes may take where nothing else is said.
const DISPLACEMENT_MEMORY: u64 = 4 << 30;

fn displacement_memory() -> u64 {
    DISPLACEMENT_MEMORY
}

/// Most samples of one light.
pub const MOST_LIGHT_SAMPLES: u32 = 16;

fn light_samples() -> u32 {
    MOST_LIGHT_SAMPLES
}

fn all_caustics() -> [bool; 2] {
    [true; 2]
}

fn occlusion_distance() -> f32 {
    10.0
}

fn deep_tolerance() -> f32 {
    1e-3
}

fn matte_ranks() -> u32 {
    MATTE_RANKS
}

fn volume_bounces() -> u32 {
    255
}

/// No other limit than that of all bounces.
fn all_bounces() -> [u32; 4] {
    [255; 4]
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            resolution: [1280, 720],
            pixel_aspect: 1.0,
            crop: None,
            overscan: [0; 4],
            camera: 0,
            samples: 64,
            sample_range: None,
            tile_range: None,
            noise_threshold: 0.0,
            min_samples: 0,
            noise_white: 0.0,
            seed: 0,
            integrator: Integrator::Path,
            max_bounces: 12,
            light_samples: light_samples(),
            kind_bounces: all_bounces(),
            volume_bounces: volume_bounces(),
            background: Background::default(),
            mist: Mist::default(),
            caustics: Caustics::default(),
            guiding: Guiding::default(),
            spectral: false,
            observer: Observer::Luminous,
            caustic_paths: all_caustics(),
            clear_roughness: None,
            antialiasing: Antialiasing::default(),
            shutter: Shutter::default(),
            filter: Filter::BlackmanHarris,
            filter_width: 1.5,
            clamp_direct: 0.0,
            clamp_indirect: 0.0,
            threads: 0,
            aovs: vec![Aov::Color],
            shader_passes: Vec::new(),
            light_groups: Vec::new(),
            light_paths: Vec::new(),
            occlusion_distance: occlusion_distance(),
            cryptomatte_depth: matte_ranks(),
            deep_tolerance: deep_tolerance(),
            time_limit_s: 0.0,
            texture_memory: 0,
            displacement_memory: DISPLACEMENT_MEMORY,
            texture_cache: None,
        }
    }
}

/// The place of a name in a list, to which it is added if it is new.
fn entered(list: &mut Vec<String>, name: &str) -> Option<u16> {
    let known = list.iter().position(|known| known == name);
    let number = known.unwrap_or(list.len());
    if known.is_none() {
        list.push(name.to_owned());
    }
    u16::try_from(number).ok()
}

impl Settings {
    /// Sets where in a pixel samples lie, and how many there are where that follows.
    pub fn set_antialiasing(&mut self, antialiasing: Antialiasing) {
        self.antialiasing = antialiasing;
        self.samples = antialiasing.samples().unwrap_or(self.samples);
    }
    /// The samples that are rendered.
    pub fn range(&self) -> Range<u32> {
        self.sample_range.map_or(0..self.samples, |[first, end]| first..end)
    }
    /// The tiles that are rendered, of so many.
    pub fn tiles(&self, count: u32) -> Range<u32> {
        self.tile_range.map_or(0..count, |[first, end]| first..end)
    }
    /// Samples before the noise is looked at; `None` where it never is. Left to the threshold it is Cycles' choice: 64 for 0.01, 32 for 0.1.
    pub fn least_samples(&self) -> Option<u32> {
        let by_threshold = || (16.0 / self.noise_threshold.powf(0.3)).ceil() as u32;
        let wanted = if self.min_samples > 0 { self.min_samples } else { by_threshold() };
        (self.noise_threshold > 0.0).then_some(wanted.max(4))
    }
    /// Sets the passes by their names, in any case of letters but for those with names of their own: shader passes, which are called `aov:`
    /// (colours) or `aov_value:` (numbers) and the name of the output, and `lightgroup:` with the name of the group; and mattes, as a
    /// whole (`cryptomatte_object`) or layer by layer (`CryptoObject00`). Expressions
    /// of light paths follow `lpe:`, primvars `primvars:`. Gives the first name that no pass has.
    pub fn set_passes(&mut self, names: &[String]) -> Result<(), String> {
        let mut next =
            Self { aovs: Vec::new(), shader_passes: Vec::new(), light_groups: Vec::new(), light_paths: Vec::new(), ..self.clone() };
        for name in names {
            let aovs = next.named_passes(name).ok_or_else(|| name.clone())?;
            next.aovs.extend(aovs);
        }
        *self = next;
        Ok(())
    }
    /// The passes that a name stands for, entered where they have names of their own; `None` for names that no pass has.
    pub fn named_passes(&mut self, name: &str) -> Option<Vec<Aov>> {
        if let Some(kind) = MatteKind::by_name(name) {
            return Some(self.matte_layers(kind).collect());
        }
        if let Some((kind, output)) = ShaderValue::PREFIXES.iter().find_map(|(kind, prefix)| Some((*kind, name.strip_prefix(prefix)?))) {
            return self.shader_pass(kind, output).map(|aov| vec![aov]);
        }
        let one = if let Some(kind) = standard_pass(name) {
            self.shader_pass(kind, name)?
        } else if let Some(group) = name.strip_prefix(LIGHT_GROUP) {
            Aov::LightGroup(entered(&mut self.light_groups, group)?)
        } else if let Some(expression) = name.strip_prefix(LIGHT_PATH) {
            self.light_path_pass(expression)?
        } else if let Some((kind, layer)) = MatteKind::by_layer(name) {
            Aov::Cryptomatte(kind, layer)
        } else {
            Aov::by_name(name)?
        };
        Some(vec![one])
    }
    /// The pass of a shader output.
    pub fn shader_pass(&mut self, kind: ShaderValue, name: &str) -> Option<Aov> {
        entered(&mut self.shader_passes, name).map(|number| Aov::Shader(kind, number))
    }
    /// The pass of a light path expression; `None` for those that cannot be shown.
    pub fn light_path_pass(&mut self, expression: &str) -> Option<Aov> {
        match light_path(expression).ok()? {
            LightPath::Classes(classes) => entered(&mut self.light_paths, expression).map(|number| Aov::LightPaths(classes, number)),
            LightPath::Followed => entered(&mut self.light_paths, expression).map(Aov::LightExpression),
            LightPath::Group(name) => entered(&mut self.light_groups, &name).map(Aov::LightGroup),
        }
    }
    /// Adds passes of the named light groups to those that are set.
    pub fn add_light_groups(&mut self, names: Vec<String>) {
        for name in names {
            if !self.light_groups.contains(&name) {
                self.aovs.push(Aov::LightGroup(self.light_groups.len() as u16));
                self.light_groups.push(name);
            }
        }
    }
    /// The layers of a matte.
    pub fn matte_layers(&self, kind: MatteKind) -> impl Iterator<Item = Aov> + use<> {
        (0..self.cryptomatte_depth.clamp(2, MOST_MATTE_RANKS).div_ceil(2) as u8).map(move |layer| Aov::Cryptomatte(kind, layer))
    }
    /// Sets the ranks of mattes, those that are asked for already among them.
    pub fn set_cryptomatte_depth(&mut self, ranks: u32) {
        self.cryptomatte_depth = ranks;
        let mut aovs: Vec<Aov> = Vec::with_capacity(self.aovs.len());
        for aov in std::mem::take(&mut self.aovs) {
            match aov {
                Aov::Cryptomatte(kind, 0) => aovs.extend(self.matte_layers(kind)),
                Aov::Cryptomatte(..) => {}
                other => aovs.push(other),
            }
        }
        self.aovs = aovs;
    }
    /// The kinds of mattes that passes show, each once.
    pub fn matte_kinds(&self) -> Vec<MatteKind> {
        let asked = |kind: &MatteKind| self.aovs.iter().any(|aov| matches!(aov, Aov::Cryptomatte(known, _) if known == kind));
        MatteKind::NAMES.iter().map(|(kind, ..)| *kind).filter(asked).collect()
    }
    /// A pass's name, those with names of their own among them.
    pub fn pass_name(&self, aov: Aov) -> String {
        match aov {
            Aov::LightPaths(_, number) | Aov::LightExpression(number) => {
                format!("{LIGHT_PATH}{}", self.light_paths.get(usize::from(number)).map_or("", String::as_str))
            }
            Aov::Shader(kind, number) => {
                let name = self.shader_passes.get(usize::from(number)).map_or("", String::as_str);
                if standard_pass(name) == Some(kind) {
                    return name.to_owned();
                }
                let prefix = ShaderValue::PREFIXES.iter().find(|(known, _)| *known == kind).map_or("", |(_, prefix)| prefix);
                format!("{prefix}{name}")
            }
            Aov::LightGroup(number) => format!("{LIGHT_GROUP}{}", self.light_groups.get(usize::from(number)).map_or("", String::as_str)),
            Aov::Cryptomatte(kind, layer) => format!("{}{layer:02}", kind.layers()),
            other => other.name().to_owned(),
        }
    }
}
