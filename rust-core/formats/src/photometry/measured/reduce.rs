//! From all planes to those that a symmetry leaves, and to files.

use super::symmetry::Group;
use super::{Measurement, SymmetryTest, WithError};
use crate::error::{FormatError, Result};
use crate::photometry::check::TOLERANCE;
use crate::photometry::ies::Generation;
use crate::photometry::text::number;
use crate::photometry::{Goniogram, HeaderLine, LampSet, PhotometricType, Stated, Symmetry, ies, ldt, tm33};

/// Share of the flux that may be on the other side of the horizon by interpolation.
const HORIZON: f64 = 5e-3;

/// Who measures.
const LABORATORY: &str = "gonio virtual goniophotometer";

/// A measurement with a symmetry: a goniogram, and the standard errors of its intensities.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// The goniogram; its lamps' flux is what the sources emit.
    pub goniogram: Goniogram,
    /// Standard errors in cd of the goniogram's intensities, in their order.
    pub errors: Vec<f64>,
    /// The symmetries that were tested, the one that holds last.
    pub tests: Vec<SymmetryTest>,
    /// Luminous flux in lm that left the luminaire, counted without regard to angles.
    pub flux: f64,
    /// Its standard error in lm.
    pub flux_error: f64,
    /// Share of it that goes below the horizontal plane, if that was counted apart.
    pub(super) counted_below: Option<WithError>,
    /// Luminous flux in lm that the sources emit.
    pub source_flux: f64,
}

impl Measurement {
    /// The goniogram with the highest symmetry that the errors bear out, or with the one that is named: each intensity is the mean over what
    /// the symmetry makes equal, its error the root of the sum of squares over their number.
    ///
    /// Intensities never hold more than the sources emit: where interpolation makes more of them, they are lowered by that.
    ///
    /// Warnings tell where the angles are too coarse for the intensities to hold the counted flux within 2 %, where they put light on the other side of
    /// the horizon, and where a named symmetry is not borne out.
    ///
    /// # Errors
    /// A measurement that makes no sense, or planes that cannot have the symmetry: two planes need a number that four divides, one plane
    /// through C0 and C180 an even one.
    pub fn reduced(&self, symmetry: Option<Symmetry>) -> Result<Reduced> {
        let whole = self.checked()?;
        let (symmetry, tests) = match symmetry {
            Some(symmetry) => (symmetry, whole.symmetry_test(symmetry).into_iter().collect()),
            None => whole.symmetry_found(),
        };
        let Some(groups) = whole.groups(symmetry) else {
            let problem = format!("{} C planes cannot be {symmetry:?}: their mirror images are no planes", whole.planes.len());
            return Err(FormatError::whole(problem));
        };
        let (intensities, errors) = whole.means(&groups);
        let goniogram = whole.goniogram(symmetry, groups.iter().map(|(c, _)| *c).collect(), intensities);
        let mut reduced = Reduced {
            goniogram,
            errors,
            tests,
            flux: self.flux,
            flux_error: self.flux_error,
            counted_below: self.counted_below(),
            source_flux: self.source_flux,
        };
        let below = reduced.share_below();
        reduced.goniogram.stated.downward_fraction = Some(below.value).filter(|_| self.flux > 0.0);
        reduced.warn();
        reduced.bound();
        Ok(reduced)
    }

    /// The share of the flux that was counted below the horizontal plane.
    fn counted_below(&self) -> Option<WithError> {
        let [up, error] = self.flux_up?;
        (self.flux > 0.0).then(|| WithError { value: (1.0 - up / self.flux).clamp(0.0, 1.0), error: error / self.flux })
    }

    /// Means and errors of groups of planes. At the poles all planes are one direction.
    fn means(&self, groups: &[Group]) -> (Vec<f64>, Vec<f64>) {
        let all: Vec<usize> = (0..self.planes.len()).collect();
        let (mut intensities, mut errors) = (Vec::new(), Vec::new());
        for (_, members) in groups {
            for gamma in 0..self.gammas.len() {
                let pole = self.is_pole(gamma);
                let members = if pole { &all } else { members };
                let values: Vec<[f64; 2]> = members.iter().map(|plane| self.at(*plane, gamma)).collect();
                let count = values.len() as f64;
                let error = values.iter().map(|[_, variance]| variance).sum::<f64>().sqrt() / count;
                // One value for all planes is one measurement, not many.
                let once = pole && values.iter().all(|value| *value == values[0]);
                intensities.push(values.iter().map(|[value, _]| value).sum::<f64>() / count);
                errors.push(if once { error * count.sqrt() } else { error });
            }
        }
        (intensities, errors)
    }

