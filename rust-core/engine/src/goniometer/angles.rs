//! C planes and γ angles, and the cells about their directions.

use super::division::{Division, diamond_angle};
use crate::error::{Error, Result};
use gonio_simd::{Lanes, One, U, Vec3};
use std::f64::consts::{PI, TAU};

/// Most directions.
pub const MOST_DIRECTIONS: usize = 4_000_000;
/// γ of what is level.
const HORIZON: f64 = 90.0;
/// Sines of elevations that are level: rays' directions come with rounding.
pub(super) const LEVEL: f32 = 1e-6;
/// The least step, degrees: rays' directions are in single precision.
const LEAST_STEP: f64 = 0.01;

/// Directions at which intensities are wanted, degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Angles {
    /// C planes: even steps from 0 on, without 360.
    pub c: Vec<f64>,
    /// γ, increasing within 0 to 180.
    pub gamma: Vec<f64>,
}

impl Angles {
    /// A turn of C planes and γ from 0 to 180, in steps of degrees; γ's last step ends at 180.
    ///
    /// # Errors
    /// Steps of C that do not divide 360, steps of γ that do not divide 180, and more than [`MOST_DIRECTIONS`].
    pub fn regular(c_step: f64, gamma_step: f64) -> Result<Self> {
        let steps = |name: &str, step: f64, whole: f64| {
            let count = (whole / step).round();
            let fits = step >= LEAST_STEP && step <= whole && (count * step - whole).abs() < 1e-6 * whole;
            let problem = || format!("{step} was found, expected degrees from {LEAST_STEP} on that divide {whole}");
            fits.then_some(count as usize).ok_or_else(|| Error::setting(name, problem()))
        };
        let [planes, gammas] = [steps("c-step", c_step, 360.0)?, steps("g-step", gamma_step, 180.0)?];
        let even = |count: usize, whole: f64, of: usize| (0..count).map(|i| whole * i as f64 / of as f64).collect();
        Self { c: even(planes, 360.0, planes), gamma: even(gammas + 1, 180.0, gammas) }.checked()
    }

    /// These angles if they can be measured at.
    ///
    /// # Errors
    /// C planes in other than even steps of a turn from 0, γ that do not increase within 0 to 180, fewer than two of them, and more than
    /// [`MOST_DIRECTIONS`].
    pub fn checked(mut self) -> Result<Self> {
        if self.c.len() > 1 && self.c.last().is_some_and(|last| (last - 360.0).abs() < 1e-6) {
            self.c.pop();
        }
        let step = 360.0 / self.c.len().max(1) as f64;
        let even = self.c.iter().enumerate().all(|(i, c)| (c - step * i as f64).abs() < 1e-4);
        if self.c.is_empty() || !even {
            return Err(Error::setting("angles", "C planes are expected in even steps of a whole turn, the first at 0"));
        }
        let inside = self.gamma.iter().all(|gamma| (0.0..=180.0).contains(gamma));
        // Steps of decimals are not met to the last bit.
        let increasing = self.gamma.windows(2).all(|pair| pair[1] - pair[0] >= LEAST_STEP - 1e-9);
        if self.gamma.len() < 2 || !inside || !increasing {
            let problem = format!("two or more γ are expected that increase within 0 to 180 by {LEAST_STEP} or more");
            return Err(Error::setting("angles", problem));
        }
        let count = self.c.len().saturating_mul(self.gamma.len());
        if count > MOST_DIRECTIONS {
            return Err(Error::setting("angles", format!("{count} directions were asked for, expected {MOST_DIRECTIONS} at most")));
        }
        Ok(self)
    }
}

/// Cells about the directions: their borders lie half way between them, and at γ = 0 and 180 all planes share a cap. Where γ ends before it,
/// the last cell reaches as far beyond its direction as on the other side. The cells of γ = 90 have two halves, one below the horizon and one above:
/// luminaires that send nothing up have a jump there, or a bend.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    planes: usize,
    gammas: usize,
    /// Cells of a plane: one a γ, and two of the horizon.
    rows: usize,
    /// The number of γ = 90.
    horizon: Option<usize>,
    /// Cosines of the borders, descending.
    borders: Vec<f64>,
    /// The borders of γ and of the planes by their [`diamond_angle`]: exact at the poles, as cosines are not in single precision.
    by_gamma: Division,
    by_plane: Division,
    /// Whether the first and the last are caps.
    caps: [bool; 2],
}

