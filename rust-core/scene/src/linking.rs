//! Light linking: which instances a light lights, and which cast its shadows.

use serde::{Deserialize, Serialize};

/// Some of the scene's instance sets, as numbers of [`super::Scene::instances`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Link {
    /// All of them.
    #[default]
    All,
    /// These alone.
    Only(Vec<u32>),
    /// All but these.
    Except(Vec<u32>),
}

impl Link {
    /// Whether an instance set is among them.
    pub fn has(&self, set: u32) -> bool {
        match self {
            Self::All => true,
            Self::Only(sets) => sets.contains(&set),
            Self::Except(sets) => !sets.contains(&set),
        }
    }
}

/// What a light is linked to.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Linking {
    /// What it lights.
    pub receivers: Link,
    /// What casts its shadows.
    pub blockers: Link,
}

impl Linking {
    /// Whether it lights all, and all casts its shadows.
    pub fn is_whole(&self) -> bool {
        self.receivers == Link::All && self.blockers == Link::All
    }
}
