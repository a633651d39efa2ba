//! Blender's Blackbody node: the colour of a glowing body, at a luminance near 1.

use crate::finite::all_finite;
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// The node, which has no settings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Blackbody;

/// Where the pieces after the first begin, in kelvin.
const STARTS: [f32; 6] = [965.0, 1_167.0, 1_449.0, 1_902.0, 3_315.0, 6_365.0];
/// Below the first and from the second on the colour stays.
const ENDS: [f32; 2] = [800.0, 12_000.0];
/// Linear Rec.709 below and above.
const COLD: [f32; 3] = [5.413_294_3, 0.0, 0.0];
/// See [`COLD`].
const HOT: [f32; 3] = [0.826_295_5, 0.994_508, 1.566_307_7];

/// Cycles's fit for red: pieces `a / T + b T + c`, each coefficient over all pieces.
const RED: [[f32; 32]; 3] = [
    pieces([1_619.191, 2_488.454_6, 3_341.432, 4_094.617_4, 4_670.280_3, 4_595.092, 3_787.174_6]),
    pieces([-2.050_109_2e-3, -1.113_309_1e-3, -4.865_512e-4, -1.274_465_8e-4, 2.912_582e-5, 2.874_956_4e-5, 9.359_078e-6]),
    pieces([5.029_958, 3.226_215_4, 1.764_867_7, 0.725_731_6, 0.126_703_44, 0.150_345_03, 0.399_075_87]),
];
/// The same for green.
const GREEN: [[f32; 32]; 3] = [
    pieces([-488.999_76, -755.994_26, -1_023.639_8, -1_265.713_1, -1_425.293_3, -1_175.548_2, -500.799_56]),
    pieces([6.043_307_4e-4, 3.167_301e-4, 1.202_234_7e-4, 4.873_409e-6, -4.011_504_3e-5, -2.163_780_5e-5, -4.598_32e-6]),
    pieces([-0.075_580_75, 0.478_306_14, 0.936_662_3, 1.270_545, 1.439_727_8, 1.304_080_2, 1.090_987_7]),
];
/// And for blue: cubics, highest power first.
const BLUE: [[f32; 32]; 4] = [
    pieces([5.969_453_4e-11, 2.404_303_7e-11, -1.409_497_35e-11, -3.614_608_6e-11, -1.970_757_4e-11, -1.619_979_5e-13, 6.726_503e-13]),
    pieces([-4.857_429e-8, 5.550_210_6e-8, 1.898_789_7e-7, 2.848_220_2e-7, 1.753_593_5e-7, -1.642_16e-8, -2.730_788e-8]),
    pieces([-9.706_223e-5, -1.985_037_1e-4, -3.566_328_4e-4, -4.932_113e-4, -2.505_428_3e-4, 3.862_162_7e-4, 4.240_982_5e-4]),
    pieces([-4.079_361_4e-3, 0.028_931_286, 0.091_076_78, 0.156_723_44, -0.022_278_327, -0.738_077_4, -0.752_335_67]),
];

/// Coefficients as [`Lanes::lookup32`] takes them.
const fn pieces(values: [f32; 7]) -> [f32; 32] {
    let mut all = [0.0; 32];
    let mut at = 0;
    while at < values.len() {
        all[at] = values[at];
        at += 1;
    }
    all
}

impl Blackbody {
    /// The inputs of [`evaluate`](Self::evaluate).
    pub const INPUTS: [&str; 1] = ["temperature"];
    /// How many outputs there are.
    pub const OUTPUTS: usize = 3;

    /// Red, green and blue in linear Rec.709, not negative.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 1]) -> [F<L>; 3] {
        let [t] = *inputs;
        let mut piece = l.u(0);
        for start in STARTS {
            piece = piece.count_if(t.ge(start));
        }
        let inverse = t.recip();
        let mut color = [l.f(0.0); 3];
        for (channel, [a, b, c]) in [&RED, &GREEN].into_iter().enumerate() {
            color[channel] = l.lookup32(a, piece) * inverse + l.lookup32(b, piece) * t + l.lookup32(c, piece);
        }
        let [a, b, c, d] = &BLUE;
        color[2] = ((l.lookup32(a, piece) * t + l.lookup32(b, piece)) * t + l.lookup32(c, piece)) * t + l.lookup32(d, piece);
        let (cold, hot) = (t.lt(ENDS[0]), t.ge(ENDS[1]));
        for (channel, value) in color.iter_mut().enumerate() {
            *value = cold.select(l.f(COLD[channel]), hot.select(l.f(HOT[channel]), *value));
            *value = value.keep_if(value.gt(0.0));
        }
        all_finite(color)
    }
}
