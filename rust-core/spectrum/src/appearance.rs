//! CIECAM02 and its uniform space CAM02-UCS, for the conditions of TM-30 and CIE 224: full adaptation, L_A = 100 cd/m², Y_b = 20, average surround.

/// CAT02: tristimulus values to its primaries, and back.
const CAT: [[f64; 3]; 3] = [[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]];
const CAT_INVERSE: [[f64; 3]; 3] = [
    [1.096_123_820_835_514, -0.278_869_000_218_287, 0.182_745_179_382_773],
    [0.454_369_041_975_359, 0.473_533_154_307_412, 0.072_097_803_717_229],
    [-0.009_627_608_738_429, -0.005_698_031_216_113, 1.015_325_639_954_543],
];
/// Hunt, Pointer and Estévez' cones.
const CONES: [[f64; 3]; 3] = [[0.38971, 0.68898, -0.07868], [-0.22981, 1.18340, 0.04641], [0.0, 0.0, 1.0]];

/// The adapting field's luminance, cd/m².
const ADAPTING: f64 = 100.0;
/// The background's luminance over the white's.
const BACKGROUND: f64 = 0.2;
/// The average surround: c and N_c.
const SURROUND: [f64; 2] = [0.69, 1.0];

/// An observer adapted to a white.
#[derive(Debug)]
pub(crate) struct Adapted {
    /// 100 over the white's primaries.
    gains: [f64; 3],
    /// F_L.
    level: f64,
    /// N_bb = N_cb.
    induction: f64,
    /// A_w.
    achromatic: f64,
}

/// A colour: its hue in degrees from 0 to 360, and J', a', b'.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Appearance {
    pub(crate) hue: f64,
    pub(crate) place: [f64; 3],
}

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

impl Adapted {
    /// To a white of tristimulus values, Y = 100.
    pub(crate) fn new(white: [f64; 3]) -> Self {
        let k = 1.0 / (5.0 * ADAPTING + 1.0);
        let level = 0.2 * k.powi(4) * 5.0 * ADAPTING + 0.1 * (1.0 - k.powi(4)).powi(2) * (5.0 * ADAPTING).cbrt();
        let gains = times(&CAT, white).map(|primary| 100.0 / primary);
        let mut adapted = Self { gains, level, induction: 0.725 * BACKGROUND.powf(-0.2), achromatic: 1.0 };
        adapted.achromatic = adapted.achromatic(adapted.responses(white));
        adapted
    }

    /// Compressed responses of the cones.
    fn responses(&self, xyz: [f64; 3]) -> [f64; 3] {
        let primaries = times(&CAT, xyz);
        let balanced = std::array::from_fn(|k| primaries[k] * self.gains[k]);
        times(&CONES, times(&CAT_INVERSE, balanced)).map(|cone| {
            let x = (self.level * cone.abs() / 100.0).powf(0.42);
            (400.0 * x / (x + 27.13)).copysign(cone) + 0.1
        })
    }

    fn achromatic(&self, [r, g, b]: [f64; 3]) -> f64 {
        (2.0 * r + g + b / 20.0 - 0.305) * self.induction
    }

    /// How a colour of tristimulus values looks.
    pub(crate) fn see(&self, xyz: [f64; 3]) -> Appearance {
        let [c, nc] = SURROUND;
        let [r, g, b] = self.responses(xyz);
        let [red, yellow] = [r - 12.0 * g / 11.0 + b / 11.0, (r + g - 2.0 * b) / 9.0];
        let hue = yellow.atan2(red);
        let z = 1.48 + BACKGROUND.sqrt();
        let lightness = 100.0 * (self.achromatic([r, g, b]) / self.achromatic).max(0.0).powf(c * z);
        let eccentricity = 0.25 * ((hue + 2.0).cos() + 3.8);
        let t = 50_000.0 / 13.0 * nc * self.induction * eccentricity * red.hypot(yellow) / (r + g + 1.05 * b);
        let chroma = t.max(0.0).powf(0.9) * (lightness / 100.0).sqrt() * (1.64 - 0.29_f64.powf(BACKGROUND)).powf(0.73);
        let colourfulness = (0.0228 * chroma * self.level.powf(0.25)).ln_1p() / 0.0228;
        Appearance {
            hue: hue.to_degrees().rem_euclid(360.0),
            place: [1.7 * lightness / (1.0 + 0.007 * lightness), colourfulness * hue.cos(), colourfulness * hue.sin()],
        }
    }
}
