//! Which passes a film keeps, and where their channels lie.

use crate::scene::Aov;

/// The passes of a film and the first channel of each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChannelLayout {
    /// Passes in the order of their channels.
    pub aovs: Vec<Aov>,
    /// First channel of each pass.
    pub offsets: Vec<usize>,
    /// Channels in all.
    pub channels: usize,
}

impl ChannelLayout {
    /// A layout of the passes asked for, each once.
    pub fn new(aovs: &[Aov]) -> Self {
        let mut layout = Self::default();
        for aov in aovs {
            if !layout.aovs.contains(aov) {
                layout.aovs.push(*aov);
                layout.offsets.push(layout.channels);
                layout.channels += channel_names(*aov).len();
            }
        }
        layout
    }

    /// First channel of a pass.
    pub fn offset(&self, aov: Aov) -> Option<usize> {
        self.aovs.iter().position(|known| *known == aov).map(|i| self.offsets[i])
    }
}

/// The channels of a pass.
pub fn channel_names(aov: Aov) -> &'static [&'static str] {
    match aov {
        Aov::Color => &["R", "G", "B", "A"],
        Aov::Alpha => &["A"],
        Aov::Depth => &["Z"],
        Aov::Normal | Aov::P => &["X", "Y", "Z"],
        Aov::Albedo => &["R", "G", "B"],
        Aov::PrimId => &["id"],
        Aov::Luminance | Aov::Illuminance => &["Y"],
    }
}

/// Whether a pass holds absolute values, which files keep as 32-bit floats.
pub fn is_absolute(aov: Aov) -> bool {
    !matches!(aov, Aov::Color | Aov::Alpha | Aov::Albedo | Aov::Normal)
}
