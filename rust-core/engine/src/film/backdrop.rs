//! What covers a pixel besides surfaces, for pictures whose colour is not multiplied by coverage: a sky that is seen covers, and holdouts pierce it.

use crate::scene::{Background, LightShape, Model, Scene};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a film keeps besides the passes that were asked for, as the scene wants it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Besides {
    /// Whether there are shadow catchers.
    pub(crate) catchers: bool,
    /// Whether there are holdouts.
    #[serde(default)]
    pub(crate) holdouts: bool,
    /// Whether the camera sees a sky where it sees no surface.
    #[serde(default)]
    pub(crate) sky: bool,
}

impl Besides {
    /// What a scene wants.
    pub(crate) fn of(scene: &Scene) -> Self {
        let closures = || scene.materials.iter().flat_map(|material| &material.closures);
        Self {
            catchers: scene.instances.iter().any(|set| set.shadow_catcher),
            holdouts: scene.instances.iter().any(|set| set.holdout) || closures().any(|closure| closure.model == Model::Holdout),
            sky: scene.lights.iter().any(|light| matches!(light.shape, LightShape::Dome { .. }) && light.visibility.camera),
        }
    }

    /// The same under settings, which say whether the sky is shown, and whether it counts as covering by itself.
    pub(crate) fn shown(self, background: Background) -> Self {
        Self { sky: self.sky && background == Background::Seen, ..self }
    }
}

/// What is seen where no surface is.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Backdrop {
    /// Nothing that the coverage of the colour pass leaves out.
    #[default]
    Open,
    /// A sky, but for the share of each pixel that holdouts have, rows from the top; empty where there are none.
    Sky(Arc<[f32]>),
}

impl Backdrop {
    /// How much of a pixel is covered, sky and all, given what surfaces cover of it.
    pub fn coverage(&self, pixel: usize, by_surfaces: f32) -> f32 {
        match self {
            Self::Open => by_surfaces,
            Self::Sky(holes) => 1.0 - holes.get(pixel).copied().unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sky_covers_all_but_holes() {
        assert_eq!(Backdrop::Open.coverage(0, 0.25), 0.25);
        assert_eq!(Backdrop::Sky(Arc::default()).coverage(7, 0.25), 1.0);
        assert_eq!(Backdrop::Sky([0.0, 0.75].into()).coverage(1, 0.25), 0.25);
    }
}
