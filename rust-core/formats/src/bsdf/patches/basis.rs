//! Bases of directions made of patches: rings about the normal, each cut into equal azimuths.

use core::f64::consts::{PI, TAU};

use super::super::direction::{Direction, azimuth, elevation};
use crate::error::{FormatError, Result};

/// Rings of patches, numbered from the normal outwards and from azimuth 0 counter-clockwise. Patch 0 of a ring is centred at azimuth 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Its name, as files refer to it.
    pub name: String,
    /// Borders of the rings, radians: one more than rings, from 0 to π/2.
    pub borders: Vec<f64>,
    /// Patches in each ring.
    pub counts: Vec<u32>,
    /// Each ring's first patch, and the number of all patches.
    pub starts: Vec<u32>,
}

/// Names, borders in degrees and counts of the bases that files may name without defining them (LBNL WINDOW technical documentation;
/// Klems, A New Method for Predicting the Solar Heat Gain of Complex Fenestration Systems, 1994).
const KNOWN: [(&str, &[f64], &[u32]); 3] = [
    ("LBNL/Klems Full", &[0.0, 5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 90.0], &[1, 8, 16, 20, 24, 24, 24, 16, 12]),
    ("LBNL/Klems Half", &[0.0, 6.5, 19.5, 32.5, 46.5, 61.5, 76.5, 90.0], &[1, 8, 12, 16, 20, 12, 4]),
    ("LBNL/Klems Quarter", &[0.0, 9.0, 27.0, 46.0, 66.0, 90.0], &[1, 8, 12, 12, 8]),
];

/// More patches than that would make a matrix of more than four thousand million values.
const MOST_PATCHES: u64 = 1 << 16;

impl Basis {
    /// Rings with borders in degrees.
    ///
    /// # Errors
    /// When there is not one more border than counts, borders do not increase from 0 to 90 degrees, a count is zero or all are too many.
    pub fn new(name: &str, borders_deg: &[f64], counts: &[u32]) -> Result<Self> {
        let fail = |problem: String| Err(FormatError::whole(format!("angle basis \"{name}\": {problem}")));
        if counts.is_empty() || borders_deg.len() != counts.len() + 1 {
            return fail(format!("{} borders and {} rings, expected one border more than rings", borders_deg.len(), counts.len()));
        }
        let increasing = borders_deg.windows(2).all(|w| w[0] < w[1]);
        if !increasing || borders_deg[0].abs() > 1e-6 || (borders_deg[counts.len()] - 90.0).abs() > 1e-6 {
            return fail(format!("borders {borders_deg:?}, expected increasing ones from 0 to 90 degrees"));
        }
        let total: u64 = counts.iter().map(|&n| u64::from(n)).sum();
        if counts.contains(&0) || total > MOST_PATCHES {
            return fail(format!("{total} patches in rings of {counts:?}, expected one or more in each and {MOST_PATCHES} at most"));
        }
        let starts = core::iter::once(0).chain(counts.iter().scan(0, |sum, &n| {
            *sum += n;
            Some(*sum)
        }));
        let borders = borders_deg.iter().map(|d| d.clamp(0.0, 90.0).to_radians()).collect();
        Ok(Self { name: name.into(), borders, counts: counts.to_vec(), starts: starts.collect() })
    }

    /// A basis that files may name without defining it: LBNL/Klems Full, Half and Quarter, in any case.
    pub fn known(name: &str) -> Option<Self> {
        let &(name, borders, counts) = KNOWN.iter().find(|known| known.0.eq_ignore_ascii_case(name))?;
        Self::new(name, borders, counts).ok()
    }

    /// How many patches there are.
    pub fn count(&self) -> usize {
        self.starts[self.counts.len()] as usize
    }

    /// The ring of a patch.
    fn ring(&self, patch: usize) -> usize {
        self.starts.partition_point(|&start| start as usize <= patch) - 1
    }

    /// The patch that a direction at the front lies in.
    pub fn patch(&self, d: Direction) -> usize {
        let theta = elevation(d);
        let ring = self.borders.partition_point(|&border| border <= theta).clamp(1, self.counts.len()) - 1;
        let count = self.counts[ring];
        let step = (azimuth(d) / TAU * f64::from(count)).round().rem_euclid(f64::from(count)) as u32;
        (self.starts[ring] + step.min(count - 1)) as usize
    }

    /// A patch's projected solid angle: `π (sin² θ₁ − sin² θ₀) / n`.
    pub fn projected_solid_angle(&self, patch: usize) -> f64 {
        let ring = self.ring(patch);
        let [low, high] = [ring, ring + 1].map(|r| self.borders[r].sin().powi(2));
        PI * (high - low) / f64::from(self.counts[ring])
    }

    /// A direction of a patch, uniform in projected solid angle.
    pub fn direction(&self, patch: usize, u: [f64; 2]) -> Direction {
        let ring = self.ring(patch);
        let [low, high] = [ring, ring + 1].map(|r| self.borders[r].sin().powi(2));
        let squared = low + u[0] * (high - low);
        let phi = TAU * ((patch as u32 - self.starts[ring]) as f64 + u[1] - 0.5) / f64::from(self.counts[ring]);
        let sine = squared.sqrt();
        [sine * phi.cos(), sine * phi.sin(), (1.0 - squared).max(0.0).sqrt()]
    }
}
