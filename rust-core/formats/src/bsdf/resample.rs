//! Any measurement as tables over angles of light and view.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::axis::{Axis, Mode};
use super::coordinates::Coordinates;
use super::direction::through;
use super::hemispheres::Hemispheres;
use super::measured::Measured;
use super::table::{Layout, Table};
use crate::error::{FormatError, Result};

/// On what angles a measurement is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Polar angles of light and of view, from 0° to 90°.
    pub theta: usize,
    /// Azimuths of a full turn.
    pub phi: usize,
    /// Whether light's azimuth is left out: for isotropic materials.
    pub isotropic: bool,
}

/// The usual angles: polar ones and azimuths, as all four of an anisotropic material multiply.
const ISOTROPIC: [usize; 2] = [46, 72];
const ANISOTROPIC: [usize; 2] = [19, 36];

/// More numbers than that do not go into a table: one gigabyte of them.
const MOST_VALUES: u128 = 1 << 28;

impl Grid {
    /// The grid of a material, with the usual angles where none are given.
    pub fn new(measured: &Measured, theta: Option<usize>, phi: Option<usize>) -> Self {
        let isotropic = measured.is_isotropic();
        let usual = if isotropic { ISOTROPIC } else { ANISOTROPIC };
        Self { theta: theta.unwrap_or(usual[0]), phi: phi.unwrap_or(usual[1]), isotropic }
    }

    /// Numbers of a table with so many channels.
    fn values(self, channels: usize) -> u128 {
        (self.theta as u128).pow(2) * (self.phi as u128).pow(if self.isotropic { 1 } else { 2 }) * channels as u128
    }
}

/// Instead of 90°, where nothing arrives and a BSDF is not defined by what is reflected: 89.9°.
const LAST_THETA: f64 = FRAC_PI_2 * 0.999;

impl Measured {
    /// The BSDF at the knots of a grid, a table for each pair of hemispheres that there is.
    ///
    /// # Errors
    /// When the grid has no angles, or makes a table of more than a gigabyte.
    pub fn resampled(&self, grid: Grid) -> Result<Vec<Table>> {
        let pairs = Hemispheres::ALL.into_iter().filter(|pair| self.has(*pair));
        pairs.map(|pair| self.resampled_side(grid, pair)).collect()
    }

    fn resampled_side(&self, grid: Grid, hemispheres: Hemispheres) -> Result<Table> {
        if grid.theta < 2 || grid.phi < 1 {
            return Err(FormatError::whole("a grid needs at least two polar angles and one azimuth"));
        }
        let values = grid.values(self.channels().count());
        if values > MOST_VALUES {
            let Grid { theta, phi, .. } = grid;
            return Err(FormatError::whole(format!("{theta} × {phi} angles make {values} numbers a side, expected {MOST_VALUES} at most")));
        }
        let step = FRAC_PI_2 / (grid.theta - 1) as f64;
        let theta = Axis::new((0..grid.theta).map(|i| (step * i as f64).min(LAST_THETA)).collect(), Mode::Linear)?;
        let turn = TAU / grid.phi as f64;
        let phi = Axis::uniform(0.0, turn * (grid.phi - 1) as f64, grid.phi, Mode::Periodic { period: TAU })?;
        let (coordinates, axes) = if grid.isotropic {
            (Coordinates::Isotropic, vec![theta.clone(), theta, phi])
        } else {
            (Coordinates::Anisotropic, vec![theta.clone(), phi.clone(), theta, phi])
        };
        let layout = Layout { coordinates, axes, channels: self.channels().clone(), hemispheres, reciprocal: false, bilateral: false };
        let count = layout.channels.count();
        let is_up = hemispheres.is_from_front() == hemispheres.is_reflection();
        Table::from_function(layout, |wi, wo, out| {
            let mut values = vec![0.0; count];
            let wi = if hemispheres.is_from_front() { wi } else { through(wi) };
            self.eval(wi, if is_up { wo } else { through(wo) }, &mut values);
            out.iter_mut().zip(&values).for_each(|(out, v)| *out = (v / wi[2].abs()).max(0.0) as f32);
        })
    }
}
