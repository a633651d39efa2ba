//! Intensities against what else a file says of them.

use super::Goniogram;
use super::text::number;
use crate::error::{FormatError, Result};

/// Relative difference that files may have by rounding.
pub(crate) const TOLERANCE: f64 = 0.02;

/// Negative intensities below this share of the peak are stray light of the measurement.
const STRAY: f64 = 0.01;

/// The least of the intensities read so far, and where it stands.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Least {
    value: f64,
    line: u64,
}

impl Least {
    pub(crate) fn see(&mut self, value: f64, line: u64) {
        if value < self.value {
            *self = Self { value, line };
        }
    }

    /// Makes small negative intensities 0.
    ///
    /// # Errors
    /// Negative intensities of more than 1 % of the greatest.
    pub(crate) fn repair(self, intensities: &mut [f64], warnings: &mut Vec<FormatError>) -> Result<()> {
        if self.value >= 0.0 {
            return Ok(());
        }
        let peak = intensities.iter().copied().fold(0.0, f64::max);
        let found = format!("a negative intensity, {}, was found", number(self.value));
        if -self.value > STRAY * peak {
            return Err(FormatError::line(self.line, format!("{found}, expected 0 or more")));
        }
        intensities.iter_mut().for_each(|intensity| *intensity = intensity.max(0.0));
        warnings.push(FormatError::line(self.line, format!("{found}: negative ones count as 0")));
        Ok(())
    }
}

impl Goniogram {
    /// Warns where the intensities' flux differs by more than 2 % from what the file states.
    pub(crate) fn check(&mut self) {
        let (flux, below) = (self.flux(), self.flux_below());
        if flux <= 0.0 {
            self.warnings.push(FormatError::whole("all intensities are 0"));
            return;
        }
        let Some(lamps) = self.lamps() else { return };
        let mut found = Vec::new();
        match (lamps.flux, self.stated.light_output_ratio) {
            (Some(lamp_flux), Some(ratio)) if (flux / (lamp_flux * ratio) - 1.0).abs() > TOLERANCE => found.push(format!(
                "the intensities' flux is {flux:.1} lm, but {:.4} % of {} lm is stated: {:+.1} %",
                ratio * 100.0,
                number(lamp_flux),
                (flux / (lamp_flux * ratio) - 1.0) * 100.0
            )),
            (Some(lamp_flux), None) if flux > lamp_flux * (1.0 + TOLERANCE) => {
                found.push(format!("the intensities' flux is {flux:.1} lm, more than the lamps' {} lm", number(lamp_flux)));
            }
            _ => {}
        }
        if let Some(stated) = self.stated.downward_fraction.filter(|stated| (below / flux - stated).abs() > TOLERANCE) {
            found.push(format!("{:.1} % of the flux goes down, but {:.1} % is stated", below / flux * 100.0, stated * 100.0));
        }
        self.warnings.extend(found.into_iter().map(FormatError::whole));
    }
}
