//! Illuminants by formula: blackbodies, daylight, CIE standard illuminant A, and the references of colour rendering.

use crate::{
    observer,
    source::{Node, sums, with_power},
    table::Table,
};
use std::sync::LazyLock;

/// Planck's second constant in nm K, as the CIE rounds it (CIE 15, ITS-90).
const C2: f64 = 1.4388e7;

/// The temperatures of daylight, K (CIE 15).
pub(crate) const DAYLIGHT: [f64; 2] = [4000.0, 25_000.0];

static COMPONENTS: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/daylight.csv")));

/// A blackbody's radiance at a wavelength in nm and a temperature in K, relative to that at 560 nm.
pub(crate) fn planck(nm: f64, kelvin: f64) -> f64 {
    planck_with(C2, nm, kelvin)
}

/// CIE standard illuminant A (ISO/CIE 11664-2), whose formula has the second constant and the temperature of 1931.
pub(crate) fn standard_a(nm: f64) -> f64 {
    planck_with(1.435e7, nm, 2848.0)
}

fn planck_with(c2: f64, nm: f64, kelvin: f64) -> f64 {
    let rise = |nm: f64| (c2 / (nm * kelvin)).exp_m1();
    (560.0 / nm).powi(5) * rise(560.0) / rise(nm)
}

/// Daylight of a correlated colour temperature within [`DAYLIGHT`] (CIE 15, 4.1.2), whose factors are rounded to three digits there.
pub(crate) fn daylight(kelvin: f64) -> impl Fn(f64) -> f64 {
    let [i, i2, i3] = [1e3 / kelvin, 1e6 / kelvin.powi(2), 1e9 / kelvin.powi(3)];
    let x = if kelvin <= 7000.0 {
        -4.6070 * i3 + 2.9678 * i2 + 0.09911 * i + 0.244_063
    } else {
        -2.0064 * i3 + 1.9018 * i2 + 0.24748 * i + 0.237_040
    };
    let y = -3.0 * x * x + 2.870 * x - 0.275;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let rounded = |value: f64| (1000.0 * value).round() / 1000.0;
    let m1 = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
    let m2 = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / m);
    move |nm| {
        let [s0, s1, s2] = daylight_components(nm);
        s0 + m1 * s1 + m2 * s2
    }
}

/// S0, S1 and S2, which daylight is made of (CIE 15, table 6), at a wavelength in nm.
pub(crate) fn daylight_components(nm: f64) -> [f64; 3] {
    COMPONENTS.all(nm)
}

/// CIE 13.3's reference at the points of a sum: a blackbody below 5000 K, daylight from there on.
pub(crate) fn rendering_reference(nodes: &[Node], kelvin: f64) -> Vec<Node> {
    if kelvin < 5000.0 { with_power(nodes, |nm| planck(nm, kelvin)) } else { with_power(nodes, daylight(kelvin)) }
}

/// CIE 224's and TM-30's reference at the points of a sum: from 4000 to 5000 K the one goes over into the other, at equal luminance.
pub(crate) fn fidelity_reference(nodes: &[Node], kelvin: f64) -> Vec<Node> {
    let share = ((kelvin - 4000.0) / 1000.0).clamp(0.0, 1.0);
    let black = with_power(nodes, |nm| planck(nm, kelvin));
    if share == 0.0 {
        return black;
    }
    let day = with_power(nodes, daylight(kelvin));
    let luminance = |nodes: &[Node]| sums(nodes, observer::cie_1931)[1];
    let [of_black, of_day] = [(1.0 - share) / luminance(&black), share / luminance(&day)];
    black.iter().zip(&day).map(|(black, day)| Node { power: of_black * black.power + of_day * day.power, ..*black }).collect()
}
