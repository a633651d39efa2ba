//! Rays as files have them, cleaned and counted.

use super::ray_file::efficacy;
use super::{FluxUnit, LengthUnit, RayColour, RayFile, RayFormat};
use crate::error::{FormatError, Result};
use crate::photometry::text::LARGEST;
use crate::short_number;

/// A direction's length may differ from 1 by that much before it is told.
const UNIT: f64 = 1e-2;

/// Fluxes that differ by less than this share are the same.
const SAME_FLUX: f64 = 0.02;

/// Fluxes of all rays below this are none: single precision would lose their digits.
const LEAST: f64 = 1e-30;

/// One ray: position in the file's unit, direction, flux.
pub(super) type Ray = [f32; 7];

/// Rays on their way into a [`RayFile`].
#[derive(Debug)]
pub(super) struct Collector {
    file: RayFile,
    metres: f64,
    /// Numbers beside position, direction and flux, so many for each ray.
    extra: Vec<f32>,
    not_finite: u64,
    without_direction: u64,
    negative: u64,
    not_unit: u64,
}

/// What the head of a file says of its flux.
#[derive(Clone, Copy, Debug)]
pub(super) struct StatedFlux {
    /// What the rays' fluxes are in.
    pub(super) rays: FluxUnit,
    /// The whole flux in lumens.
    pub(super) lumens: Option<f64>,
    /// The whole flux in watts.
    pub(super) watts: Option<f64>,
    /// Whether rays of another sum are worth a word.
    pub(super) exact: bool,
}

impl Collector {
    pub(super) fn new(format: RayFormat, length_unit: LengthUnit, capacity: usize) -> Self {
        let file = RayFile {
            format,
            origins: Vec::with_capacity(capacity),
            directions: Vec::with_capacity(capacity),
            fluxes: Vec::with_capacity(capacity),
            unit: FluxUnit::Relative,
            total: 0.0,
            colour: RayColour::Unknown,
            description: String::new(),
            length_unit,
            left_out: 0,
            warnings: Vec::new(),
        };
        let metres = length_unit.metres();
        Self { file, metres, extra: Vec::new(), not_finite: 0, without_direction: 0, negative: 0, not_unit: 0 }
    }

    /// Takes a ray if it can be used, with the numbers beside it.
    pub(super) fn push(&mut self, ray: &Ray, extra: &[f32]) {
        let [x, y, z, kx, ky, kz, flux] = ray.map(f64::from);
        let length = (kx * kx + ky * ky + kz * kz).sqrt();
        let sane = |value: &f32| value.is_finite() && f64::from(value.abs()) <= LARGEST;
        if !ray.iter().chain(extra).all(sane) {
            self.not_finite += 1;
        } else if length < 1e-6 {
            self.without_direction += 1;
        } else if flux < 0.0 {
            self.negative += 1;
        } else {
            self.not_unit += u64::from((length - 1.0).abs() > UNIT);
            self.file.origins.push([x, y, z].map(|part| (part * self.metres) as f32));
            self.file.directions.push([kx, ky, kz].map(|part| (part / length) as f32));
            self.file.fluxes.push(flux as f32);
            self.extra.extend_from_slice(extra);
        }
    }

    /// A warning.
    pub(super) fn warn(&mut self, problem: String) {
        self.file.warnings.push(FormatError::whole(problem));
    }

    /// The numbers beside the rays that were taken.
    pub(super) fn take_extra(&mut self) -> Vec<f32> {
        std::mem::take(&mut self.extra)
    }

    pub(super) fn describe(&mut self, description: &str) {
        self.file.description = description.trim().to_owned();
    }

    /// The rays with their colour and the flux that the head states.
    ///
    /// # Errors
    /// When no ray is left, or none has flux.
    pub(super) fn finish(mut self, colour: RayColour, stated: StatedFlux) -> Result<RayFile> {
        self.file.colour = colour;
        let all = self.not_finite + self.without_direction + self.negative;
        let kinds = [
            (self.not_finite, "with numbers that are none"),
            (self.without_direction, "without a direction"),
            (self.negative, "of negative flux"),
        ];
        for (count, kind) in kinds.into_iter().filter(|(count, _)| *count > 0) {
            self.warn(format!("{count} of {} rays {kind} were left out", all + self.file.len() as u64));
        }
        if self.not_unit > 0 {
            self.warn(format!("{} directions were not of unit length", self.not_unit));
        }
        self.file.left_out = all;
        let sum = self.sum();
        if self.file.is_empty() || sum < LEAST {
            let problem = if self.file.is_empty() { "no ray is left" } else { "no ray has any flux" };
            let left_out = if all > 0 { format!(" after {all} were left out") } else { String::new() };
            return Err(FormatError::whole(format!("{problem}{left_out}")));
        }
        self.settle(stated, sum)?;
        Ok(self.file)
    }

