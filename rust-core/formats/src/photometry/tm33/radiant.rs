//! Intensities in watts or photons as candela, by the emitter's spectrum.

use crate::bsdf::cie_1931;
use crate::error::{FormatError, Result};
use crate::photometry::text::number;
use crate::spectrum::SpectralPower;
use crate::xml::{at, content, descend, value_at};
use roxmltree::Node;

/// lm/W of light of 540 THz (SI).
const EFFICACY: f64 = 683.002;
/// µmol of photons in a joule at 1 nm: 1/(h c N_A), which holds for any wavelength times its nanometres.
const PHOTONS: f64 = 8.359_346_7e-3;
/// The widest step of sums, nm; within it a spectrum is linear.
const WIDEST_STEP: f64 = 5.0;

/// Intensities that are not candela, and what they are.
#[derive(Clone, Copy)]
pub(super) struct Radiant<'a, 'input> {
    data: Node<'a, 'input>,
    pub(super) intensity: Node<'a, 'input>,
    counts_photons: bool,
}

impl<'a, 'input> Radiant<'a, 'input> {
    /// Those of an emitter: in W/sr, else in µmol/(s sr).
    pub(super) fn of(emitter: Node<'a, 'input>) -> Option<Self> {
        let find = |data, intensity, counts_photons| {
            let data = descend(emitter, &[data])?;
            Some(Self { data, intensity: descend(data, &[intensity])?, counts_photons })
        };
        find("RadiantData", "RadiantIntensity", false).or_else(|| find("PhotonData", "PhotonIntensity", true))
    }

    /// Candela of a unit of intensity, where the emitter's spectrum is known over the range that was measured; it is told.
    pub(super) fn candela(&self, spectrum: Option<&SpectralPower>, warnings: &mut Vec<FormatError>) -> Result<f64> {
        let (what, unit) = if self.counts_photons { ("photon", "µmol/(s sr)") } else { ("radiant", "W/sr") };
        if descend(self.intensity, &["Absolute"]).is_some_and(|node| ["false", "0"].contains(&content(node))) {
            return Err(at(self.intensity, format!("relative {what} intensities: no candela can be found")));
        }
        let spectrum = spectrum.ok_or_else(|| {
            at(self.data, format!("{what} intensities ({unit}) and no spectrum to be used: no candela can be found without one"))
        })?;
        let bound = |name| value_at(self.data, &[name]).ok_or_else(|| at(self.data, format!("{what} data without <{name}>, expected nm")));
        let [from, to] = [bound("MinWavelength")?, bound("MaxWavelength")?];
        let known = [spectrum.wavelengths_nm[0], spectrum.wavelengths_nm[spectrum.wavelengths_nm.len() - 1]];
        if from >= to || from < known[0] - WIDEST_STEP || to > known[1] + WIDEST_STEP {
            let [first, last, from, to] = [known[0], known[1], from, to].map(number);
            let problem =
                format!("{what} intensities of {from} to {to} nm and a spectrum of {first} to {last} nm, expected one that covers them");
            return Err(at(self.data, problem));
        }
        let luminous = EFFICACY * integral(spectrum, known, |nm| cie_1931(nm)[1]);
        let measured = integral(spectrum, [from, to], |nm| if self.counts_photons { PHOTONS * nm } else { 1.0 });
        if !(luminous > 0.0 && measured > 0.0) {
            return Err(at(self.data, format!("{what} intensities and a spectrum without visible light, or without any in their range")));
        }
        let factor = luminous / measured;
        let unit = if self.counts_photons { "lm s/µmol" } else { "lm/W" };
        warnings.push(FormatError::whole(format!("{what} intensities: they are candela by {factor:.1} {unit} of the emitter's spectrum")));
        Ok(factor)
    }
}

/// The integral of power times a response over a range, by the trapezoidal rule at the spectrum's points and in steps of 5 nm at most.
fn integral(spectrum: &SpectralPower, [from, to]: [f64; 2], response: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for (nm, power) in spectrum.wavelengths_nm.windows(2).zip(spectrum.power.windows(2)) {
        let [start, end] = [nm[0].max(from), nm[1].min(to)];
        if start >= end {
            continue;
        }
        let value = |at: f64| (power[0] + (power[1] - power[0]) * (at - nm[0]) / (nm[1] - nm[0])) * response(at);
        // A step of 5 nm that was rounded is one step; what is far from anything visible is none of many.
        let parts = ((end - start) / WIDEST_STEP - 1e-6).ceil().clamp(1.0, 1000.0);
        let width = (end - start) / parts;
        let place = |part: usize| start + width * part as f64;
        sum += (0..parts as usize).map(|part| 0.5 * width * (value(place(part)) + value(place(part + 1)))).sum::<f64>();
    }
    sum
}
