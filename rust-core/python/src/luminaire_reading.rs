//! What the goniophotometer has found.

use crate::{
    array::Array,
    error::{exception, setting, told},
    measure::Reading,
};
use gonio::{
    Diagnostic,
    goniometer::{self, Value, colour},
    measure,
    output::write_atomically,
};
use gonio_formats::photometry::{Symmetry, is_date, measured::MeasurementHead};
use pyo3::prelude::*;
use std::{io::Write, path::PathBuf};

/// A luminaire as the goniophotometer sees it. Arrays of directions have a row for each C plane and a column for each γ.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct LuminaireReading {
    pub(crate) reading: goniometer::Reading,
    pub(crate) name: String,
    pub(crate) symmetry: Option<Symmetry>,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

fn with_error(value: Value) -> Reading {
    Reading::of(measure::Reading { value: value.value, standard_error: value.error })
}

#[pymethods]
impl LuminaireReading {
    /// C planes in degrees.
    #[getter]
    fn c(&self) -> Array {
        Array::flat(self.reading.angles.c.clone())
    }
    /// γ in degrees.
    #[getter]
    fn gamma(&self) -> Array {
        Array::flat(self.reading.angles.gamma.clone())
    }
    /// Luminous intensities in cd.
    #[getter]
    fn intensities(&self) -> Array {
        self.rows(&self.reading.intensities)
    }
    /// Their standard errors in cd.
    #[getter]
    fn standard_errors(&self) -> Array {
        self.rows(&self.reading.errors)
    }
    /// CIE 1931 tristimulus values in cd of all directions, plane by plane: (N, 3).
    #[getter]
    fn tristimulus(&self) -> Array {
        Array::rows(self.reading.rgb.iter().flat_map(|rgb| colour::tristimulus(*rgb)).collect(), 3)
    }
    /// Colour temperatures in K; nan where there is no light, or none of a black body's colour.
    #[getter]
    fn colour_temperatures(&self) -> Array {
        let kelvin: Vec<f64> =
            self.reading.rgb.iter().map(|rgb| colour::colour_temperature(*rgb).map_or(f64::NAN, |[kelvin, _]| kelvin)).collect();
        self.rows(&kelvin)
    }
    /// Flux in lm that the sources send.
    #[getter]
    fn emitted(&self) -> Reading {
        with_error(self.reading.fluxes.emitted)
    }
    /// Flux in lm that leaves the luminaire.
    #[getter]
    fn flux(&self) -> Reading {
        with_error(self.reading.fluxes.escaped)
    }
    /// Flux in lm that the luminaire absorbs.
    #[getter]
    fn absorbed(&self) -> Reading {
        with_error(self.reading.fluxes.absorbed)
    }
    /// Flux in lm of paths that were too long.
    #[getter]
    fn cut_off(&self) -> Reading {
        with_error(self.reading.fluxes.cut_off)
    }
    /// Flux over that of the sources; None where these send none.
    #[getter]
    fn light_output_ratio(&self) -> Option<Reading> {
        self.reading.light_output_ratio().map(with_error)
    }
    /// Of the flux that leaves, what goes above the horizontal plane, lm.
    #[getter]
    fn flux_up(&self) -> Reading {
        with_error(self.reading.fluxes.up)
    }
    /// The greatest intensity in cd, with the symmetry of the files. Its direction is chosen by its neighbours, so that noise does not raise
    /// it.
    #[getter]
    fn peak(&self) -> Reading {
        with_error(self.reading.peak)
    }
    /// C and γ of the greatest intensity, degrees.
    #[getter]
    fn peak_direction(&self) -> (f64, f64) {
        self.reading.peak_direction.into()
    }
    /// Least and greatest coordinates of where light leaves, in the luminaire's axes, metres: of an open reflector its mouth.
    #[getter]
    fn opening(&self) -> ([f64; 3], [f64; 3]) {
        self.reading.opening.bounds.into()
    }
    /// The same of each part that shines apart from the others.
    #[getter]
    fn opening_parts(&self) -> Vec<([f64; 3], [f64; 3])> {
        self.reading.opening.parts.iter().map(|part| (*part).into()).collect()
    }
    /// Luminous square metres that are seen from below, or from above of what shines up alone.
    #[getter]
    fn opening_area(&self) -> f64 {
        self.reading.opening.area
    }
    /// Whether the opening is round.
    #[getter]
    fn round(&self) -> bool {
        self.reading.opening.is_round()
    }
    /// Least and greatest coordinates of all that belongs to the luminaire, in its axes, metres.
    #[getter]
    fn body(&self) -> ([f64; 3], [f64; 3]) {
        self.reading.body.into()
    }
    /// Illuminance in lx on the screen, row by row; None without one.
    #[getter]
    fn screen(&self) -> Option<Array> {
        self.reading.screen.as_ref().map(|screen| Array::rows(screen.illuminance.clone(), screen.screen.size[0]))
    }
    /// Its standard errors in lx.
    #[getter]
    fn screen_errors(&self) -> Option<Array> {
        self.reading.screen.as_ref().map(|screen| Array::rows(screen.errors.clone(), screen.screen.size[0]))
    }
    /// Rays that were traced from the sources.
    #[getter]
    fn rays(&self) -> u64 {
        self.reading.paths
    }
    /// Time that it took.
    #[getter]
    fn seconds(&self) -> f64 {
        self.reading.elapsed.as_secs_f64()
    }
    /// Whether the error that was asked for was reached.
    #[getter]
    fn converged(&self) -> bool {
        self.reading.converged
    }
    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        told(&self.diagnostics)
    }
    /// All directions as comma-separated values.
    fn csv(&self) -> String {
        self.reading.csv()
    }
    /// Writes EULUMDAT (.ldt), LM-63-2019 (.ies), TM-33 (.xml) or GLDF (.gldf: with the meshes, the lamps' colour and spectrum). symmetry: "auto" (the
    /// highest that the errors bear out), "none", "rotational", "c0", "c90" or "quadrants", whose equal intensities are averaged; without it that of the
    /// measurement. date: a day such as "2026-03-31". Returns what the file cannot hold, as (origin, message).
    #[pyo3(signature = (path, *, symmetry = None, name = None, manufacturer = "", watts = None, date = ""))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn write(
        &self,
        py: Python<'_>,
        path: PathBuf,
        symmetry: Option<&str>,
        name: Option<String>,
        manufacturer: &str,
        watts: Option<f64>,
        date: &str,
    ) -> PyResult<Vec<(String, String)>> {
        if !date.is_empty() && !is_date(date) {
            return Err(setting("date", format!("'{date}' was found, expected a day as 2026-03-31")));
        }
        let name = name.unwrap_or_else(|| self.name.clone());
        let head = MeasurementHead { name, manufacturer: manufacturer.to_owned(), date: date.to_owned(), ..MeasurementHead::default() };
        let symmetry = symmetry.map_or(Ok(self.symmetry), symmetry_of)?;
        let reduced = self.reading.measurement(head, watts).reduced(symmetry).map_err(|error| setting("symmetry", error.problem))?;
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let (bytes, left_out) = match ending.as_str() {
            "ldt" => (reduced.to_ldt(), Vec::new()),
            "ies" => (reduced.to_ies(), Vec::new()),
            "xml" => (reduced.to_tm33(), Vec::new()),
            "gldf" => py.detach(|| self.reading.to_gldf(&reduced)).map_err(exception)?,
            _ => return Err(setting("path", format!("{}: the ending is '{ending}', expected ldt, ies, xml or gldf", path.display()))),
        };
        py.detach(|| write_atomically(&path, true, |file| file.write_all(&bytes))).map_err(exception)?;
        Ok(told(&left_out))
    }
    fn __repr__(&self) -> String {
        let (flux, peak) = (self.reading.fluxes.escaped.value, self.reading.peak.value);
        format!("<gonio.LuminaireReading: {flux:.1} lm, {peak:.1} cd at most>")
    }
}

impl LuminaireReading {
    fn rows(&self, values: &[f64]) -> Array {
        Array::rows(values.to_vec(), self.reading.angles.gamma.len())
    }
}

pub(crate) fn symmetry_of(name: &str) -> PyResult<Option<Symmetry>> {
    Ok(match name {
        "auto" => None,
        "none" => Some(Symmetry::None),
        "rotational" => Some(Symmetry::Rotational),
        "c0" => Some(Symmetry::AboutC0),
        "c90" => Some(Symmetry::AboutC90),
        "quadrants" => Some(Symmetry::Quadrants),
        other => {
            let expected = "auto, none, rotational, c0, c90 or quadrants";
            return Err(setting("symmetry", format!("'{other}' was found, expected {expected}")));
        }
    })
}
