//! One side of a surface with its values.

use super::table::Sums;
use crate::{measure::ColourReading, scene::Measurand};
use std::sync::Arc;

/// Values of one side, cell by cell; not a number where the surface has no area.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SideMap {
    /// Illuminance, lux.
    pub illuminance: Vec<f32>,
    /// The part of it that came straight from lights, through openings cut out of surfaces at most.
    pub direct: Vec<f32>,
    /// Standard error, lux: as if all arrivals were independent.
    pub standard_error: Vec<f32>,
    /// Red, green and blue parts, whose luminance is the illuminance; empty where none were asked for.
    pub colour: Vec<[f32; 3]>,
    /// What its light's colour is, part by part; empty where that was not asked for.
    pub figures: Vec<PartColour>,
    /// How many divisions of its triangle a value is of; empty for texels.
    pub level: Vec<u8>,
}

impl SideMap {
    /// Room for so many cells.
    pub(super) fn new(cells: usize, colours: bool, levels: bool) -> Self {
        let nothing = || vec![f32::NAN; cells];
        Self {
            illuminance: nothing(),
            direct: nothing(),
            standard_error: nothing(),
            colour: if colours { vec![[f32::NAN; 3]; cells] } else { Vec::new() },
            figures: Vec::new(),
            level: if levels { vec![0; cells] } else { Vec::new() },
        }
    }

    /// Bytes of a cell.
    pub(super) fn memory([colours, figures]: [bool; 2], levels: bool) -> u64 {
        let figures = if figures { size_of::<PartColour>() as u64 } else { 0 };
        12 + if colours { 12 } else { 0 } + figures + u64::from(levels)
    }

    /// Gives cells the value of their sums; `weight` is one over paths and square metres of all of them.
    pub(super) fn set(&mut self, cells: std::ops::Range<usize>, sums: &Sums, weight: f64) {
        self.illuminance[cells.clone()].fill((sums.total() * weight) as f32);
        self.direct[cells.clone()].fill((sums.flux[0] * weight) as f32);
        self.standard_error[cells.clone()].fill((sums.squares.sqrt() * weight) as f32);
        if !self.colour.is_empty() {
            self.colour[cells].fill(sums.colour.map(|flux| (flux * weight) as f32));
        }
    }

    /// The part of the illuminance that surfaces have scattered.
    pub fn indirect(&self) -> impl Iterator<Item = f32> {
        self.illuminance.iter().zip(&self.direct).map(|(all, direct)| all - direct)
    }
}

/// Figures of the colour of a part's light, with their standard errors; not numbers where there are none, since there is no light or it is not white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartColour {
    /// In the order of [`PartColour::FIGURES`].
    pub values: [f32; 6],
    /// As many standard errors.
    pub errors: [f32; 6],
}

impl PartColour {
    /// The figures that there are.
    pub const FIGURES: [Measurand; 6] =
        [Measurand::Cct, Measurand::Duv, Measurand::Ra, Measurand::Rf, Measurand::Rg, Measurand::MelanopicEdi];
    /// Where there are none.
    pub(super) const NONE: Self = Self { values: [f32::NAN; 6], errors: [f32::NAN; 6] };

    /// A figure with its standard error.
    pub fn of(&self, measurand: Measurand) -> [f32; 2] {
        let number = Self::FIGURES.iter().position(|figure| *figure == measurand);
        number.map_or([f32::NAN; 2], |number| [self.values[number], self.errors[number]])
    }
}

/// What a side gets in all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Lumens.
    pub flux: f64,
    /// The part that came straight from lights.
    pub direct: f64,
    /// Square metres.
    pub area: f64,
    /// Standard error of the flux, as if all arrivals were independent; lumens.
    pub standard_error: f64,
    /// Least and greatest illuminance of a cell, lux.
    pub extremes: [f32; 2],
    /// The colour of all its light together, if it was asked for.
    pub colour: Option<Arc<ColourReading>>,
}

impl Summary {
    /// Mean illuminance, lux.
    pub fn mean(&self) -> f64 {
        if self.area > 0.0 { self.flux / self.area } else { 0.0 }
    }
}