/// A cell's number, and its solid angle in sr.
pub(super) type Cell = (usize, f64);

/// No cell.
pub(super) const OUTSIDE: u32 = u32::MAX;

impl Cells {
    pub(super) fn new(angles: &Angles) -> Self {
        let gamma = &angles.gamma;
        let last = gamma.len() - 1;
        let first = (gamma[0] - 0.5 * (gamma[1] - gamma[0])).max(0.0);
        let end = (gamma[last] + 0.5 * (gamma[last] - gamma[last - 1])).min(180.0);
        let between = gamma.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let mut borders: Vec<f64> = std::iter::once(first).chain(between).chain([end]).collect();
        let horizon = gamma.iter().position(|gamma| (gamma - HORIZON).abs() < 1e-9);
        if let Some(horizon) = horizon {
            borders.insert(horizon + 1, HORIZON);
        }
        let planes = angles.c.len();
        let beyond = (0..planes).map(|plane| (plane as f64 + 0.5) * 360.0 / planes as f64);
        // The very pole of the zenith belongs to the last cell.
        let before_end = borders.iter().map(|angle| match *angle {
            180.0 => f32::MAX,
            // Level light goes down, also with what rounding makes of it.
            HORIZON => 1.0 + LEVEL,
            angle => diamond_of(angle),
        });
        Self {
            planes,
            gammas: gamma.len(),
            rows: borders.len() - 1,
            horizon,
            by_gamma: Division::new(before_end.collect(), [0.0, 2.0]),
            by_plane: Division::new(beyond.map(diamond_of).collect(), [0.0, 4.0]),
            borders: borders.iter().map(|angle| angle.to_radians().cos()).collect(),
            caps: [gamma[0] < 1e-9, gamma[last] > 180.0 - 1e-9],
        }
    }

    /// How many there are, those that caps leave empty included.
    pub(super) fn len(&self) -> usize {
        self.planes * self.rows
    }

    /// The cells that hold directions of the frame, of any length; [`OUTSIDE`] of the angles.
    #[inline(always)]
    pub(super) fn find<L: Lanes>(&self, direction: Vec3<L>) -> U<L> {
        let Vec3 { x, y, z } = direction;
        let l = x.lanes();
        let not_below = self.by_gamma.find(diamond_angle(-z, x.mul_add(x, y * y).sqrt()));
        let rows = self.rows as u32;
        let inside = not_below.ne(0) & not_below.lt(rows + 1);
        let row = not_below - 1;
        let plane = self.by_plane.find(diamond_angle(x, y));
        let cap = (row.eq(0) & l.m(self.caps[0])) | (row.eq(rows - 1) & l.m(self.caps[1]));
        let plane = plane.keep_if(plane.lt(self.planes as u32).and_not(cap));
        inside.select(plane * rows + row, l.u(OUTSIDE))
    }

    /// The cells of a direction by its angles' numbers with their solid angles in sr: one, or the two about the horizon, the lower one first. A cap is
    /// the first plane's.
    pub(super) fn of(&self, plane: usize, gamma: usize) -> (Cell, Option<Cell>) {
        let plane = if self.is_cap(gamma) { 0 } else { plane };
        let width = if self.is_cap(gamma) { TAU } else { TAU / self.planes as f64 };
        let cell = |row: usize| (plane * self.rows + row, width * (self.borders[row] - self.borders[row + 1]));
        let first = gamma + usize::from(self.horizon.is_some_and(|horizon| gamma > horizon));
        (cell(first), (self.horizon == Some(gamma)).then(|| cell(first + 1)))
    }

    fn is_cap(&self, gamma: usize) -> bool {
        self.caps[0] && gamma == 0 || self.caps[1] && gamma == self.gammas - 1
    }

    /// Solid angle of all cells, sr.
    #[cfg(test)]
    fn total(&self) -> f64 {
        let of = |gamma: usize| {
            let (cell, above) = self.of(0, gamma);
            (cell.1 + above.map_or(0.0, |cell| cell.1)) * if self.is_cap(gamma) { 1.0 } else { self.planes as f64 }
        };
        (0..self.gammas).map(of).sum()
    }
}

/// Unit direction of angles in degrees, in the frame.
pub fn direction_of(c: f64, gamma: f64) -> [f64; 3] {
    let ([sin_c, cos_c], [sin, cos]) = (sine_cosine(c), sine_cosine(gamma));
    [sin * cos_c, sin * sin_c, -cos]
}

