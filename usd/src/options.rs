//! What of a stage is read, and how.

use crate::render_settings::RenderSettings;
use gonio::scene::Aov;
use std::path::PathBuf;

/// The time at which attributes are read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SampleTime {
    /// The stage's start time code; where it has none, the earliest sample of each attribute.
    #[default]
    Start,
    /// Default values, time samples are not looked at.
    Default,
    /// A time code.
    Code(f64),
}

/// How finely subdivision surfaces and quadrics are cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Complexity {
    /// Control meshes as they are.
    Low,
    /// One level.
    Medium,
    /// Two levels; the default.
    #[default]
    High,
    /// Three levels.
    VeryHigh,
    /// Two levels, and then as the pixels of the camera ask for.
    Auto,
}

impl Complexity {
    /// The complexity by usdrecord's name.
    pub fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "low" => Self::Low,
            "medium" => Self::Medium,
            "high" => Self::High,
            "veryhigh" => Self::VeryHigh,
            "auto" => Self::Auto,
            _ => return None,
        })
    }

    /// Levels of uniform subdivision.
    pub fn levels(self) -> u32 {
        match self {
            Self::Low => 0,
            Self::Medium => 1,
            Self::High | Self::Auto => 2,
            Self::VeryHigh => 3,
        }
    }
}

/// `UsdGeomImageable`'s purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Purpose {
    /// Always of interest.
    #[default]
    Default,
    /// For final pictures.
    Render,
    /// A light stand-in.
    Proxy,
    /// For people's orientation.
    Guide,
}

impl Purpose {
    /// The purpose by its token; `geometry` is husk's word for default.
    pub fn from_token(token: &str) -> Option<Self> {
        Some(match token {
            "default" | "geometry" => Self::Default,
            "render" => Self::Render,
            "proxy" => Self::Proxy,
            "guide" => Self::Guide,
            _ => return None,
        })
    }
}

/// A choice in a variant set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VariantSelection {
    /// Path of the prim.
    pub prim: String,
    /// The variant set.
    pub set: String,
    /// The variant.
    pub variant: String,
}

impl VariantSelection {
    /// From `/Prim{set=variant}`.
    pub fn parse(text: &str) -> Option<Self> {
        let (prim, rest) = text.split_once('{')?;
        let (set, variant) = rest.strip_suffix('}')?.split_once('=')?;
        let [prim, set, variant] = [prim, set, variant].map(|part| part.trim().to_owned());
        (prim.starts_with('/') && !set.is_empty()).then_some(Self { prim, set, variant })
    }
}

/// Where a prim stands to the part of the stage that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It is read.
    Within,
    /// It holds what is read.
    Above,
    /// It is left out.
    Beside,
}

/// What of a stage is read, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct StageOptions {
    /// When attributes are read.
    pub time: SampleTime,
    /// Purposes that are shown; `Default` always is.
    pub purposes: Option<Vec<Purpose>>,
    /// How finely curved surfaces are cut.
    pub complexity: Complexity,
    /// Prim paths to which the stage is limited, with what these refer to; empty means all of it.
    pub population_mask: Vec<String>,
    /// Path of the camera that is looked through, which is read whatever the mask says.
    pub camera: Option<String>,
    /// Path of a prim that is read alone, with all below it: nothing beside it is, but for what it refers to.
    pub subtree: Option<String>,
    /// Choices that replace those of the files.
    pub variants: Vec<VariantSelection>,
    /// A layer that is put over the stage.
    pub session_layer: Option<PathBuf>,
    /// Whether layers are read into memory as a whole, so that files that change on disk later do not matter.
    pub detached: bool,
    /// Whether what time does not change is kept from one reading for those at other times.
    pub kept: bool,
    /// Whether payloads are loaded.
    pub load_payloads: bool,
    /// Purposes of material bindings in the order in which they are tried; the empty one is the all-purpose binding.
    pub material_binding_purposes: Option<Vec<String>>,
    /// Path of the RenderSettings prim; `None` takes the one that the stage names.
    pub render_settings: Option<String>,
    /// Path of the RenderPass prim that says what is shown.
    pub render_pass: Option<String>,
    /// Whether nothing moves while the shutter is open, whatever the render settings say.
    pub disable_motion_blur: bool,
    /// Whether models are shown themselves, whatever `model:drawMode` says.
    pub disable_draw_mode: bool,
    /// Whether the camera does not see the shapes of lamps, whatever the render settings say.
    pub hide_lights: bool,
    /// Whether light has wavelengths, whatever the render settings say.
    pub spectral: bool,
    /// Visibility of haze that fills all of space, metres, whatever the stage says; `None` leaves it to the stage.
    pub haze: Option<f64>,
    /// Whether a pass of motion vectors is asked for: where nothing is blurred, things are then read at the frames before and after too.
    pub motion_vectors: bool,
    /// Whether warnings end the reading.
    pub strict: bool,
    /// Whether the reading goes on where a light's photometric file cannot be read, with a warning and a stand-in.
    pub lenient: bool,
}

