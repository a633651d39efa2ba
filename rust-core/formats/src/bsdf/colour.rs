//! What the channels of a measurement are, and how they become linear Rec.709 and luminance.
//!
//! Spectra are seen by the CIE 1931 2° observer under the equal-energy illuminant, scaled and adapted (Bradford) so that a perfect white
//! reflector is (1, 1, 1). Between bands a spectrum is linear, beyond the first and the last it is constant.

use crate::error::{FormatError, Result};

/// The meaning of a material's channels.
#[derive(Clone, Debug, PartialEq)]
pub enum Channels {
    /// One channel, seen as grey.
    Luminance,
    /// Linear Rec.709.
    Rgb,
    /// CIE 1931 tristimulus values, (1, 1, 1) for a perfect white reflector.
    Xyz,
    /// One channel a band.
    Bands {
        /// The bands' wavelengths, nm, strictly increasing.
        wavelengths_nm: Vec<f64>,
    },
}

/// The observer's curves at 360 to 830 nm in steps of 1 nm: x̄, ȳ, z̄ (CIE 15, table of the 1931 standard observer).
const OBSERVER: &[u8; 3 * 471 * 4] = include_bytes!("observer.f32");

/// The first of the observer's wavelengths, nm.
const OBSERVER_START: f64 = 360.0;

/// How many wavelengths the observer has.
const OBSERVER_COUNT: usize = 471;

/// From tristimulus values under the equal-energy white to linear Rec.709 (IEC 61966-2-1's primaries), Bradford adaptation to D65.
/// Rows sum to one.
pub(crate) const XYZ_TO_RGB: [[f64; 3]; 3] = [
    [3.146_657_65, -1.666_463_75, -0.480_193_90],
    [-0.995_521_61, 1.955_756_73, 0.039_764_88],
    [0.063_594_80, -0.214_563_22, 1.150_968_42],
];

/// Rec.709's luminance.
pub(crate) const LUMINANCE: [f64; 3] = [0.212_639, 0.715_169, 0.072_192];

impl Channels {
    /// How many there are.
    pub fn count(&self) -> usize {
        match self {
            Self::Luminance => 1,
            Self::Rgb | Self::Xyz => 3,
            Self::Bands { wavelengths_nm } => wavelengths_nm.len(),
        }
    }

    /// Its name for people.
    pub fn name(&self) -> String {
        match self {
            Self::Luminance => "luminance".into(),
            Self::Rgb => "linear RGB".into(),
            Self::Xyz => "XYZ".into(),
            Self::Bands { wavelengths_nm } => {
                let [first, last] = [wavelengths_nm.first(), wavelengths_nm.last()].map(|w| w.copied().unwrap_or(0.0));
                format!("{} bands from {first} to {last} nm", wavelengths_nm.len())
            }
        }
    }

    /// Bands at wavelengths, nm.
    ///
    /// # Errors
    /// When there is none, one is not positive and finite, or they do not increase.
    pub fn bands(wavelengths_nm: Vec<f64>) -> Result<Self> {
        if wavelengths_nm.is_empty() {
            return Err(FormatError::whole("no wavelength, expected at least one"));
        }
        if let Some(bad) = wavelengths_nm.iter().find(|w| !(w.is_finite() && **w > 0.0)) {
            return Err(FormatError::whole(format!("wavelength {bad} nm, expected a positive one")));
        }
        match wavelengths_nm.windows(2).find(|w| w[0] >= w[1]) {
            Some(w) => Err(FormatError::whole(format!("wavelength {} nm after {} nm, expected increasing ones", w[1], w[0]))),
            None => Ok(Self::Bands { wavelengths_nm }),
        }
    }

    /// A channel's weights in linear Rec.709: the colour is the sum over channels of value × weight.
    pub fn rgb_weights(&self) -> Vec<[f64; 3]> {
        match self {
            Self::Luminance => vec![[1.0; 3]],
            Self::Rgb => vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Xyz => (0..3).map(|c| XYZ_TO_RGB.map(|row| row[c])).collect(),
            Self::Bands { wavelengths_nm } => {
                let rgb = |xyz: &[f64; 3]| XYZ_TO_RGB.map(|row| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]);
                tristimulus_weights(wavelengths_nm).iter().map(rgb).collect()
            }
        }
    }

    /// A channel's weight in luminance. It is ȳ's for spectra, so exact also where adaptation moves a saturated colour's luminance.
    pub fn luminance_weights(&self) -> Vec<f64> {
        match self {
            Self::Luminance => vec![1.0],
            Self::Rgb => LUMINANCE.to_vec(),
            Self::Xyz => vec![0.0, 1.0, 0.0],
            Self::Bands { wavelengths_nm } => tristimulus_weights(wavelengths_nm).iter().map(|xyz| xyz[1]).collect(),
        }
    }
}

/// Each band's share of X, Y and Z: the observer's curves folded with the hats of linear interpolation. Shares sum to one.
fn tristimulus_weights(wavelengths_nm: &[f64]) -> Vec<[f64; 3]> {
    let mut weights = vec![[0.0; 3]; wavelengths_nm.len()];
    let mut sum = [0.0; 3];
    let mut above = 0;
    for step in 0..OBSERVER_COUNT {
        let wavelength = OBSERVER_START + step as f64;
        while above < wavelengths_nm.len() && wavelengths_nm[above] <= wavelength {
            above += 1;
        }
        let low = above.saturating_sub(1);
        let high = above.min(wavelengths_nm.len() - 1);
        let width = wavelengths_nm[high] - wavelengths_nm[low];
        let t = if width > 0.0 { (wavelength - wavelengths_nm[low]) / width } else { 0.0 };
        for curve in 0..3 {
            let response = observer(step, curve);
            weights[low][curve] += (1.0 - t) * response;
            weights[high][curve] += t * response;
            sum[curve] += response;
        }
    }
    weights.iter().map(|w| [w[0] / sum[0], w[1] / sum[1], w[2] / sum[2]]).collect()
}

/// The CIE 1931 2° observer's x̄, ȳ, z̄ at a wavelength in nm, to the nearest nanometre; zero outside 360 to 830.
pub fn cie_1931(nanometres: f64) -> [f64; 3] {
    let step = (nanometres - OBSERVER_START).round();
    if !(0.0..OBSERVER_COUNT as f64).contains(&step) { [0.0; 3] } else { std::array::from_fn(|curve| observer(step as usize, curve)) }
}

/// One curve of the observer at one of its wavelengths.
fn observer(step: usize, curve: usize) -> f64 {
    let at = 4 * (3 * step + curve);
    f64::from(f32::from_le_bytes([OBSERVER[at], OBSERVER[at + 1], OBSERVER[at + 2], OBSERVER[at + 3]]))
}
