//! A chunk's columns of the sky.

use super::shape::Shape;
use crate::{
    division::Division,
    group::{Blinds, Group},
    sky::SkyMatrix,
    sun::SUN_ANGLE_DEG,
};
use std::f64::consts::PI;

/// The skies that columns are taken from.
pub(super) struct Skies<'a> {
    pub(super) all: &'a SkyMatrix<'a>,
    pub(super) alone: &'a SkyMatrix<'a>,
    pub(super) sky: &'a SkyMatrix<'a>,
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
    /// The steps.
    pub(super) steps: Vec<usize>,
}

impl Columns {
    pub(super) fn new(skies: &Skies<'_>, groups: &[Group], shape: &Shape, steps: &[usize], threads: usize) -> Self {
        let patches = Division::count(shape.factor);
        let is_direct = |group: &Group| group.direct.as_ref().is_some_and(|direct| direct.columns == patches);
        let is_traced = |group: &Group| group.scattered.is_some() || matches!(group.blinds, Some(Blinds::Traced { .. }));
        let is_in_patches = groups.iter().any(|group| is_direct(group) || is_traced(group));
        let is_apart = groups.iter().any(|group| group.sun.is_some() || is_traced(group));
        let columns = |of: &SkyMatrix<'_>, is_needed: bool| if is_needed { of.columns(steps, threads) } else { Vec::new() };
        let [all, alone, sky] =
            [(skies.all, true), (skies.alone, is_in_patches), (skies.sky, is_apart)].map(|(of, needed)| columns(of, needed));
        let disc = PI * (0.5 * SUN_ANGLE_DEG).to_radians().powi(2);
        let sun = |step: &usize| Some((skies.suns[*step]?, (skies.all.conditions(*step)?.direct_normal / disc) as f32));
        Self { all, alone, sky, suns: steps.iter().map(sun).collect(), steps: steps.to_vec() }
    }
}
