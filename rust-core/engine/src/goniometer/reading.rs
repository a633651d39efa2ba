//! What was measured.

use super::{angles::Angles, colour, frame::Frame, opening::Opening, product::Product, screen::Screen};
use crate::{error::Diagnostic, light_paths::Channels, transport::Statistics};
use gonio_formats::photometry::measured::{Measurement, MeasurementHead};
use std::time::Duration;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Value {
    /// The value.
    pub value: f64,
    /// Its standard error in the same unit.
    pub error: f64,
}

impl Value {
    /// The standard error over the value; infinite where there is no value.
    pub fn relative_error(&self) -> f64 {
        if self.value > 0.0 { self.error / self.value } else { f64::INFINITY }
    }
}

/// Where the light went, in lm. What left, what was absorbed and what was cut off add up to what the sources sent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fluxes {
    /// What the sources sent.
    pub emitted: Value,
    /// What left the luminaire.
    pub escaped: Value,
    /// Of what left, that which goes above the horizontal plane.
    pub up: Value,
    /// What surfaces and solids took.
    pub absorbed: Value,
    /// What was still under way when its paths were cut off.
    pub cut_off: Value,
}

impl Fluxes {
    /// The same with nothing absorbed where noise makes less than that of it: no more leaves than was sent. Standard errors stay.
    pub(super) fn bounded(mut self) -> Self {
        let missing = (-self.absorbed.value).max(0.0);
        self.absorbed.value += missing;
        self.escaped.value = (self.escaped.value - missing).max(0.0);
        self.up.value = self.up.value.clamp(0.0, self.escaped.value);
        self
    }
}

/// Illuminance on a screen.
#[derive(Clone, Debug, PartialEq)]
pub struct ScreenReading {
    /// The screen.
    pub screen: Screen,
    /// Illuminance in lx, row by row.
    pub illuminance: Vec<f64>,
    /// Standard errors in lx.
    pub errors: Vec<f64>,
}

/// A luminaire as the goniophotometer sees it.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The photometric frame.
    pub frame: Frame,
    /// The directions.
    pub angles: Angles,
    /// Intensities in cd, R, G, B: `[plane * gammas + gamma]`.
    pub rgb: Vec<Channels>,
    /// Luminous intensities in cd, in the same order.
    pub intensities: Vec<f64>,
    /// Their standard errors in cd.
    pub errors: Vec<f64>,
    /// The greatest intensity in cd, by the symmetry of the files: noise does not raise it.
    pub peak: Value,
    /// C and γ of it in degrees.
    pub peak_direction: [f64; 2],
    /// Where the light went.
    pub fluxes: Fluxes,
    /// What left, R, G, B.
    pub escaped_rgb: Channels,
    /// Where it left, in the frame.
    pub opening: Opening,
    /// Least and greatest coordinates of all that belongs to the luminaire, in the frame, metres.
    pub body: [[f64; 3]; 2],
    /// What of the luminaire a product's file has beside its photometry.
    pub product: Product,
    /// Illuminance on the screen, if one was asked for.
    pub screen: Option<ScreenReading>,
    /// Paths that were traced.
    pub paths: u64,
    /// Time that it took.
    pub elapsed: Duration,
    /// Whether the error that was asked for was reached.
    pub converged: bool,
    /// Counts of rays.
    pub statistics: Statistics,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
}

impl Reading {
    /// C and γ in degrees of a direction by its place.
    pub fn direction(&self, place: usize) -> [f64; 2] {
        let gammas = self.angles.gamma.len();
        [self.angles.c[place / gammas], self.angles.gamma[place % gammas]]
    }

    /// The luminaire's flux over that of its sources; nothing where these send none.
    pub fn light_output_ratio(&self) -> Option<Value> {
        let [emitted, escaped] = [self.fluxes.emitted.value, self.fluxes.escaped.value];
        (emitted > 0.0).then(|| Value { value: (escaped / emitted).min(1.0), error: self.fluxes.escaped.error / emitted })
    }

    /// Colour temperature in K of all that left; nothing where the light is white or of no black body's colour.
    pub fn colour_temperature(&self) -> Option<f64> {
        self.temperature_and_duv().map(|[kelvin, _]| kelvin)
    }

    /// The same with Duv.
    pub fn temperature_and_duv(&self) -> Option<[f64; 2]> {
        Some(self.escaped_rgb).filter(|rgb| colour::is_coloured(*rgb)).and_then(colour::colour_temperature)
    }

    /// Whether light of different directions has different colours, by more than noise would: chromaticities of intensities above a tenth of the
    /// peak differ from the whole's by more than 0.003.
    pub fn varies_in_colour(&self) -> bool {
        let Some(whole) = colour::chromaticity(self.escaped_rgb) else { return false };
        let least = 0.1 * self.peak.value;
        let of = |i: usize| colour::chromaticity(self.rgb[i]).map_or(0.0, |xy| (xy[0] - whole[0]).hypot(xy[1] - whole[1]));
        (0..self.rgb.len()).any(|i| self.intensities[i] > least && of(i) > 0.003)
    }

    /// The measurement as photometric files have it.
    pub fn measurement(&self, head: MeasurementHead, watts: Option<f64>) -> Measurement {
        let body: [f64; 3] = [0, 1, 2].map(|k| self.body[1][k] - self.body[0][k]);
        Measurement {
            planes: self.angles.c.clone(),
            gammas: self.angles.gamma.clone(),
            intensities: self.intensities.clone(),
            errors: self.errors.clone(),
            source_flux: self.fluxes.emitted.value,
            flux: self.fluxes.escaped.value,
            flux_error: self.fluxes.escaped.error,
            flux_up: Some([self.fluxes.up.value, self.fluxes.up.error]),
            opening: self.opening.shape,
            body: Some(body),
            watts,
            colour_temperature: self.colour_temperature(),
            head,
        }
    }
}
