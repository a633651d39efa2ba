//! Alpha-opic quantities of CIE S 026:2018: what the five receptors of the eye get of a light.

use crate::{
    illuminant::daylight,
    named::nominal_daylight,
    observer::{EFFICACY, cie_1931},
    source::{Node, sums, with_power},
    table::Table,
};
use std::sync::LazyLock;

/// The receptors, in the order of the figures: their short names in CIE S 026 and in words.
pub const OPSINS: [(&str, &str); 5] = [("sc", "S cones"), ("mc", "M cones"), ("lc", "L cones"), ("rh", "rods"), ("mel", "melanopsin")];

static SPECTRA: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/alpha_opic.csv")));

/// What D65 gives each receptor, W/lm.
static DAYLIGHT: LazyLock<[f64; 5]> = LazyLock::new(|| {
    let nodes: Vec<Node> = (360..=830).map(|nm| Node { nm: f64::from(nm), width: 1.0, power: 0.0 }).collect();
    efficacies(&with_power(&nodes, daylight(nominal_daylight(65.0))))
});

/// What a receptor gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlphaOpic {
    /// The α-opic efficacy of luminous radiation, mW/lm.
    pub elr_mw_per_lm: f64,
    /// The α-opic daylight (D65) efficacy ratio: the equivalent daylight illuminance over the illuminance.
    pub der: f64,
}

/// In the order of [`OPSINS`].
pub(crate) fn alpha_opic(nodes: &[Node]) -> [AlphaOpic; 5] {
    let efficacies = efficacies(nodes);
    std::array::from_fn(|k| AlphaOpic { elr_mw_per_lm: 1e3 * efficacies[k], der: efficacies[k] / DAYLIGHT[k] })
}

/// What melanopsin gets of a wavelength in nm.
pub(crate) fn melanopic(nm: f64) -> f64 {
    SPECTRA.at(4, nm)
}

/// The melanopic equivalent daylight luminance of a radiance of 1 W/(m² sr) at a wavelength in nm, cd/m² (of an irradiance, lx).
pub fn melanopic_daylight(nm: f64) -> f64 {
    melanopic(nm) / DAYLIGHT[4]
}

fn efficacies(nodes: &[Node]) -> [f64; 5] {
    let [luminous] = sums(nodes, |nm| [cie_1931(nm)[1]]);
    sums(nodes, |nm| SPECTRA.all::<5>(nm)).map(|sum| sum / (EFFICACY * luminous))
}
