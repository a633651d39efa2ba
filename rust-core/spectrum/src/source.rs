//! The spectrum of a source, and how it is summed.

use crate::{
    check,
    observer::{EFFICACY, cie_1931},
    table::linear,
};
use gonio_formats::{FormatError, spectrum::SpectralPoint};

/// The widest step that is summed as it is, nm (CIE 15, CIE 224); within wider ones a spectrum is linear.
pub(crate) const WIDEST_STEP: f64 = 5.0;

/// The spectrum of a light source: at least five points that increase, no power below zero, some of it visible.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// What it is called; empty where nothing says.
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Power per nanometre at each of them, in any unit.
    pub power: Vec<f64>,
    /// What a reader should know of the data: ranges that are missing, noise below zero, wide steps.
    pub notes: Vec<String>,
}

/// A point of the sum: the power within the point's share of the wavelengths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) nm: f64,
    /// The share of the wavelengths, nm.
    pub(crate) width: f64,
    pub(crate) power: f64,
}

impl Spectrum {
    /// A spectrum of points.
    ///
    /// # Errors
    /// Lists of two lengths, fewer than five points, wavelengths that do not increase or are no nanometres, gaps of more than 20 nm in what is
    /// visible, power that is not finite or below zero, no visible light.
    pub fn new(name: &str, wavelengths_nm: &[f64], power: &[f64]) -> Result<Self, FormatError> {
        if wavelengths_nm.len() != power.len() {
            return Err(FormatError::whole(format!("{} wavelengths and {} powers", wavelengths_nm.len(), power.len())));
        }
        let points = wavelengths_nm.iter().zip(power).map(|(nm, power)| SpectralPoint { nm: *nm, power: *power, line: None });
        check::checked(name, &points.collect::<Vec<_>>())
    }

    /// The power at a wavelength in nm: linear between the points, zero beyond them.
    pub fn at(&self, nm: f64) -> f64 {
        linear(&self.wavelengths_nm, &self.power, nm)
    }

    /// Lumens of a power in W/nm, or lux of an irradiance in W/(m² nm).
    pub fn luminous(&self) -> f64 {
        let [luminous] = sums(&self.nodes(), |nm| [cie_1931(nm)[1]]);
        EFFICACY * luminous
    }

    /// The points of its sums.
    pub(crate) fn nodes(&self) -> Vec<Node> {
        let mut points = Vec::with_capacity(self.power.len());
        for (w, p) in self.wavelengths_nm.windows(2).zip(self.power.windows(2)) {
            // A step of 5 nm that was rounded is one step.
            let parts = ((w[1] - w[0]) / WIDEST_STEP - 1e-6).ceil().max(1.0);
            points.extend((0..parts as usize).map(|part| {
                let t = part as f64 / parts;
                (w[0] + t * (w[1] - w[0]), p[0] + t * (p[1] - p[0]))
            }));
        }
        points.extend(self.wavelengths_nm.last().copied().zip(self.power.last().copied()));
        let width = |k: usize| {
            let below = if k == 0 { 0.0 } else { points[k].0 - points[k - 1].0 };
            let above = if k + 1 == points.len() { 0.0 } else { points[k + 1].0 - points[k].0 };
            0.5 * (below + above)
        };
        points.iter().enumerate().map(|(k, (nm, power))| Node { nm: *nm, width: width(k), power: *power }).collect()
    }
}

/// Sums of power times responses.
pub(crate) fn sums<const N: usize>(nodes: &[Node], response: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut sums = [0.0; N];
    for node in nodes {
        let at = response(node.nm);
        for (sum, response) in sums.iter_mut().zip(at) {
            *sum += node.width * node.power * response;
        }
    }
    sums
}

/// The same points with another source's power.
pub(crate) fn with_power(nodes: &[Node], power: impl Fn(f64) -> f64) -> Vec<Node> {
    nodes.iter().map(|node| Node { power: power(node.nm), ..*node }).collect()
}
