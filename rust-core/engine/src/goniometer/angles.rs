//! C planes and γ angles, and the cells about their directions.

use super::division::{Division, diamond_angle};
use crate::error::{Error, Result};
use std::f64::consts::{PI, TAU};

/// Most directions.
pub const MOST_DIRECTIONS: usize = 4_000_000;
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
        let increasing = self.gamma.windows(2).all(|pair| pair[1] - pair[0] >= LEAST_STEP);
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
/// the last cell reaches as far beyond its direction as on the other side.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    planes: usize,
    gammas: usize,
    /// Cosines of the borders, descending.
    borders: Vec<f64>,
    /// The borders by their cosines' negatives.
    by_gamma: Division,
    /// The borders of the planes by their [`diamond_angle`].
    by_plane: Division,
    /// Whether the first and the last are caps.
    caps: [bool; 2],
}

impl Cells {
    pub(super) fn new(angles: &Angles) -> Self {
        let gamma = &angles.gamma;
        let last = gamma.len() - 1;
        let first = (gamma[0] - 0.5 * (gamma[1] - gamma[0])).max(0.0);
        let end = (gamma[last] + 0.5 * (gamma[last] - gamma[last - 1])).min(180.0);
        let between = gamma.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let borders = std::iter::once(first).chain(between).chain([end]);
        let borders: Vec<f64> = borders.map(|angle| angle.to_radians().cos()).collect();
        let planes = angles.c.len();
        let beyond = (0..planes).map(|plane| sine_cosine((plane as f64 + 0.5) * 360.0 / planes as f64));
        Self {
            planes,
            gammas: gamma.len(),
            by_gamma: Division::new(borders.iter().map(|cosine| -cosine).collect(), [-1.0, 1.0]),
            by_plane: Division::new(beyond.map(|[sin, cos]| diamond_angle(cos, sin)).collect(), [0.0, 4.0]),
            borders,
            caps: [gamma[0] < 1e-9, gamma[last] > 180.0 - 1e-9],
        }
    }

    /// How many there are, those that caps leave empty included.
    pub(super) fn len(&self) -> usize {
        self.planes * self.gammas
    }

    /// The cell that holds a direction of the frame; none outside of the angles.
    #[inline]
    pub(super) fn find(&self, [x, y, z]: [f64; 3]) -> Option<usize> {
        let cosine = (-z / (x * x + y * y + z * z).sqrt()).clamp(-1.0, 1.0);
        let gamma = self.by_gamma.find(-cosine);
        // The very pole of the zenith belongs to the last cell.
        let gamma = if gamma > self.gammas && cosine >= self.borders[self.gammas] { self.gammas } else { gamma };
        let gamma = gamma.checked_sub(1).filter(|gamma| *gamma < self.gammas)?;
        Some(self.index(self.plane(x, y), gamma))
    }

    #[inline]
    fn plane(&self, x: f64, y: f64) -> usize {
        let plane = self.by_plane.find(diamond_angle(x, y));
        if plane == self.planes { 0 } else { plane }
    }

    /// The cell of a direction by its angles' numbers; a cap is the first plane's.
    pub(super) fn index(&self, plane: usize, gamma: usize) -> usize {
        let plane = if self.is_cap(gamma) { 0 } else { plane };
        plane * self.gammas + gamma
    }

    fn is_cap(&self, gamma: usize) -> bool {
        self.caps[0] && gamma == 0 || self.caps[1] && gamma == self.gammas - 1
    }

    /// Solid angle of the cells of a γ, sr.
    pub(super) fn solid_angle(&self, gamma: usize) -> f64 {
        let width = if self.is_cap(gamma) { TAU } else { TAU / self.planes as f64 };
        width * (self.borders[gamma] - self.borders[gamma + 1])
    }

    /// Solid angle of all cells, sr.
    #[cfg(test)]
    fn total(&self) -> f64 {
        (0..self.gammas).map(|gamma| self.solid_angle(gamma) * if self.is_cap(gamma) { 1.0 } else { self.planes as f64 }).sum()
    }
}

/// Unit direction of angles in degrees, in the frame.
pub fn direction_of(c: f64, gamma: f64) -> [f64; 3] {
    let ([sin_c, cos_c], [sin, cos]) = (sine_cosine(c), sine_cosine(gamma));
    [sin * cos_c, sin * sin_c, -cos]
}

fn sine_cosine(degrees: f64) -> [f64; 2] {
    let (sin, cos) = (degrees * PI / 180.0).sin_cos();
    [sin, cos]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_lie_in_their_own_cells_which_fill_the_sphere() {
        for (c_step, gamma_step) in [(15.0, 5.0), (360.0, 10.0), (2.5, 0.5), (90.0, 90.0)] {
            let angles = Angles::regular(c_step, gamma_step).expect("steps that fit");
            let cells = Cells::new(&angles);
            for (plane, c) in angles.c.iter().enumerate() {
                for (g, gamma) in angles.gamma.iter().enumerate() {
                    assert_eq!(cells.find(direction_of(*c, *gamma)), Some(cells.index(plane, g)), "{c} {gamma}");
                }
            }
            assert!((cells.total() - 4.0 * PI).abs() < 1e-9);
        }
    }

    #[test]
    fn a_part_of_the_sphere_has_no_cells_elsewhere() {
        let angles = Angles { c: vec![0.0, 180.0], gamma: vec![0.0, 40.0, 60.0] }.checked().expect("fine");
        let cells = Cells::new(&angles);
        let find = |gamma| cells.find(direction_of(20.0, gamma));
        assert_eq!(
            [find(0.0), find(19.0), find(21.0), find(69.0), find(71.0), find(180.0)],
            [Some(0), Some(0), Some(1), Some(2), None, None]
        );
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
