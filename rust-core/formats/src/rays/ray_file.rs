//! The common form of ray files.

use super::RayFormat;
use crate::FormatError;
use crate::bsdf::cie_1931;
use crate::error::Result;

/// Lumens a watt where the eye is most sensitive.
const EFFICACY: f64 = 683.0;

/// Rays of a light source.
#[derive(Clone, Debug, PartialEq)]
pub struct RayFile {
    /// What kind of file it was.
    pub format: RayFormat,
    /// Where each ray starts, in metres in the file's own axes.
    pub origins: Vec<[f32; 3]>,
    /// Unit vectors.
    pub directions: Vec<[f32; 3]>,
    /// Flux of each ray in [`RayFile::unit`]; the sum is [`RayFile::total`].
    pub fluxes: Vec<f32>,
    /// What fluxes are in.
    pub unit: FluxUnit,
    /// The whole source's flux in [`RayFile::unit`].
    pub total: f64,
    /// Colour.
    pub colour: RayColour,
    /// The file's description of the source.
    pub description: String,
    /// What the file's lengths are in.
    pub length_unit: LengthUnit,
    /// Rays that were left out because they have no direction, a negative flux or numbers that are none.
    pub left_out: u64,
    /// What was repaired or is doubtful.
    pub warnings: Vec<FormatError>,
}

/// What fluxes are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FluxUnit {
    /// Lumens.
    Lumens,
    /// Watts, of a spectrum that the file does not tell.
    Watts,
    /// The file does not say: fluxes are in proportion.
    Relative,
}

/// What lengths are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Metres.
    Metres,
    /// Centimetres.
    Centimetres,
    /// Millimetres.
    Millimetres,
    /// Micrometres.
    Micrometres,
    /// Nanometres.
    Nanometres,
    /// Inches.
    Inches,
    /// Feet.
    Feet,
}

impl LengthUnit {
    /// Metres in one.
    pub fn metres(self) -> f64 {
        match self {
            Self::Metres => 1.0,
            Self::Centimetres => 1e-2,
            Self::Millimetres => 1e-3,
            Self::Micrometres => 1e-6,
            Self::Nanometres => 1e-9,
            Self::Inches => 0.0254,
            Self::Feet => 0.3048,
        }
    }
}

/// Colour of the rays.
#[derive(Clone, Debug, PartialEq)]
pub enum RayColour {
    /// The file tells none.
    Unknown,
    /// One wavelength in nm for all.
    Wavelength(f32),
    /// A wavelength in nm for each ray.
    Wavelengths(Vec<f32>),
    /// CIE 1931 tristimulus values X, Y, Z of each ray; Y is its flux in lm.
    Tristimulus(Vec<[f32; 3]>),
    /// One spectrum for all.
    Spectrum(Spectrum),
    /// One of several spectra for each ray, counted from 0.
    Spectra {
        /// The spectra.
        spectra: Vec<Spectrum>,
        /// Each ray's.
        index: Vec<u32>,
    },
}

/// Power by wavelength, in proportion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// Wavelengths in nm, increasing.
    pub wavelengths: Vec<f32>,
    /// Power for each.
    pub weights: Vec<f32>,
}

impl Spectrum {
    /// Lumens a watt, linear between wavelengths; 0 for a spectrum without power.
    pub fn efficacy(&self) -> f64 {
        let point = |index: usize| [self.wavelengths[index], self.weights[index]].map(f64::from);
        if self.wavelengths.len() == 1 {
            return efficacy(point(0)[0]);
        }
        let (mut seen, mut all) = (0.0, 0.0);
        for index in 1..self.wavelengths.len().min(self.weights.len()) {
            let ([low, from], [high, to]) = (point(index - 1), point(index));
            all += (high - low) * (from + to) / 2.0;
            // Beyond what the eye sees nothing is looked up.
            let ends = [low.max(359.0), high.min(831.0)];
            let steps = (ends[1] - ends[0]).ceil().max(0.0);
            for step in 0..steps as u32 {
                let wavelength = ends[0] + (f64::from(step) + 0.5) * (ends[1] - ends[0]) / steps;
                let weight = from + (wavelength - low) / (high - low) * (to - from);
                seen += weight * efficacy(wavelength) * (ends[1] - ends[0]) / steps;
            }
        }
        if all > 0.0 { seen / all } else { 0.0 }
    }
}

/// Lumens a watt at a wavelength in nm, linear between whole ones.
pub(super) fn efficacy(wavelength: f64) -> f64 {
    let t = wavelength - wavelength.floor();
    let [low, high] = [wavelength.floor(), wavelength.ceil()].map(|whole| cie_1931(whole)[1]);
    EFFICACY * (low + t * (high - low))
}

impl RayFile {
    /// The number of rays.
    pub fn len(&self) -> usize {
        self.fluxes.len()
    }

    /// Whether there is no ray.
    pub fn is_empty(&self) -> bool {
        self.fluxes.is_empty()
    }

    /// The same rays with a luminous flux of `lumens` in all, whatever the file says of it.
    ///
    /// # Errors
    /// A flux that is no positive number, or rays without any.
    pub fn with_lumens(mut self, lumens: f64) -> Result<Self> {
        if !(lumens > 0.0 && lumens <= 1e12) || self.total <= 0.0 {
            return Err(FormatError::whole(format!("{} {:?} cannot become {lumens} lm", self.total, self.unit)));
        }
        self.scale(lumens / self.total);
        (self.unit, self.total) = (FluxUnit::Lumens, lumens);
        Ok(self)
    }

    /// The same rays moved and turned: `x ↦ matrix · x + offset` with a matrix of orthonormal rows.
    #[must_use]
    pub fn moved(mut self, matrix: [[f64; 3]; 3], offset: [f64; 3]) -> Self {
        let turned = |v: &[f32; 3]| matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * f64::from(*b)).sum::<f64>());
        for origin in &mut self.origins {
            let [x, y, z] = turned(origin);
            *origin = [x + offset[0], y + offset[1], z + offset[2]].map(|part| part as f32);
        }
        self.directions.iter_mut().for_each(|direction| *direction = turned(direction).map(|part| part as f32));
        self
    }

    pub(super) fn scale(&mut self, factor: f64) {
        self.fluxes.iter_mut().for_each(|flux| *flux = (f64::from(*flux) * factor) as f32);
        if let RayColour::Tristimulus(values) = &mut self.colour {
            values.iter_mut().flatten().for_each(|value| *value = (f64::from(*value) * factor) as f32);
        }
    }

    /// Each ray's lumens a watt, where the colour says.
    pub(super) fn efficacies(&self) -> Option<Vec<f64>> {
        let count = self.len();
        match &self.colour {
            RayColour::Unknown | RayColour::Tristimulus(_) => None,
            RayColour::Wavelength(wavelength) => Some(vec![efficacy(f64::from(*wavelength)); count]),
            RayColour::Wavelengths(all) => Some(all.iter().map(|wavelength| efficacy(f64::from(*wavelength))).collect()),
            RayColour::Spectrum(spectrum) => Some(vec![spectrum.efficacy(); count]),
            RayColour::Spectra { spectra, index } => {
                let each: Vec<f64> = spectra.iter().map(Spectrum::efficacy).collect();
                index.iter().map(|index| each.get(*index as usize).copied()).collect()
            }
        }
    }
}
