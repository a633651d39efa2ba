//! The CIE standard general skies (ISO 15469:2004, CIE S 011): how luminance is spread over the sky.

/// Types of the standard: 1 to 15 are the general skies, 16 the traditional overcast sky.
pub const CIE_TYPES: std::ops::RangeInclusive<u8> = 1..=16;

/// Gradation from the zenith to the horizon, groups I to VI: a, b.
const GRADATION: [[f64; 2]; 6] = [[4.0, -0.70], [1.1, -0.8], [0.0, -1.0], [-1.0, -0.55], [-1.0, -0.32], [-1.0, -0.15]];
/// Indicatrix about the sun, groups 1 to 6: c, d, e.
const INDICATRIX: [[f64; 3]; 6] =
    [[0.0, -1.0, 0.0], [2.0, -1.5, 0.15], [5.0, -2.5, 0.30], [10.0, -3.0, 0.45], [16.0, -3.0, 0.30], [24.0, -2.8, 0.15]];
/// Groups of gradation and indicatrix of the types 1 to 15, from zero.
const GROUPS: [[usize; 2]; 15] =
    [[0, 0], [0, 1], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [2, 3], [3, 1], [3, 2], [3, 3], [4, 3], [4, 4], [5, 4], [5, 5]];

/// One of the standard's skies under a sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CieSky {
    /// 1 to 16.
    kind: u8,
    /// Of the sun, radians.
    zenith_angle: f64,
}

impl CieSky {
    /// A sky of a type, with the sun at an angle from the zenith in radians; `None` if there is no such type.
    pub fn new(kind: u8, zenith_angle: f64) -> Option<Self> {
        CIE_TYPES.contains(&kind).then_some(Self { kind, zenith_angle })
    }

    /// The standard overcast, intermediate or clear sky (types 1, 7 and 12), by Perez' clearness.
    pub fn of_clearness(clearness: f64, zenith_angle: f64) -> Self {
        let kind = match clearness {
            ..1.23 => 1,
            ..2.8 => 7,
            _ => 12,
        };
        Self { kind, zenith_angle }
    }

    /// Luminance over that of the zenith, towards a direction whose height above the horizon has a sine of `up` (0 to 1) and that is `angle`
    /// radians from the sun.
    pub fn relative_luminance(&self, up: f64, angle: f64) -> f64 {
        let Some([gradation, indicatrix]) = GROUPS.get(usize::from(self.kind) - 1) else {
            // The traditional overcast sky, by Moon and Spencer.
            return (1.0 + 2.0 * up) / 3.0;
        };
        let [a, b] = GRADATION[*gradation];
        let graded = |sine: f64| 1.0 + a * (b / sine.max(1e-6)).exp();
        let [c, d, e] = INDICATRIX[*indicatrix];
        let scattered =
            |angle: f64| 1.0 + c * ((d * angle).exp() - (d * std::f64::consts::FRAC_PI_2).exp()) + e * angle.cos() * angle.cos();
        graded(up) * scattered(angle) / (graded(1.0) * scattered(self.zenith_angle))
    }
}
