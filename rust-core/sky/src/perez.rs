//! The all-weather sky (Perez, Seals and Michalsky, Solar Energy 50, 1993, with the erratum in 51): luminances by two measured irradiances.

/// Upper bounds of the classes of clearness but the last.
const CLASSES: [f64; 7] = [1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200];
/// For each class the parameters a to e: constant, factor of the sun's zenith angle, and both again for the factor of the brightness.
const COEFFICIENTS: [[[f64; 4]; 5]; 8] = [
    [
        [1.3525, -0.2576, -0.2690, -1.4366],
        [-0.7670, 0.0007, 1.2734, -0.1233],
        [2.8000, 0.6004, 1.2375, 1.0000],
        [1.8734, 0.6297, 0.9738, 0.2809],
        [0.0356, -0.1246, -0.5718, 0.9938],
    ],
    [
        [-1.2219, -0.7730, 1.4148, 1.1016],
        [-0.2054, 0.0367, -3.9128, 0.9156],
        [6.9750, 0.1774, 6.4477, -0.1239],
        [-1.5798, -0.5081, -1.7812, 0.1080],
        [0.2624, 0.0672, -0.2190, -0.4285],
    ],
    [
        [-1.1000, -0.2515, 0.8952, 0.0156],
        [0.2782, -0.1812, -4.5000, 1.1766],
        [24.7219, -13.0812, -37.7000, 34.8438],
        [-5.0000, 1.5218, 3.9229, -2.6204],
        [-0.0156, 0.1597, 0.4199, -0.5562],
    ],
    [
        [-0.5484, -0.6654, -0.2672, 0.7117],
        [0.7234, -0.6219, -5.6812, 2.6297],
        [33.3389, -18.3000, -62.2500, 52.0781],
        [-3.5000, 0.0016, 1.1477, 0.1062],
        [0.4659, -0.3296, -0.0876, -0.0329],
    ],
    [
        [-0.6000, -0.3566, -2.5000, 2.3250],
        [0.2937, 0.0496, -5.6812, 1.8415],
        [21.0000, -4.7656, -21.5906, 7.2492],
        [-3.5000, -0.1554, 1.4062, 0.3988],
        [0.0032, 0.0766, -0.0656, -0.1294],
    ],
    [
        [-1.0156, -0.3670, 1.0078, 1.4051],
        [0.2875, -0.5328, -3.8500, 3.3750],
        [14.0000, -0.9999, -7.1406, 7.5469],
        [-3.4000, -0.1078, -1.0750, 1.5702],
        [-0.0672, 0.4016, 0.3017, -0.4844],
    ],
    [
        [-1.0000, 0.0211, 0.5025, -0.5119],
        [-0.3000, 0.1922, 0.7023, -1.6317],
        [19.0000, -5.0000, 1.2438, -1.9094],
        [-4.0000, 0.0250, 0.3844, 0.2656],
        [1.0468, -0.3788, -2.4517, 1.4656],
    ],
    [
        [-1.0500, 0.0289, 0.4260, 0.3590],
        [-0.3250, 0.1156, 0.7781, 0.0025],
        [31.0625, -14.5000, -46.1148, 55.3750],
        [-7.2312, 0.4050, 13.3500, 0.6234],
        [1.5000, -0.6426, 1.8564, 0.5636],
    ],
];

/// What the sun and the sky bring to the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Irradiance {
    /// From the sun's disc on a surface that faces it, W/m².
    pub direct_normal: f64,
    /// From the sky without the disc on a level surface, W/m².
    pub diffuse_horizontal: f64,
}

/// How clear and how bright a sky is, after Perez.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearness {
    /// ε: 1 under clouds, 12 in the clearest air.
    pub clearness: f64,
    /// Δ: the diffuse light that an overhead sun would make, over the light outside the atmosphere.
    pub brightness: f64,
}

impl Clearness {
    /// Darker skies are not told apart.
    pub const LEAST_BRIGHTNESS: f64 = 0.01;

    /// Of irradiances under a sun `zenith_angle` radians from the zenith; `air_mass` is the relative one, `normal` the irradiance outside the
    /// atmosphere in W/m².
    pub fn new(irradiance: &Irradiance, zenith_angle: f64, air_mass: f64, normal: f64) -> Self {
        let curve = 1.041 * zenith_angle.powi(3);
        let diffuse = irradiance.diffuse_horizontal.max(1e-6);
        let clearness = ((diffuse + irradiance.direct_normal) / diffuse + curve) / (1.0 + curve);
        Self { clearness: clearness.clamp(1.0, 12.0), brightness: (diffuse * air_mass / normal).clamp(Self::LEAST_BRIGHTNESS, 0.6) }
    }

    /// The class of clearness, 0 (overcast) to 7 (clear).
    pub fn class(&self) -> usize {
        CLASSES.iter().filter(|bound| self.clearness >= **bound).count()
    }
}

/// Perez's spread of luminance over a sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerezSky {
    parameters: [f64; 5],
}

impl PerezSky {
    /// The sky of a clearness under a sun `zenith_angle` radians from the zenith.
    pub fn new(clearness: &Clearness, zenith_angle: f64) -> Self {
        let Self { mut parameters } = Self::unlimited(clearness, zenith_angle);
        // Weather that no sky has would make the horizon or the sun's far side brighter without end.
        parameters[1] = parameters[1].min(0.0);
        parameters[3] = parameters[3].min(0.0);
        Self { parameters }
    }

    /// The same with the parameters as the paper's tables give them, whatever the weather (as Radiance's gendaymtx has them).
    pub fn unlimited(clearness: &Clearness, zenith_angle: f64) -> Self {
        let class = clearness.class();
        // The model is not meant for dark skies of middling clearness, where its luminances would turn negative (as Radiance's gendaylit does).
        let is_middling = clearness.clearness > CLASSES[0] && clearness.clearness < CLASSES[4];
        let delta = if is_middling { clearness.brightness.max(0.2) } else { clearness.brightness };
        let rows = COEFFICIENTS[class];
        let mut parameters = rows.map(|[x1, x2, x3, x4]| x1 + x2 * zenith_angle + delta * (x3 + x4 * zenith_angle));
        if class == 0 {
            let [[c1, c2, c3, c4], [d1, d2, d3, d4]] = [rows[2], rows[3]];
            parameters[2] = (delta * (c1 + c2 * zenith_angle)).powf(c3).exp() - c4;
            parameters[3] = d3 + delta * d4 - (delta * (d1 + d2 * zenith_angle)).exp();
        }
        Self { parameters }
    }

    /// Luminance in units of its own, towards a direction whose height above the horizon has a sine of `up` (0 to 1) and that is `angle` radians
    /// from the sun.
    pub fn relative_luminance(&self, up: f64, angle: f64) -> f64 {
        (self.gradation(up.max(0.01)) * self.indicatrix(angle)).max(0.0)
    }

    /// The factor of height above the horizon, whose sine is `up` (above 0).
    pub fn gradation(&self, up: f64) -> f64 {
        let [a, b, ..] = self.parameters;
        1.0 + a * (b / up).exp()
    }

    /// The factor of the angle from the sun in radians.
    pub fn indicatrix(&self, angle: f64) -> f64 {
        let [.., c, d, e] = self.parameters;
        1.0 + c * (d * angle).exp() + e * angle.cos() * angle.cos()
    }
}
