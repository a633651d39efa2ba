//! Colour rendering of many spectra that are known at the same wavelengths, as the pixels of a picture are.

use crate::{
    cct::cct_nearby,
    illuminant::DAYLIGHT,
    observer::{self, cie_1931},
    rendering::{self, TOLERANCE, rendering},
    rendition::{self, rendition},
    samples::Samples,
    source::{Node, Spectrum, sums},
};

/// What CIE 13.3 and TM-30 want at some wavelengths.
#[derive(Debug)]
pub struct RenderingOfMany {
    wavelengths_nm: Vec<f64>,
    colour: Samples,
    evaluation: Samples,
}

impl RenderingOfMany {
    /// At wavelengths in nm, which increase.
    pub fn new(wavelengths_nm: &[f64]) -> Self {
        let nodes = nodes(wavelengths_nm, &vec![1.0; wavelengths_nm.len()]);
        let colour = rendering::samples(&nodes);
        let evaluation = rendition::samples(&rendition::within(&nodes));
        Self { wavelengths_nm: wavelengths_nm.to_vec(), colour, evaluation }
    }

    /// Ra of power at the wavelengths. `None` where there is no light, it is not white, or further than [`TOLERANCE`] from its reference.
    pub fn ra(&self, power: &[f64]) -> Option<f64> {
        let nodes = nodes(&self.wavelengths_nm, power);
        let found = rendering(&nodes, &self.colour, kelvin(&nodes)?);
        (found.distance <= TOLERANCE).then_some(found.ra)
    }

    /// Rf and Rg. `None` where there is no light or it is not white, or a hue bin is empty.
    pub fn rf_rg(&self, power: &[f64]) -> Option<[f64; 2]> {
        let nodes = rendition::within(&nodes(&self.wavelengths_nm, power));
        rendition(&nodes, &self.evaluation, kelvin(&nodes)?).map(|found| [found.rf, found.rg])
    }
}

/// The points of the sums. Power below zero, which takes light away, counts as none.
fn nodes(wavelengths_nm: &[f64], power: &[f64]) -> Vec<Node> {
    let power = power.iter().map(|power| power.max(0.0)).collect();
    Spectrum { name: String::new(), wavelengths_nm: wavelengths_nm.to_vec(), power, notes: Vec::new() }.nodes()
}

/// The temperature of the reference.
fn kelvin(nodes: &[Node]) -> Option<f64> {
    let xyz = sums(nodes, cie_1931);
    (xyz[1] > 0.0).then(|| cct_nearby(observer::uv(xyz))).flatten().map(|(kelvin, _)| kelvin.min(DAYLIGHT[1]))
}