    fn goniogram(&self, symmetry: Symmetry, horizontal: Vec<f64>, intensities: Vec<f64>) -> Goniogram {
        let emits = self.source_flux > 0.0;
        let lamps = LampSet {
            count: 1,
            flux: Some(if emits { self.source_flux } else { self.flux }).filter(|flux| *flux > 0.0),
            absolute: !emits,
            watts: self.watts.filter(|watts| watts.is_finite()).unwrap_or(0.0).max(0.0),
            colour: self.colour_temperature.map(|kelvin| format!("{} K", number(kelvin.round()))).unwrap_or_default(),
            ..LampSet::default()
        };
        // EULUMDAT's length runs along C90–C270, and a width of 0 is round.
        let round = self.opening.is_round() && self.opening.size[0] > 0.0;
        let body = self.body.map_or([0.0; 3], |[x, y, z]| if round && x == y { [x, 0.0, z] } else { [y, x, z] });
        Goniogram {
            photometric_type: PhotometricType::C,
            symmetry,
            horizontal,
            vertical: self.gammas.clone(),
            intensities,
            opening: self.opening,
            body,
            lamp_sets: vec![lamps],
            lamp_set: 0,
            tilt: None,
            stated: Stated { light_output_ratio: emits.then(|| (self.flux / self.source_flux).min(1.0)), ..Stated::default() },
            header: self.header(),
            spectrum: None,
            warnings: Vec::new(),
        }
    }

    fn header(&self) -> Vec<HeaderLine> {
        let head = &self.head;
        let texts = [
            ("TEST", &head.report),
            ("ISSUEDATE", &head.date),
            ("MANUFAC", &head.manufacturer),
            ("LUMCAT", &head.catalogue_number),
            ("LUMINAIRE", &head.name),
        ];
        let line = |keyword: &str, text: &str| HeaderLine { keyword: keyword.into(), text: text.into() };
        let mut lines: Vec<HeaderLine> =
            texts.iter().filter(|(_, text)| !text.trim().is_empty()).map(|(keyword, text)| line(keyword, text)).collect();
        lines.push(line("TESTLAB", LABORATORY));
        if self.source_flux > 0.0 {
            let ratio = format!(
                "{:.2} % of {} lm that the sources emit",
                100.0 * (self.flux / self.source_flux).min(1.0),
                number(self.source_flux)
            );
            lines.push(line("OTHER", &format!("light output ratio {ratio}")));
        }
        if let Some(kelvin) = self.colour_temperature {
            lines.push(line("OTHER", &format!("correlated colour temperature {} K", number(kelvin.round()))));
        }
        lines
    }
}

impl Reduced {
    fn warn(&mut self) {
        let flux = self.goniogram.flux();
        let mut warnings = Vec::new();
        if flux <= 0.0 {
            warnings.push("all intensities are 0".to_owned());
        } else if (flux / self.flux - 1.0).abs() > TOLERANCE + 3.0 * self.flux_error / self.flux {
            warnings.push(format!("{:.1} lm were counted, but the intensities' flux is {flux:.1} lm: finer angles are needed", self.flux));
        }
        let by_table = self.share_by_intensities();
        if let Some(counted) = self.counted_below.filter(|_| flux > 0.0)
            && (counted.value - by_table.value).abs() > HORIZON + 3.0 * by_table.error.max(counted.error)
        {
            let [counted, by_table] = [counted, by_table].map(|share| 100.0 * share.value);
            warnings.push(format!(
                "{counted:.1} % of the light was counted below the horizon, but the intensities put {by_table:.1} % there: γ = 90° is needed among \
                 the angles, or finer ones"
            ));
        }
        if let Some(test) = self.tests.last().filter(|test| !test.holds && test.symmetry == self.goniogram.symmetry) {
            warnings.push(format!(
                "{:?} symmetry is not what was measured: χ² is {:.2} per degree of freedom, the largest difference {:.1} standard errors",
                test.symmetry,
                test.chi_square.max(test.flux_chi_square),
                test.largest
            ));
        }
        self.goniogram.warnings.extend(warnings.into_iter().map(FormatError::whole));
    }

    /// Lowers intensities whose flux is more than the sources emit.
    fn bound(&mut self) {
        let flux = self.goniogram.flux();
        if self.source_flux <= 0.0 || flux <= self.source_flux {
            return;
        }
        self.goniogram.intensities.iter_mut().chain(&mut self.errors).for_each(|value| *value *= self.source_flux / flux);
    }

    /// The bytes of an EULUMDAT file: cd per 1000 lm of the sources' flux.
    pub fn to_ldt(&self) -> Vec<u8> {
        ldt::write(&self.goniogram)
    }

    /// The bytes of an LM-63-2019 file: absolute photometry, said to come from a simulation.
    pub fn to_ies(&self) -> Vec<u8> {
        ies::write_2019(&self.absolute(), Generation::Simulation)
    }

    /// The bytes of a TM-33 file: absolute photometry, said to come from a simulation.
    pub fn to_tm33(&self) -> Vec<u8> {
        tm33::write(&self.absolute(), true)
    }

    /// The goniogram with the luminaire's own flux instead of the sources'.
    pub(super) fn absolute(&self) -> Goniogram {
        let mut goniogram = self.goniogram.clone();
        for lamps in &mut goniogram.lamp_sets {
            lamps.absolute = true;
            lamps.flux = None;
        }
        goniogram.stated.light_output_ratio = None;
        goniogram
    }
}
