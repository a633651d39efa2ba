//! Gamuts: the chromaticities of primaries and white, and the way from each to linear Rec.709.

use super::matrix::{Matrix3, apply, inverse, product};

/// CIE 1931 xy chromaticities of three primaries and of the white point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Primaries {
    /// Red.
    pub red: [f64; 2],
    /// Green.
    pub green: [f64; 2],
    /// Blue.
    pub blue: [f64; 2],
    /// White: equal parts of the three.
    pub white: [f64; 2],
}

/// The gamuts that have names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gamut {
    /// ITU-R BT.709, also sRGB's.
    Rec709,
    /// ITU-R BT.2020.
    Rec2020,
    /// Display P3: the P3 primaries with a D65 white.
    DisplayP3,
    /// Adobe RGB (1998).
    AdobeRgb,
    /// ACES AP1, the gamut of ACEScg.
    Ap1,
    /// ACES AP0, the gamut of ACES2065-1.
    Ap0,
    /// CIE XYZ in which white is D65.
    XyzD65,
    /// CIE XYZ in which white is the equal-energy illuminant.
    XyzE,
}

const D65: [f64; 2] = [0.3127, 0.3290];
const ACES_WHITE: [f64; 2] = [0.32168, 0.33767];
const REC709: Primaries = Primaries { red: [0.64, 0.33], green: [0.30, 0.60], blue: [0.15, 0.06], white: D65 };

/// The cone responses in which white points are scaled (Lam 1985, the Bradford transform).
const BRADFORD: Matrix3 = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

impl Primaries {
    /// The matrix from linear RGB to XYZ with Y = 1 for white; nothing where the primaries lie on a line.
    pub fn to_xyz(&self) -> Option<Matrix3> {
        let [r, g, b] = [self.red, self.green, self.blue].map(|[x, y]| [x, y, 1.0 - x - y]);
        let unscaled = [[r[0], g[0], b[0]], [r[1], g[1], b[1]], [r[2], g[2], b[2]]];
        let scale = apply(&inverse(&unscaled)?, white_xyz(self.white)?);
        Some(unscaled.map(|row| [row[0] * scale[0], row[1] * scale[1], row[2] * scale[2]]))
    }

    /// The matrix from linear RGB of these primaries to linear Rec.709, white to white by the Bradford transform; nothing where the
    /// primaries span no gamut.
    pub fn to_rec709(&self) -> Option<Matrix3> {
        let adapted = product(&adaptation(self.white, D65)?, &self.to_xyz()?);
        let matrix = product(&inverse(&REC709.to_xyz()?)?, &adapted);
        matrix.iter().flatten().all(|x| x.is_finite()).then_some(matrix)
    }

    /// Whether all chromaticities are those of Rec.709 within what files round to.
    pub fn is_rec709(&self) -> bool {
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 2e-3 && (a[1] - b[1]).abs() < 2e-3;
        near(self.red, REC709.red) && near(self.green, REC709.green) && near(self.blue, REC709.blue) && near(self.white, REC709.white)
    }
}

impl Gamut {
    /// The chromaticities.
    pub fn primaries(self) -> Primaries {
        let p = |red, green, blue, white| Primaries { red, green, blue, white };
        match self {
            Self::Rec709 => REC709,
            Self::Rec2020 => p([0.708, 0.292], [0.170, 0.797], [0.131, 0.046], D65),
            Self::DisplayP3 => p([0.680, 0.320], [0.265, 0.690], [0.150, 0.060], D65),
            Self::AdobeRgb => p([0.64, 0.33], [0.21, 0.71], [0.15, 0.06], D65),
            Self::Ap1 => p([0.713, 0.293], [0.165, 0.830], [0.128, 0.044], ACES_WHITE),
            Self::Ap0 => p([0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.0770], ACES_WHITE),
            Self::XyzD65 | Self::XyzE => p([1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0]),
        }
    }

    /// The matrix from linear RGB of the gamut to linear Rec.709; nothing for Rec.709 itself.
    pub fn to_rec709(self) -> Option<Matrix3> {
        match self {
            Self::Rec709 => None,
            // XYZ values whose white is D65 already need no adaptation.
            Self::XyzD65 => inverse(&REC709.to_xyz()?),
            other => other.primaries().to_rec709(),
        }
    }
}

/// The matrix from the connection space of ICC profiles, XYZ under D50 (ICC.1:2022, 6.3.4.3), to linear Rec.709.
pub(super) fn xyz_d50_to_rec709() -> Option<Matrix3> {
    const WHITE: [f64; 3] = [0.9642, 1.0, 0.8249];
    let sum: f64 = WHITE.iter().sum();
    let adapted = adaptation([WHITE[0] / sum, WHITE[1] / sum], D65)?;
    Some(product(&inverse(&REC709.to_xyz()?)?, &adapted))
}

/// XYZ of a white point with Y = 1.
fn white_xyz([x, y]: [f64; 2]) -> Option<[f64; 3]> {
    (y.is_finite() && y.abs() > 1e-6).then(|| [x / y, 1.0, (1.0 - x - y) / y])
}

/// The matrix that takes XYZ under one white to XYZ under another.
fn adaptation(from: [f64; 2], to: [f64; 2]) -> Option<Matrix3> {
    let (source, target) = (apply(&BRADFORD, white_xyz(from)?), apply(&BRADFORD, white_xyz(to)?));
    let mut scaled = BRADFORD;
    for (row, (s, t)) in scaled.iter_mut().zip(source.into_iter().zip(target)) {
        *row = row.map(|x| x * t / s);
    }
    Some(product(&inverse(&BRADFORD)?, &scaled))
}
