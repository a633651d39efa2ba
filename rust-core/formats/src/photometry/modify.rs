//! Other lamps, another flux, another tilt, another C0.

use super::text::LARGEST;
use super::{Goniogram, PhotometricType, Symmetry};
use crate::error::{FormatError, Result};

impl Goniogram {
    /// The same luminaire with its whole flux scaled to `flux` lm; its lamps' flux goes with it, so that the light output ratio stays.
    ///
    /// # Errors
    /// A goniogram without light, or a flux that is not a positive number of a sane size.
    pub fn scaled_to_flux(&self, flux: f64) -> Result<Self> {
        let own = self.flux();
        if !(flux > 0.0 && flux <= LARGEST) {
            return Err(FormatError::whole(format!("the flux is {flux} lm, expected a positive number up to {LARGEST:e}")));
        }
        let factor = flux / own;
        if own <= 0.0 || self.peak() * factor > LARGEST {
            return Err(FormatError::whole(format!("the intensities' flux is {own} lm, too little to be scaled")));
        }
        let mut scaled = self.clone().times(factor);
        scaled.lamp_sets.iter_mut().filter_map(|set| set.flux.as_mut()).for_each(|flux| *flux *= factor);
        Ok(scaled)
    }

    /// The same luminaire with another of its lamp sets, counted from 0: intensities follow the sets' fluxes.
    ///
    /// # Errors
    /// A number beyond the sets, or a set without a flux.
    pub fn with_lamp_set(&self, index: usize) -> Result<Self> {
        let Some(set) = self.lamp_sets.get(index) else {
            let problem = format!("lamp set {} was asked for, the file has {}", index + 1, self.lamp_sets.len());
            return Err(FormatError::whole(problem));
        };
        if index == self.lamp_set {
            return Ok(self.clone());
        }
        let Some((wanted, current)) = set.flux.zip(self.lamps().and_then(|lamps| lamps.flux)) else {
            return Err(FormatError::whole(format!("lamp set {} or the present one states no flux", index + 1)));
        };
        Ok(Self { lamp_set: index, ..self.clone().times(wanted / current) })
    }

    /// The luminaire tilted by `degrees` from the way it was measured: intensities times its lamp's factor there (LM-63, TILT). A luminaire that
    /// is not tilted is as it was measured, whatever its file says.
    ///
    /// # Errors
    /// A file without tilt factors, or a tilt that is not a number.
    pub fn tilted(&self, degrees: f64) -> Result<Self> {
        if degrees == 0.0 {
            return Ok(self.clone());
        }
        let problem = |problem| Err(FormatError::whole(format!("a tilt of {degrees} degrees was asked for, {problem}")));
        match &self.tilt {
            _ if !degrees.is_finite() => problem("expected a number"),
            None => problem("the file has no tilt factors"),
            Some(tilt) => {
                let mut tilted = self.clone().times(tilt.factor(degrees.abs()));
                tilted.stated.light_output_ratio = None;
                Ok(tilted)
            }
        }
    }

    /// A luminaire that stands at a tilt of `from` degrees already, brought to one of `to`; as it is where its file has no tilt factors, or no light at
    /// `from`.
    #[must_use]
    pub fn tilted_on(&self, from: f64, to: f64) -> Self {
        let Some(tilt) = &self.tilt else { return self.clone() };
        let [old, new] = [from, to].map(|degrees| if degrees == 0.0 { 1.0 } else { tilt.factor(degrees.abs()) });
        if old > 0.0 && old != new { self.clone().times(new / old) } else { self.clone() }
    }

    /// The luminaire turned about its vertical axis by `degrees`, from C0 towards C90: what shone along C0 shines along C(degrees).
    ///
    /// Type C keeps every tabulated value; types A and B are resampled to type C. The opening follows quarter turns; by other angles one
    /// that is not round stays, with a warning.
    #[must_use]
    pub fn rotated(&self, degrees: f64) -> Self {
        if !degrees.is_finite() || degrees.rem_euclid(360.0) == 0.0 {
            return self.clone();
        }
        let own = self.to_type_c();
        let mut rotated = if own.symmetry == Symmetry::Rotational { own } else { turned(&own, degrees) };
        let quarters = (degrees / 90.0).rem_euclid(4.0);
        if quarters.fract() == 0.0 {
            rotated.opening = rotated.opening.turned(quarters as usize);
            if quarters % 2.0 == 1.0 && rotated.body[1] > 0.0 {
                rotated.body.swap(0, 1);
            }
        } else if !rotated.opening.is_round() {
            rotated.warnings.push(FormatError::whole(format!("the opening does not follow a rotation by {degrees} degrees")));
        }
        rotated
    }
}

/// Type C planes at angles that are greater by `degrees`.
fn turned(own: &Goniogram, degrees: f64) -> Goniogram {
    let grid = own.expanded();
    let count = grid.vertical.len();
    // The plane at 360 is the one at 0; the circle closes without it.
    let last = grid.horizontal.len() - 1;
    let mut planes: Vec<(f64, usize)> = (0..last).map(|h| ((grid.horizontal[h] + degrees).rem_euclid(360.0), h)).collect();
    planes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let intensities = planes.iter().flat_map(|(_, h)| &grid.intensities[h * count..(h + 1) * count]).copied().collect();
    let turned = Goniogram {
        photometric_type: PhotometricType::C,
        symmetry: Symmetry::None,
        horizontal: planes.iter().map(|(c, _)| *c).collect(),
        vertical: grid.vertical,
        intensities,
        ..own.clone()
    };
    turned.symmetrised(turned.symmetry_found(1e-9))
}
