//! Blender's Wavelength node: the colour of light of one wavelength.

use crate::finite::all_finite;
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// Which white the matrix to Rec.709 has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum RgbWhite {
    /// As Blender up to 4.5: from D65 by its tristimulus values.
    Tristimulus,
    /// As Blender from 5.0 on: from D65 by its chromaticities.
    Chromaticity,
}

/// The node's settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Wavelength {
    /// Which matrix; they differ by some 10^-4.
    pub white: RgbWhite,
}

/// Where the curves begin, and how many values there are to a nanometre.
const START: f32 = 380.0;
const PER_NANOMETRE: f32 = 1.0 / 5.0;
/// The curves of the CIE 1931 observer from 380 nm to 780 nm in steps of 5 nm, to four places, each item filled up to four.
const OBSERVER: [f32; 324] = [
    0.0014, 0.0, 0.0065, 0.0, 0.0022, 0.0001, 0.0105, 0.0, 0.0042, 0.0001, 0.0201, 0.0, 0.0076, 0.0002, 0.0362, 0.0, 0.0143, 0.0004,
    0.0679, 0.0, 0.0232, 0.0006, 0.1102, 0.0, 0.0435, 0.0012, 0.2074, 0.0, 0.0776, 0.0022, 0.3713, 0.0, 0.1344, 0.004, 0.6456, 0.0, 0.2148,
    0.0073, 1.0391, 0.0, 0.2839, 0.0116, 1.3856, 0.0, 0.3285, 0.0168, 1.623, 0.0, 0.3483, 0.023, 1.7471, 0.0, 0.3481, 0.0298, 1.7826, 0.0,
    0.3362, 0.038, 1.7721, 0.0, 0.3187, 0.048, 1.7441, 0.0, 0.2908, 0.06, 1.6692, 0.0, 0.2511, 0.0739, 1.5281, 0.0, 0.1954, 0.091, 1.2876,
    0.0, 0.1421, 0.1126, 1.0419, 0.0, 0.0956, 0.139, 0.813, 0.0, 0.058, 0.1693, 0.6162, 0.0, 0.032, 0.208, 0.4652, 0.0, 0.0147, 0.2586,
    0.3533, 0.0, 0.0049, 0.323, 0.272, 0.0, 0.0024, 0.4073, 0.2123, 0.0, 0.0093, 0.503, 0.1582, 0.0, 0.0291, 0.6082, 0.1117, 0.0, 0.0633,
    0.71, 0.0782, 0.0, 0.1096, 0.7932, 0.0573, 0.0, 0.1655, 0.862, 0.0422, 0.0, 0.2257, 0.9149, 0.0298, 0.0, 0.2904, 0.954, 0.0203, 0.0,
    0.3597, 0.9803, 0.0134, 0.0, 0.4334, 0.995, 0.0087, 0.0, 0.5121, 1.0, 0.0057, 0.0, 0.5945, 0.995, 0.0039, 0.0, 0.6784, 0.9786, 0.0027,
    0.0, 0.7621, 0.952, 0.0021, 0.0, 0.8425, 0.9154, 0.0018, 0.0, 0.9163, 0.87, 0.0017, 0.0, 0.9786, 0.8163, 0.0014, 0.0, 1.0263, 0.757,
    0.0011, 0.0, 1.0567, 0.6949, 0.001, 0.0, 1.0622, 0.631, 0.0008, 0.0, 1.0456, 0.5668, 0.0006, 0.0, 1.0026, 0.503, 0.0003, 0.0, 0.9384,
    0.4412, 0.0002, 0.0, 0.8544, 0.381, 0.0002, 0.0, 0.7514, 0.321, 0.0001, 0.0, 0.6424, 0.265, 0.0, 0.0, 0.5419, 0.217, 0.0, 0.0, 0.4479,
    0.175, 0.0, 0.0, 0.3608, 0.1382, 0.0, 0.0, 0.2835, 0.107, 0.0, 0.0, 0.2187, 0.0816, 0.0, 0.0, 0.1649, 0.061, 0.0, 0.0, 0.1212, 0.0446,
    0.0, 0.0, 0.0874, 0.032, 0.0, 0.0, 0.0636, 0.0232, 0.0, 0.0, 0.0468, 0.017, 0.0, 0.0, 0.0329, 0.0119, 0.0, 0.0, 0.0227, 0.0082, 0.0,
    0.0, 0.0158, 0.0057, 0.0, 0.0, 0.0114, 0.0041, 0.0, 0.0, 0.0081, 0.0029, 0.0, 0.0, 0.0058, 0.0021, 0.0, 0.0, 0.0041, 0.0015, 0.0, 0.0,
    0.0029, 0.001, 0.0, 0.0, 0.002, 0.0007, 0.0, 0.0, 0.0014, 0.0005, 0.0, 0.0, 0.001, 0.0004, 0.0, 0.0, 0.0007, 0.0002, 0.0, 0.0, 0.0005,
    0.0002, 0.0, 0.0, 0.0003, 0.0001, 0.0, 0.0, 0.0002, 0.0001, 0.0, 0.0, 0.0002, 0.0001, 0.0, 0.0, 0.0001, 0.0, 0.0, 0.0, 0.0001, 0.0,
    0.0, 0.0, 0.0001, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
];

/// What the greatest component would be, so that none is beyond 1.
const BRIGHTEST: f32 = 2.52;

impl RgbWhite {
    /// Rows of the matrix from XYZ.
    #[inline]
    fn matrix(self) -> [[f32; 3]; 3] {
        match self {
            Self::Tristimulus => [
                [3.240_437_5, -1.537_130_5, -0.498_528_8],
                [-0.969_267_5, 1.876_013_8, 0.041_556_08],
                [0.055_643_447, -0.204_025_97, 1.057_225_5],
            ],
            Self::Chromaticity => [
                [3.240_97, -1.537_383_2, -0.498_610_76],
                [-0.969_243_65, 1.875_967_5, 0.041_555_06],
                [0.055_630_08, -0.203_976_96, 1.056_971_5],
            ],
        }
    }
}

impl Wavelength {
    /// The inputs of [`evaluate`](Self::evaluate): nanometres.
    pub const INPUTS: [&str; 1] = ["wavelength"];
    /// How many outputs there are.
    pub const OUTPUTS: usize = 3;

    /// Red, green and blue in linear Rec.709, not negative; black outside 375 nm to 780 nm.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 1]) -> [F<L>; 3] {
        let at = (inputs[0] - START) * PER_NANOMETRE;
        // Truncated, so that the first step reaches one below the start.
        let visible = at.gt(-1.0) & at.lt(80.0);
        let at = at.keep_if(visible);
        let item = at.to_i32();
        let between = at - item.i32_to_float();
        let [low, high] = [l.gather_quads(&OBSERVER, item << 2), l.gather_quads(&OBSERVER, (item + 1) << 2)];
        let mut color = [l.f(0.0); 3];
        for (value, row) in color.iter_mut().zip(self.white.matrix()) {
            for ((low, high), weight) in low.into_iter().zip(high).zip(row) {
                *value += low.lerp(high, between) * weight;
            }
            *value *= 1.0 / BRIGHTEST;
            *value = value.keep_if(value.gt(0.0) & visible);
        }
        all_finite(color)
    }
}
