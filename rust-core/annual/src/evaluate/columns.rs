//! A chunk's columns of the sky.

use super::{Group, shape::Shape};
use crate::{division::Division, sky::SkyMatrix, sun::SUN_ANGLE_DEG};
use std::f64::consts::PI;

/// The skies that columns are taken from.
pub(super) struct Skies<'a> {
    pub(super) all: &'a SkyMatrix<'a>,
    pub(super) alone: &'a SkyMatrix<'a>,
    pub(super) suns: &'a [Option<usize>],
}

/// A chunk's columns of the sky.
pub(super) struct Columns {
    /// Sky and sun.
    pub(super) all: Vec<f32>,
    /// The sun in the patches.
    pub(super) alone: Vec<f32>,
    /// The sky without the sun.
    pub(super) sky: Vec<f32>,
    /// Column and luminance in cd/m² of each step's sun.
    pub(super) suns: Vec<Option<(usize, f32)>>,
}

impl Columns {
    pub(super) fn new(skies: &Skies<'_>, groups: &[Group], shape: &Shape, steps: &[usize], threads: usize) -> Self {
        let patches = Division::count(shape.factor);
        let needs_alone =
            groups.iter().any(|group| group.sun.is_some() || group.direct.as_ref().is_some_and(|direct| direct.columns == patches));
        let all = skies.all.columns(steps, threads);
        let alone = if needs_alone { skies.alone.columns(steps, threads) } else { Vec::new() };
        let sky = if groups.iter().any(|group| group.sun.is_some()) {
            all.iter().zip(&alone).map(|(all, sun)| (all - sun).max(0.0)).collect()
        } else {
            Vec::new()
        };
        let disc = PI * (0.5 * SUN_ANGLE_DEG).to_radians().powi(2);
        let sun = |step: &usize| Some((skies.suns[*step]?, (skies.all.conditions(*step)?.direct_normal / disc) as f32));
        Self { all, alone, sky, suns: steps.iter().map(sun).collect() }
    }
}