    fn sum(&self) -> f64 {
        self.file.fluxes.iter().map(|flux| f64::from(*flux)).sum()
    }

    /// Brings the fluxes to lumens where the file says how, and their sum to what it states.
    fn settle(&mut self, stated: StatedFlux, sum: f64) -> Result<()> {
        let positive = |flux: Option<f64>| flux.filter(|flux| (LEAST..=LARGEST).contains(flux));
        let (lumens, watts) = (positive(stated.lumens), positive(stated.watts));
        let own = if stated.rays == FluxUnit::Lumens { lumens } else { watts };
        if let Some(own) = own.filter(|own| stated.exact && (sum / own - 1.0).abs() > SAME_FLUX) {
            let [sum, own] = [sum, own].map(short_number);
            self.warn(format!("the rays' fluxes add up to {sum}, the head states {own}: that is taken"));
        }
        let total = match stated.rays {
            FluxUnit::Lumens | FluxUnit::Relative => {
                self.file.unit = if lumens.is_some() { FluxUnit::Lumens } else { stated.rays };
                lumens.unwrap_or(sum)
            }
            FluxUnit::Watts => self.watts_to_lumens(lumens, watts, sum),
        };
        let sum = self.sum();
        if !(sum >= LEAST && total >= LEAST) {
            return Err(FormatError::whole("the rays' colours are not seen: there is no luminous flux"));
        }
        self.file.scale(total / sum);
        self.file.total = total;
        Ok(())
    }

    /// Fluxes in watts become lumens by each ray's colour, or by the whole flux in lumens where all rays share one.
    fn watts_to_lumens(&mut self, lumens: Option<f64>, watts: Option<f64>, sum: f64) -> f64 {
        let scale = watts.map_or(1.0, |watts| watts / sum);
        let Some(efficacies) = self.file.efficacies() else {
            self.file.unit = if lumens.is_some() { FluxUnit::Lumens } else { FluxUnit::Watts };
            return lumens.or(watts).unwrap_or(sum);
        };
        self.file.unit = FluxUnit::Lumens;
        if lumens.is_some() && efficacies.iter().all(|efficacy| *efficacy == efficacies[0]) {
            return lumens.unwrap_or(0.0);
        }
        for (flux, efficacy) in self.file.fluxes.iter_mut().zip(efficacies) {
            *flux = (f64::from(*flux) * efficacy * scale) as f32;
        }
        lumens.unwrap_or_else(|| self.sum())
    }
}

/// How many rays of `stride` bytes are read: as many as the head states, if they are there.
///
/// # Errors
/// Fewer rays than stated, unless `lenient`; or none.
pub(super) fn count(stated: u64, stride: usize, left: usize, lenient: bool) -> Result<(usize, Option<String>)> {
    let there = left / stride;
    if stated == 0 {
        return Err(FormatError::whole("the head states no ray"));
    }
    if stated > there as u64 {
        let problem = format!("the head states {stated} rays, {there} are there");
        return if lenient && there > 0 { Ok((there, Some(problem))) } else { Err(FormatError::whole(problem)) };
    }
    let rest = left - stated as usize * stride;
    let warning = (rest > 0).then(|| format!("{rest} bytes behind the last ray are not read"));
    Ok((stated as usize, warning))
}

/// Wavelengths in nm that are plausible for light.
pub(super) fn is_wavelength(nanometres: f32) -> bool {
    (1.0..=1e6).contains(&nanometres)
}

/// Whether any of the wavelengths is seen.
pub(super) fn is_seen(wavelengths: &[f32]) -> bool {
    wavelengths.iter().any(|wavelength| efficacy(f64::from(*wavelength)) > 0.0)
}
