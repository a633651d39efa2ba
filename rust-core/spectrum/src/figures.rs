//! All figures of a spectrum.

use crate::{
    alpha_opic::{AlphaOpic, alpha_opic},
    cct::{HIGHEST_CCT, LARGEST_DUV, LOWEST_CCT, cct},
    illuminant::DAYLIGHT,
    observer::{EFFICACY, cie_1931, uv, xy},
    rendering::{self, Rendering, TOLERANCE, rendering},
    rendition::{self, Rendition, rendition},
    source::{Node, Spectrum, sums},
};

/// What a spectrum says.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// CIE 1931 chromaticity x, y.
    pub xy: [f64; 2],
    /// CIE 1976 chromaticity u', v'.
    pub uv: [f64; 2],
    /// Where the power is largest, nm.
    pub peak_nm: f64,
    /// Luminous efficacy of radiation, lm/W, over the spectrum's own wavelengths.
    pub ler: f64,
    /// What each receptor gets, in the order of [`crate::OPSINS`]; a colour does not tell it.
    pub alpha_opic: Option<[AlphaOpic; 5]>,
    /// What is defined for white light alone; `None` where the light is not.
    pub white: Option<White>,
    /// What a reader should know: of the data, and of figures that are undefined or outside their standard's range.
    pub notes: Vec<String>,
}

/// Figures of white light, which has a correlated colour temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct White {
    /// Correlated colour temperature, K.
    pub cct: f64,
    /// Signed distance from the blackbodies in the CIE 1960 diagram, positive above them (greenish).
    pub duv: f64,
    /// CIE 13.3; a colour does not tell it.
    pub rendering: Option<Rendering>,
    /// TM-30-20.
    pub rendition: Option<Rendition>,
}

impl Spectrum {
    /// Luminous efficacy of radiation, lm/W: of the power within the observer's range.
    pub fn luminous_efficacy(&self) -> f64 {
        let nodes = self.nodes();
        efficacy(&nodes, sums(&nodes, cie_1931))
    }
}

fn efficacy(nodes: &[Node], xyz: [f64; 3]) -> f64 {
    let [power] = sums(nodes, |_| [1.0]);
    EFFICACY * xyz[1] / power
}

impl Figures {
    /// What of them holds where a colour stands for the spectrum.
    pub fn of_colour(mut self) -> Self {
        self.alpha_opic = None;
        if let Some(white) = &mut self.white {
            let told: Vec<String> = doubts(white).collect();
            self.notes.retain(|note| !told.contains(note));
            (white.rendering, white.rendition) = (None, None);
        }
        self
    }

    /// What melanopsin gets over what it gets of daylight of the same lx.
    pub fn melanopic_der(&self) -> Option<f64> {
        self.alpha_opic.map(|receptors| receptors[4].der)
    }
}

impl White {
    /// One of the special indices R1 to R15 of CIE 13.3, by its number.
    pub fn special_index(&self, number: usize) -> Option<f64> {
        self.rendering.as_ref()?.r.get(number.checked_sub(1)?).copied()
    }
}

/// The figures of a spectrum.
pub fn figures(spectrum: &Spectrum) -> Figures {
    let nodes = spectrum.nodes();
    let xyz = sums(&nodes, cie_1931);
    let [u, v] = uv(xyz);
    let peak = (0..spectrum.power.len()).max_by(|a, b| spectrum.power[*a].total_cmp(&spectrum.power[*b])).unwrap_or(0);
    let mut notes = spectrum.notes.clone();
    let white = match cct([u, v]) {
        Some((cct, duv)) if duv.abs() <= LARGEST_DUV => {
            let kelvin = cct.min(DAYLIGHT[1]);
            let rendering = Some(rendering(&nodes, &rendering::samples(&nodes), kelvin));
            let within = rendition::within(&nodes);
            let white = White { cct, duv, rendering, rendition: rendition(&within, &rendition::samples(&within), kelvin) };
            notes.extend(doubts(&white));
            Some(white)
        }
        Some((_, duv)) => {
            notes.push(format!(
                "no CCT, Ra, Rf and Rg: Duv is {duv:+.4}, and light further than {LARGEST_DUV} from the blackbodies is not white (CIE 15)"
            ));
            None
        }
        None => {
            notes.push(format!("no CCT, Ra, Rf and Rg: the nearest blackbody lies outside of {LOWEST_CCT} to {HIGHEST_CCT} K"));
            None
        }
    };
    Figures {
        xy: xy(xyz),
        uv: [u, 1.5 * v],
        peak_nm: spectrum.wavelengths_nm[peak],
        ler: efficacy(&nodes, xyz),
        alpha_opic: Some(alpha_opic(&nodes)),
        white,
        notes,
    }
}

/// Where a white light's figures are outside of their standard's range.
fn doubts(white: &White) -> impl Iterator<Item = String> {
    let far = white.rendering.as_ref().map(|rendering| rendering.distance).filter(|distance| *distance > TOLERANCE).map(|distance| {
        format!(
            "Ra and R1 to R15 are outside of CIE 13.3's range: {distance:.4} from the reference in the 1960 diagram, {TOLERANCE} at most"
        )
    });
    let none = white.rendition.is_none().then(|| "no Rf and Rg: a hue bin of TM-30 holds no sample in this light".to_owned());
    far.into_iter().chain(none)
}
