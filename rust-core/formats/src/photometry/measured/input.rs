//! The measurement as the instrument gives it.

use crate::error::{FormatError, Result};
use crate::photometry::Opening;
use crate::photometry::grid::SAME;
use crate::photometry::text::LARGEST;

/// Texts for the head of a file; empty where there is none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeasurementHead {
    /// The luminaire's name.
    pub name: String,
    /// Who makes it.
    pub manufacturer: String,
    /// Its number in a catalogue.
    pub catalogue_number: String,
    /// What the measurement is called.
    pub report: String,
    /// The day of the measurement, such as 2025-03-31.
    pub date: String,
}

/// Intensities of a luminaire on all C planes, with their standard errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurement {
    /// C planes in degrees: even steps from 0; a plane at 360 is the one at 0, and left out.
    pub planes: Vec<f64>,
    /// γ in degrees, increasing within 0 to 180.
    pub gammas: Vec<f64>,
    /// Intensities in cd: `intensities[c * gammas.len() + gamma]`.
    pub intensities: Vec<f64>,
    /// Their standard errors in cd, in the same order.
    pub errors: Vec<f64>,
    /// Luminous flux in lm that the sources emit.
    pub source_flux: f64,
    /// Luminous flux in lm that left the luminaire, counted without regard to angles.
    pub flux: f64,
    /// Standard error in lm of the flux that left.
    pub flux_error: f64,
    /// Of the flux that left, what goes above the horizontal plane, and its standard error, in lm; `None` where it was not counted apart.
    pub flux_up: Option<[f64; 2]>,
    /// The luminous opening.
    pub opening: Opening,
    /// The whole luminaire's extents in metres along C0–C180, C90–C270 and upwards; `None` where they are not known.
    pub body: Option<[f64; 3]>,
    /// Connected power in W, if known.
    pub watts: Option<f64>,
    /// Correlated colour temperature in K, if known.
    pub colour_temperature: Option<f64>,
    /// Texts.
    pub head: MeasurementHead,
}

impl Measurement {
    /// The degrees between planes.
    pub(super) fn step(&self) -> f64 {
        360.0 / self.planes.len().max(1) as f64
    }

    /// The intensity and its variance.
    pub(super) fn at(&self, plane: usize, gamma: usize) -> [f64; 2] {
        let index = plane * self.gammas.len() + gamma;
        [self.intensities[index], self.errors[index].powi(2)]
    }

    /// Whether all planes are one direction at that γ.
    pub(super) fn is_pole(&self, gamma: usize) -> bool {
        [0.0, 180.0].iter().any(|pole| (self.gammas[gamma] - pole).abs() < SAME)
    }

    /// The measurement with its planes from 0 on and without one at 360, after a look at all that can be wrong with it.
    ///
    /// # Errors
    /// Counts that do not fit, angles that are none or in no order, numbers that are negative or not finite, and a luminaire that sends out
    /// more than its sources do.
    pub(super) fn checked(&self) -> Result<Self> {
        let (planes, gammas) = (self.planes.len(), self.gammas.len());
        let fail = |problem: String| Err(FormatError::whole(problem));
        for (name, values) in [("intensities", &self.intensities), ("standard errors", &self.errors)] {
            if planes.checked_mul(gammas) != Some(values.len()) {
                return fail(format!("{} {name} were given for {planes} C planes of {gammas} angles", values.len()));
            }
            if let Some(bad) = values.iter().find(|value| !(0.0..=LARGEST).contains(*value)) {
                return fail(format!("{bad} cd was found among the {name}, expected 0 to {LARGEST:e}"));
            }
        }
        for (name, flux) in [("the sources'", self.source_flux), ("the luminaire's", self.flux), ("the error of the", self.flux_error)] {
            if !(0.0..=LARGEST).contains(&flux) {
                return fail(format!("{name} flux is {flux} lm, expected 0 to {LARGEST:e}"));
            }
        }
        // Four standard errors: what noise alone never does.
        if self.source_flux > 0.0 && self.flux > self.source_flux * (1.0 + 1e-6) + 4.0 * self.flux_error {
            return fail(format!("{} lm left the luminaire, but its sources emit {} lm", self.flux, self.source_flux));
        }
        if let Some(bad) = self
            .opening
            .size
            .iter()
            .chain(&self.opening.heights)
            .chain(self.body.iter().flatten())
            .find(|extent| !(0.0..=1e4).contains(*extent))
        {
            return fail(format!("an extent is {bad} m, expected 0 to 10000"));
        }
        let mut whole = self.clone();
        if planes > 1 && (self.planes[planes - 1] - 360.0).abs() < SAME {
            whole.planes.pop();
            whole.intensities.truncate((planes - 1) * gammas);
            whole.errors.truncate((planes - 1) * gammas);
        }
        whole.check_angles()?;
        Ok(whole)
    }

    fn check_angles(&self) -> Result<()> {
        let step = self.step();
        let uneven = self.planes.iter().enumerate().find(|(index, c)| (**c - *index as f64 * step).abs() >= SAME || !c.is_finite());
        if let Some((index, c)) = uneven {
            let expected = index as f64 * step;
            return Err(FormatError::whole(format!("C plane {} of {} is {c}, expected {expected}", index + 1, self.planes.len())));
        }
        let inside = self.gammas.iter().all(|gamma| (0.0..=180.0).contains(gamma));
        if self.planes.is_empty() || self.gammas.len() < 2 || !inside || !self.gammas.windows(2).all(|pair| pair[1] - pair[0] > SAME) {
            return Err(FormatError::whole("expected a C plane or more and two or more γ that increase within 0 to 180 degrees"));
        }
        Ok(())
    }
}