/// The [`diamond_angle`] of degrees.
fn diamond_of(degrees: f64) -> f32 {
    let [sin, cos] = sine_cosine(degrees);
    diamond_angle(One.f(cos as f32), One.f(sin as f32)).to_array()[0]
}

fn sine_cosine(degrees: f64) -> [f64; 2] {
    let (sin, cos) = (degrees * PI / 180.0).sin_cos();
    [sin, cos]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(cells: &Cells, c: f64, gamma: f64) -> u32 {
        let [x, y, z] = direction_of(c, gamma).map(|x| One.f(x as f32));
        cells.find(Vec3::new(x, y, z)).to_array()[0]
    }

    #[test]
    fn directions_lie_in_their_own_cells_which_fill_the_sphere() {
        for (c_step, gamma_step) in [(15.0, 5.0), (360.0, 10.0), (2.5, 0.5), (90.0, 90.0)] {
            let angles = Angles::regular(c_step, gamma_step).expect("steps that fit");
            let cells = Cells::new(&angles);
            for (plane, c) in angles.c.iter().enumerate() {
                for (g, gamma) in angles.gamma.iter().enumerate() {
                    assert_eq!(find(&cells, *c, *gamma), cells.of(plane, g).0.0 as u32, "{c} {gamma}");
                }
            }
            assert!((cells.total() - 4.0 * PI).abs() < 1e-9);
        }
    }

    #[test]
    fn borders_are_exact_at_both_poles() {
        let cells = Cells::new(&Angles::regular(90.0, 0.01).expect("steps that fit"));
        let gammas = 18_000;
        for near in [0.0049, 0.0051, 0.0149, 0.0151, 12.3449, 12.3451] {
            let number = (near * 100.0_f64).round() as u32;
            // Above the horizon cells are one farther.
            assert_eq!([find(&cells, 0.0, near), find(&cells, 0.0, 180.0 - near)], [number, gammas + 1 - number], "{near}");
        }
    }

    #[test]
    fn the_horizon_has_two_halves() {
        let cells = Cells::new(&Angles::regular(90.0, 5.0).expect("steps that fit"));
        let ((below, angle), Some((above, other))) = cells.of(1, 18) else { panic!("γ = 90 is the horizon") };
        assert!((angle - other).abs() < 1e-12);
        for (gamma, cell) in [(87.6, below), (89.99, below), (90.0, below), (90.01, above), (92.4, above)] {
            assert_eq!(find(&cells, 90.0, gamma), cell as u32, "{gamma}");
        }
        assert_eq!([cells.of(1, 17).1, cells.of(1, 19).1], [None, None]);
        assert_eq!(find(&cells, 90.0, 92.6), cells.of(1, 19).0.0 as u32);
        // Without an angle there nothing is divided.
        let other = Cells::new(&Angles { c: vec![0.0], gamma: vec![0.0, 85.0, 95.0, 180.0] }.checked().expect("fine"));
        assert_eq!(find(&other, 0.0, 89.0), 1);
    }

    #[test]
    fn a_part_of_the_sphere_has_no_cells_elsewhere() {
        let angles = Angles { c: vec![0.0, 180.0], gamma: vec![0.0, 40.0, 60.0] }.checked().expect("fine");
        let cells = Cells::new(&angles);
        let find = |gamma| find(&cells, 20.0, gamma);
        assert_eq!([find(0.0), find(19.0), find(21.0), find(69.0), find(71.0), find(180.0)], [0, 0, 1, 2, OUTSIDE, OUTSIDE]);
    }

    #[test]
    fn angles_that_make_no_sense_are_refused() {
        for (c, gamma) in [(7.0, 5.0), (15.0, 7.0), (0.0, 5.0), (15.0, f64::NAN), (-15.0, 5.0), (0.05, 0.05)] {
            assert!(Angles::regular(c, gamma).is_err(), "{c} {gamma}");
        }
        for (c, gamma) in [(vec![], vec![0.0, 1.0]), (vec![0.0, 90.0], vec![0.0, 1.0]), (vec![0.0], vec![1.0, 0.0]), (vec![0.0], vec![0.0])]
        {
            assert!(Angles { c, gamma }.checked().is_err());
        }
        let closed = Angles { c: vec![0.0, 180.0, 360.0], gamma: vec![0.0, 180.0] };
        assert_eq!(closed.checked().expect("closed").c, [0.0, 180.0]);
    }
}
