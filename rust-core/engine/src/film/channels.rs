//! Which passes a film keeps, and where their channels lie.

use super::backdrop::Besides;
use crate::scene::{Aov, LightPart, MatteKind, ScatteringKind, ShaderValue};

/// Radiance of catchers with all objects, and without them; what is behind; coverage.
const CATCHER_CHANNELS: usize = 10;

/// The passes of a film and the first channel of each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChannelLayout {
    /// Passes in the order of their channels; mattes and deep pictures have none, and are kept in other ways.
    pub aovs: Vec<Aov>,
    /// First channel of each pass.
    pub offsets: Vec<usize>,
    /// Channels in all.
    pub channels: usize,
    /// First channel of what shadow catchers hide, where there are any; no pass shows it as it is.
    pub catchers: Option<usize>,
    /// The channel of the shares that holdouts have before a sky that is seen, where there are any.
    pub holes: Option<usize>,
}

impl ChannelLayout {
    /// A layout of the passes asked for, each once.
    pub fn new(aovs: &[Aov]) -> Self {
        let mut layout = Self::default();
        for aov in aovs {
            if !layout.aovs.contains(aov) {
                layout.aovs.push(*aov);
                layout.offsets.push(layout.channels);
                layout.channels += summed_channels(*aov);
            }
        }
        layout
    }

    /// A layout of the passes asked for and of those that they are divided by.
    pub fn with_divisors(aovs: &[Aov]) -> Self {
        let divisors = aovs.iter().filter_map(|aov| divisor(*aov));
        // A deep picture flattens to the colour.
        let flat = aovs.contains(&Aov::Deep).then_some(Aov::Color);
        Self::new(&aovs.iter().copied().chain(divisors).chain(flat).collect::<Vec<_>>())
    }

    /// Makes room for what shadow catchers hide, and for what holdouts hide of the sky.
    pub fn besides(self, wanted: Besides) -> Self {
        let mut channels = self.channels;
        let mut room = |wanted: bool, count: usize| {
            let first = wanted.then_some(channels);
            channels += if wanted { count } else { 0 };
            first
        };
        let catchers = room(wanted.catchers, CATCHER_CHANNELS);
        let holes = room(wanted.sky && wanted.holdouts, 1);
        Self { catchers, holes, channels, ..self }
    }

    /// Whether a pass shows light by where it comes from.
    pub fn shows_lights(&self) -> bool {
        self.aovs.iter().any(|aov| matches!(aov, Aov::Light(..) | Aov::LightPaths(..) | Aov::Emission | Aov::Environment))
    }

    /// The number of a light path expression among those that are followed.
    pub fn expression(&self, aov: Aov) -> u32 {
        let before = self.aovs.iter().take_while(|known| **known != aov);
        before.filter(|known| matches!(known, Aov::LightExpression(_))).count() as u32
    }

    /// Channels of all shader passes.
    pub fn shader_columns(&self) -> usize {
        self.aovs.iter().filter(|aov| matches!(aov, Aov::Shader(..))).map(|aov| channel_names(*aov).len()).sum()
    }

    /// Channels of the shader passes before this one.
    pub fn shader_column(&self, aov: Aov) -> usize {
        let before = self.aovs.iter().take_while(|known| **known != aov);
        before.filter(|known| matches!(known, Aov::Shader(..))).map(|known| channel_names(*known).len()).sum()
    }

    /// The kinds of mattes that passes show, each once.
    pub fn mattes(&self) -> Vec<MatteKind> {
        let shown = |kind: &MatteKind| self.aovs.iter().any(|aov| matches!(aov, Aov::Cryptomatte(known, _) if known == kind));
        MatteKind::NAMES.iter().map(|(kind, ..)| *kind).filter(shown).collect()
    }

    /// First channel of a pass.
    pub fn offset(&self, aov: Aov) -> Option<usize> {
        self.aovs.iter().position(|known| *known == aov).map(|i| self.offsets[i])
    }
}

/// How many sums a pixel a pass is kept as.
pub(super) fn summed_channels(aov: Aov) -> usize {
    match aov {
        Aov::Cryptomatte(..) | Aov::ShadowCatcher | Aov::Deep => 0,
        // And how much of the pixel they are means over.
        Aov::Motion => MOTION_CHANNELS + 1,
        _ => channel_names(aov).len(),
    }
}

/// Channels of motion vectors.
pub(super) const MOTION_CHANNELS: usize = 4;

/// The channels of a pass.
pub fn channel_names(aov: Aov) -> &'static [&'static str] {
    match aov {
        Aov::Color | Aov::Shader(ShaderValue::Color, _) => &["R", "G", "B", "A"],
        // As compositors look for them: value and share, twice.
        Aov::Cryptomatte(..) => &["r", "g", "b", "a"],
        Aov::Alpha => &["A"],
        Aov::Depth => &["Z"],
        Aov::Normal | Aov::P | Aov::DenoisingNormal => &["X", "Y", "Z"],
        Aov::Uv => &["U", "V", "A"],
        Aov::Motion => &["X", "Y", "Z", "W"],
        Aov::Albedo
        | Aov::DenoisingAlbedo
        | Aov::DenoisingLight
        | Aov::Emission
        | Aov::Environment
        | Aov::Light(..)
        | Aov::LightPaths(..)
        | Aov::LightExpression(_)
        | Aov::ShadowCatcher
        | Aov::LightGroup(_) => &["R", "G", "B"],
        Aov::PrimId | Aov::InstanceId | Aov::ElementId | Aov::ObjectIndex | Aov::MaterialIndex => &["id"],
        Aov::Mist | Aov::SampleCount | Aov::Cost | Aov::Shader(ShaderValue::Number, _) => &["value"],
        Aov::Luminance | Aov::Illuminance => &["Y"],
        // It has files of its own.
        Aov::Deep => &[],
    }
}

/// Whether a pass holds absolute values, which files keep as 32-bit floats.
pub fn is_absolute(aov: Aov) -> bool {
    use Aov::{Albedo, Alpha, Color, DenoisingAlbedo, DenoisingLight, DenoisingNormal, Light, LightGroup, Normal};
    // The values of names are bits.
    let relative = matches!(aov, Color | Alpha | Albedo | Normal | DenoisingNormal | DenoisingAlbedo | DenoisingLight);
    !relative
        && !matches!(aov, Light(_, LightPart::Color) | LightGroup(_) | Aov::LightPaths(..) | Aov::LightExpression(_) | Aov::ShadowCatcher)
}

/// Whether values are numbers of things, of which the first that is met counts.
pub fn is_index(aov: Aov) -> bool {
    matches!(aov, Aov::PrimId | Aov::InstanceId | Aov::ElementId | Aov::ObjectIndex | Aov::MaterialIndex)
}

/// The pass that a pass of light is divided by.
pub fn divisor(aov: Aov) -> Option<Aov> {
    match aov {
        // What floats in a medium has no albedo of a surface.
        Aov::Light(ScatteringKind::Volume, _) => None,
        Aov::Light(kind, LightPart::Direct | LightPart::Indirect) => Some(Aov::Light(kind, LightPart::Color)),
        _ => None,
    }
}