impl Default for StageOptions {
    fn default() -> Self {
        Self {
            time: SampleTime::Start,
            purposes: None,
            complexity: Complexity::default(),
            population_mask: Vec::new(),
            camera: None,
            subtree: None,
            variants: Vec::new(),
            session_layer: None,
            detached: false,
            kept: false,
            load_payloads: true,
            material_binding_purposes: None,
            render_settings: None,
            render_pass: None,
            disable_motion_blur: false,
            disable_draw_mode: false,
            hide_lights: false,
            spectral: false,
            haze: None,
            motion_vectors: false,
            strict: false,
            lenient: true,
        }
    }
}

impl StageOptions {
    /// The purposes of material bindings in the order in which they are tried.
    pub fn binding_purposes(&self) -> Vec<String> {
        self.material_binding_purposes.clone().unwrap_or_else(|| vec!["full".into(), String::new()])
    }

    /// These options, with what the stage's render settings say where the caller said nothing.
    pub fn with_settings(&self, settings: Option<&RenderSettings>) -> Self {
        let mut options = self.clone();
        if let Some(settings) = settings {
            options.disable_motion_blur |= settings.framing.disable_motion_blur;
            options.hide_lights |= settings.hide_lights;
            options.spectral |= settings.spectral;
            options.motion_vectors |= settings.shows(Aov::Motion);
            options.purposes.get_or_insert_with(|| settings.purposes.clone());
            options.material_binding_purposes.get_or_insert_with(|| settings.material_binding_purposes.clone());
        }
        options
    }

    /// Where a prim stands to those that are read.
    pub fn standing(&self, path: &str) -> Standing {
        let below = |path: &str, root: &str| path.strip_prefix(root).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'));
        match &self.subtree {
            Some(root) if !below(path, root) => {
                if below(root, path) {
                    Standing::Above
                } else {
                    Standing::Beside
                }
            }
            _ => Standing::Within,
        }
    }

    /// Whether things of this purpose are shown.
    pub fn shows(&self, purpose: Purpose) -> bool {
        purpose == Purpose::Default || self.purposes.as_deref().unwrap_or(&[Purpose::Render]).contains(&purpose)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_subtree_holds_what_is_below_its_root() {
        let options = StageOptions { subtree: Some("/A/Lamp".into()), ..StageOptions::default() };
        let found = ["/A/Lamp", "/A/Lamp/B", "/A", "/A/Lamp2", "/B"].map(|path| options.standing(path));
        assert_eq!(found, [Standing::Within, Standing::Within, Standing::Above, Standing::Beside, Standing::Beside]);
        assert_eq!(StageOptions::default().standing("/B"), Standing::Within);
    }

    #[test]
    fn variants_are_parsed() {
        let parsed = VariantSelection::parse("/A/B{look=red}").expect("valid");
        assert_eq!(parsed, VariantSelection { prim: "/A/B".into(), set: "look".into(), variant: "red".into() });
        for bad in ["A{x=y}", "/A", "/A{x}", "/A{=y}", "/A{x=y"] {
            assert_eq!(VariantSelection::parse(bad), None, "{bad}");
        }
    }
}
