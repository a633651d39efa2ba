//! From all planes to those that a symmetry leaves, and to files.

use super::symmetry::Group;
use super::{Measurement, SymmetryTest};
use crate::error::{FormatError, Result};
use crate::photometry::check::TOLERANCE;
use crate::photometry::ies::Generation;
use crate::photometry::text::number;
use crate::photometry::{Goniogram, HeaderLine, LampSet, PhotometricType, Stated, Symmetry, ies, ldt, tm33};

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
    /// Luminous flux in lm that the sources emit.
    pub source_flux: f64,
}

impl Measurement {
    /// The goniogram with the highest symmetry that the errors bear out, or with the one that is named: each intensity is the mean over what
    /// the symmetry makes equal, its error the root of the sum of squares over their number.
    ///
    /// A warning tells where the angles are too coarse for the intensities to hold the counted flux within 2 %, and where a named symmetry
    /// is not borne out.
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
        let mut goniogram = whole.goniogram(symmetry, groups.iter().map(|(c, _)| *c).collect(), intensities);
        goniogram.stated.downward_fraction = Some(goniogram.flux_below() / goniogram.flux()).filter(|share| share.is_finite());
        whole.warn(&mut goniogram, &tests);
        Ok(Reduced { goniogram, errors, tests, flux: self.flux, flux_error: self.flux_error, source_flux: self.source_flux })
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
        let body = self.body.map_or([0.0; 3], |[x, y, z]| if self.round && x == y { [x, 0.0, z] } else { [y, x, z] });
        Goniogram {
            photometric_type: PhotometricType::C,
            symmetry,
            horizontal,
            vertical: self.gammas.clone(),
            intensities,
            opening: self.luminous_opening(),
            body,
            lamp_sets: vec![lamps],
            lamp_set: 0,
            tilt: None,
            stated: Stated { light_output_ratio: emits.then(|| self.flux / self.source_flux), ..Stated::default() },
            header: self.header(),
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
            let ratio = format!("{:.2} % of {} lm that the sources emit", 100.0 * self.flux / self.source_flux, number(self.source_flux));
            lines.push(line("OTHER", &format!("light output ratio {ratio}")));
        }
        if let Some(kelvin) = self.colour_temperature {
            lines.push(line("OTHER", &format!("correlated colour temperature {} K", number(kelvin.round()))));
        }
        lines
    }

    fn warn(&self, goniogram: &mut Goniogram, tests: &[SymmetryTest]) {
        let flux = goniogram.flux();
        if flux <= 0.0 {
            goniogram.warnings.push(FormatError::whole("all intensities are 0"));
        } else if (flux / self.flux - 1.0).abs() > TOLERANCE + 3.0 * self.flux_error / self.flux {
            let problem = format!("{:.1} lm were counted, but the intensities' flux is {flux:.1} lm: finer angles are needed", self.flux);
            goniogram.warnings.push(FormatError::whole(problem));
        }
        if let Some(test) = tests.last().filter(|test| !test.holds && test.symmetry == goniogram.symmetry) {
            let problem = format!(
                "{:?} symmetry is not what was measured: χ² is {:.2} per degree of freedom, the largest difference {:.1} standard errors",
                test.symmetry,
                test.chi_square.max(test.flux_chi_square),
                test.largest
            );
            goniogram.warnings.push(FormatError::whole(problem));
        }
    }
}

impl Reduced {
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
    fn absolute(&self) -> Goniogram {
        let mut goniogram = self.goniogram.clone();
        for lamps in &mut goniogram.lamp_sets {
            lamps.absolute = true;
            lamps.flux = None;
        }
        goniogram.stated.light_output_ratio = None;
        goniogram
    }
}
