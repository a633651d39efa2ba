//! Colour rendition by ANSI/IES TM-30-20 (as TM-30-18), whose fidelity index is CIE 224:2017's: Rf, Rg, sixteen hue bins.

use crate::{
    appearance::{Adapted, Appearance},
    illuminant::fidelity_reference,
    observer::cie_1964,
    samples::{Samples, Seen},
    source::Node,
    table::Table,
};
use std::sync::LazyLock;

/// How many colour evaluation samples there are.
const SAMPLES: usize = 99;
/// How many hue bins.
const BINS: usize = 16;
/// The samples' wavelengths, nm, one by one.
const RANGE: [f64; 2] = [380.0, 780.0];

/// Reflectances of the samples.
static CES: LazyLock<Table> = LazyLock::new(|| {
    let bytes: &[u8; SAMPLES * 401 * 4] = include_bytes!("../data/ces.f32");
    let value = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    Table::of(RANGE[0], 1.0, bytes.chunks_exact(401 * 4).map(|row| row.chunks_exact(4).map(value).collect()).collect())
});

/// Figures of TM-30.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendition {
    /// The fidelity index Rf.
    pub rf: f64,
    /// The gamut index Rg.
    pub rg: f64,
    /// The fidelity of each of the 99 samples.
    pub samples: Vec<f64>,
    /// The sixteen hue bins, from red on.
    pub bins: Vec<HueBin>,
}

/// A hue bin of 22.5°.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HueBin {
    /// Local fidelity Rf,h.
    pub fidelity: f64,
    /// Local chroma shift Rcs,h in per cent.
    pub chroma_shift: f64,
    /// Local hue shift Rhs,h in radians.
    pub hue_shift: f64,
    /// Mean a', b' of the bin's samples under the lamp.
    pub test: [f64; 2],
    /// The same under the reference.
    pub reference: [f64; 2],
}

/// The points of a lamp's sums that count here.
pub(crate) fn within(nodes: &[Node]) -> Vec<Node> {
    nodes.iter().copied().filter(|node| (RANGE[0]..=RANGE[1]).contains(&node.nm)).collect()
}

/// The samples at these points.
pub(crate) fn samples(nodes: &[Node]) -> Samples {
    Samples::new(nodes, cie_1964, &CES, SAMPLES)
}

/// The figures of a lamp of a correlated colour temperature in K by its points [`within`]; `None` where the colour appearance model has no answer.
pub(crate) fn rendition(nodes: &[Node], samples: &Samples, kelvin: f64) -> Option<Rendition> {
    let [test, reference] = [nodes, &fidelity_reference(nodes, kelvin)].map(|light| looks(&samples.under(light)));
    let differences: Vec<f64> = test.iter().zip(&reference).map(|(a, b)| difference(a, b)).collect();
    let bins: Option<Vec<HueBin>> = (0..BINS).map(|bin| hue_bin(bin, &test, &reference, &differences)).collect();
    let bins = bins?;
    let area = |corner: fn(&HueBin) -> [f64; 2]| -> f64 {
        let corners: Vec<[f64; 2]> = bins.iter().map(corner).collect();
        (0..BINS).map(|k| (corners[k], corners[(k + 1) % BINS])).map(|([a0, b0], [a1, b1])| a0 * b1 - b0 * a1).sum()
    };
    let rf = fidelity(differences.iter().sum::<f64>() / SAMPLES as f64);
    let rg = 100.0 * area(|bin| bin.test) / area(|bin| bin.reference);
    (rf.is_finite() && rg.is_finite()).then(|| Rendition { rf, rg, samples: differences.into_iter().map(fidelity).collect(), bins })
}

/// How the samples look under a light.
fn looks(seen: &Seen) -> Vec<Appearance> {
    let scale = 100.0 / seen.white[1];
    let scaled = |sums: [f64; 3]| sums.map(|value| scale * value);
    let adapted = Adapted::new(scaled(seen.white));
    seen.samples.iter().map(|sample| adapted.see(scaled(*sample))).collect()
}

fn difference(a: &Appearance, b: &Appearance) -> f64 {
    a.place.iter().zip(b.place).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// An index of a difference in CAM02-UCS (CIE 224, TM-30-18): below zero nothing.
fn fidelity(difference: f64) -> f64 {
    10.0 * ((100.0 - 6.73 * difference) / 10.0).exp().ln_1p()
}

/// A bin of the samples whose hue under the reference lies in it; `None` where there is no such sample.
fn hue_bin(bin: usize, test: &[Appearance], reference: &[Appearance], differences: &[f64]) -> Option<HueBin> {
    let width = 360.0 / BINS as f64;
    let inside: Vec<usize> = (0..reference.len()).filter(|k| (reference[*k].hue / width) as usize == bin).collect();
    let mean = |value: &dyn Fn(usize) -> f64| inside.iter().map(|k| value(*k)).sum::<f64>() / inside.len() as f64;
    let place = |seen: &[Appearance]| [1, 2].map(|axis| mean(&|k| seen[k].place[axis]));
    let [test, reference] = [place(test), place(reference)];
    let (sin, cos) = (width * (bin as f64 + 0.5)).to_radians().sin_cos();
    let [a, b] = [test[0] - reference[0], test[1] - reference[1]];
    let chroma = reference[0].hypot(reference[1]);
    (!inside.is_empty()).then(|| HueBin {
        fidelity: fidelity(mean(&|k| differences[k])),
        chroma_shift: 100.0 * (a * cos + b * sin) / chroma,
        hue_shift: (b * cos - a * sin) / chroma,
        test,
        reference,
    })
}
