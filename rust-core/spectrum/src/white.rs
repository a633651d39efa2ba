//! CIE standard illuminant D65 as the white of linear colour, over the visible wavelengths.

use crate::{
    illuminant::daylight,
    integral::{Integral, VISIBLE},
    named::nominal_daylight,
    observer::cie_1931,
    table::Table,
};
use std::sync::LazyLock;

/// From tristimulus values to linear Rec.709 (ITU-R BT.709's primaries and white).
pub(crate) const XYZ_TO_REC709: [[f64; 3]; 3] = [
    [3.240_969_941_904_521, -1.537_383_177_570_093, -0.498_610_760_293_003],
    [-0.969_243_636_280_88, 1.875_967_501_507_721, 0.041_555_057_407_176],
    [0.055_630_079_696_994, -0.203_976_958_888_977, 1.056_971_514_242_879],
];

/// The luminance of D65's table; at whole nanometres D65's power, x̄, ȳ and z̄ times it, and linear Rec.709 of these.
struct White {
    luminance: f64,
    power: Table,
    observed: Table,
    colour: Table,
}

static WHITE: LazyLock<White> = LazyLock::new(|| {
    let [first, last] = VISIBLE;
    let wavelengths: Vec<f64> = (0..=(last - first) as u32).map(|k| first + f64::from(k)).collect();
    let daylight = daylight(nominal_daylight(65.0));
    let columns = |values: &dyn Fn(f64) -> [f64; 3]| {
        Table::of(first, 1.0, (0..3).map(|k| wavelengths.iter().map(|nm| values(*nm)[k]).collect()).collect())
    };
    let luminance = Integral::new(&[], |nm| [daylight(nm) * cie_1931(nm)[1]]).all()[0];
    let power = |nm: f64| daylight(nm) / luminance;
    let colour = |nm: f64| turned(&XYZ_TO_REC709, cie_1931(nm).map(|observed| power(nm) * observed));
    let unscaled = columns(&colour);
    let white = Integral::new(&[], |nm| unscaled.all::<3>(nm)).all();
    White {
        luminance,
        power: Table::of(first, 1.0, vec![wavelengths.iter().map(|nm| power(*nm)).collect()]),
        observed: columns(&cie_1931),
        colour: columns(&|nm| {
            let colour = colour(nm);
            std::array::from_fn(|k| colour[k] / white[k])
        }),
    }
});

/// D65's power per nanometre, linear between whole nanometres; its luminance, the integral of ȳ times it, is 1.
pub(crate) fn d65(nm: f64) -> f64 {
    WHITE.power.at(0, nm)
}

/// D65's power per nanometre from 300 to 830 nm, where the integral of ȳ times it is 1 over 380 to 780 nm.
pub fn d65_power(nm: f64) -> f64 {
    daylight(nominal_daylight(65.0))(nm) / WHITE.luminance
}

/// x̄, ȳ, z̄, linear between whole nanometres.
pub(crate) fn observer(nm: f64) -> [f64; 3] {
    WHITE.observed.all(nm)
}

/// Linear Rec.709 of a nanometre of D65. Its integral is (1, 1, 1): each channel is scaled, which removes rounding of matrix and table.
pub(crate) fn colour(nm: f64) -> [f64; 3] {
    WHITE.colour.all(nm)
}

/// Linear Rec.709 of tristimulus values that are 1 each for white.
pub fn rec709_of_white(xyz: [f64; 3]) -> [f64; 3] {
    let white = solved([0, 1, 2].map(|column| XYZ_TO_REC709.map(|row| row[column])), [1.0; 3]);
    turned(&XYZ_TO_REC709, std::array::from_fn(|k| white[k] * xyz[k]))
}

/// A matrix times a vector.
pub(crate) fn turned(matrix: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

/// The solution of three equations whose unknowns have the columns `a`, `b`, `c` (Cramer's rule); not finite where they have none.
pub(crate) fn solved([a, b, c]: [[f64; 3]; 3], right: [f64; 3]) -> [f64; 3] {
    let triple = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let all = triple(a, b, c);
    [triple(right, b, c) / all, triple(a, right, c) / all, triple(a, b, right) / all]
}
