//! Antialiasing by places, and where it is needed.

use serde::{Deserialize, Serialize};

/// Where in a pixel samples lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Antialiasing {
    /// At random places, by the pixel filter.
    #[default]
    Sampled,
    /// On a regular grid of so many places along a pixel's side, which count alike.
    Grid(u32),
    /// Where they are needed, by two thresholds; for [`super::Integrator::Whitted`].
    Adaptive,
    /// The same with lower thresholds.
    High,
    /// The same by one threshold.
    Paper,
}

/// Most places along a pixel's side.
const MOST_GRID: u32 = 32;

impl Antialiasing {
    /// Those that have names.
    pub const NAMES: [(Self, &'static str); 4] =
        [(Self::Sampled, "sampled"), (Self::Adaptive, "adaptive"), (Self::High, "high"), (Self::Paper, "paper")];

    /// The one of a name, or of the number of places along a pixel's side.
    pub fn by_name(text: &str) -> Option<Self> {
        let grid = || text.parse().ok().filter(|side| (1..=MOST_GRID).contains(side)).map(Self::Grid);
        Self::NAMES.iter().find(|(_, name)| *name == text).map(|(known, _)| *known).or_else(grid)
    }
    /// Whether the number of samples depends on what they show.
    pub fn is_adaptive(self) -> bool {
        matches!(self, Self::Adaptive | Self::High | Self::Paper)
    }
    /// The samples a pixel that a render has to be set to; any if `None`.
    pub fn samples(self) -> Option<u32> {
        match self {
            Self::Sampled => None,
            Self::Grid(side) => Some(side * side),
            Self::Adaptive | Self::High | Self::Paper => Some(1),
        }
    }
}
