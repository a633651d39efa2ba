//! Colour rendering by CIE 13.3:1995: Ra and the fifteen special indices.

use crate::{
    illuminant::rendering_reference,
    observer::{self, cie_1931},
    samples::Samples,
    source::Node,
    table::Table,
};
use std::sync::LazyLock;

/// How far a lamp may be from its reference in the CIE 1960 diagram (CIE 13.3, 5.3).
pub const TOLERANCE: f64 = 5.4e-3;

/// How many samples there are, the Japanese skin last.
const COUNT: usize = 15;

pub(crate) static SAMPLES: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/samples.csv")));

/// Figures of CIE 13.3. Values are not rounded to whole numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendering {
    /// The general index, the mean of the first eight.
    pub ra: f64,
    /// The special indices: R1 to R14, and R15 of the Japanese skin (JIS Z 8726).
    pub r: [f64; 15],
    /// How far the lamp is from its reference in the CIE 1960 diagram; beyond [`TOLERANCE`] the method does not hold.
    pub distance: f64,
}

/// The samples at the points of a lamp's sums.
pub(crate) fn samples(nodes: &[Node]) -> Samples {
    Samples::new(nodes, cie_1931, &SAMPLES, COUNT)
}

/// The indices of a lamp of a correlated colour temperature in K.
pub(crate) fn rendering(nodes: &[Node], samples: &Samples, kelvin: f64) -> Rendering {
    let [lamp, reference] = [samples.under(nodes), samples.under(&rendering_reference(nodes, kelvin))];
    let [at, to] = [observer::uv(lamp.white), observer::uv(reference.white)];
    let index = |sample: usize| {
        let scaled = |sums: [f64; 3], white: [f64; 3]| sums.map(|value| 100.0 * value / white[1]);
        let test = scaled(lamp.samples[sample], lamp.white);
        let reference = scaled(reference.samples[sample], reference.white);
        let test = uniform(test[1], adapted(observer::uv(test), at, to), to);
        let reference = uniform(reference[1], observer::uv(reference), to);
        let difference = test.iter().zip(reference).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        100.0 - 4.6 * difference
    };
    let r: [f64; 15] = std::array::from_fn(index);
    Rendering { ra: r[..8].iter().sum::<f64>() / 8.0, r, distance: (at[0] - to[0]).hypot(at[1] - to[1]) }
}

/// A sample's chromaticity under the lamp, adapted to the reference (von Kries, CIE 13.3, 5.7).
fn adapted(sample: [f64; 2], lamp: [f64; 2], reference: [f64; 2]) -> [f64; 2] {
    let c = |[u, v]: [f64; 2]| (4.0 - u - 10.0 * v) / v;
    let d = |[u, v]: [f64; 2]| (1.708 * v + 0.404 - 1.481 * u) / v;
    let c = c(reference) / c(lamp) * c(sample);
    let d = d(reference) / d(lamp) * d(sample);
    let below = 16.518 + 1.481 * c - d;
    [(10.872 + 0.404 * c - 4.0 * d) / below, 5.520 / below]
}

/// W*, U*, V* of 1964.
fn uniform(luminance: f64, [u, v]: [f64; 2], [u0, v0]: [f64; 2]) -> [f64; 3] {
    let w = 25.0 * luminance.cbrt() - 17.0;
    [w, 13.0 * w * (u - u0), 13.0 * w * (v - v0)]
}
