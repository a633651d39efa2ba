//! The clear sky of Preetham, Shirley and Smits (SIGGRAPH 1999), for hosts that have it; Hošek and Wilkie's is truer to low suns.

use super::colour::to_rec709;

/// Perez's parameters of Y, x and y: factor of the turbidity, and constant.
const SHAPES: [[[f64; 2]; 5]; 3] = [
    [[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]],
    [[-0.0193, -0.2592], [-0.0665, 0.0008], [-0.0004, 0.2125], [-0.0641, -0.8989], [-0.0033, 0.0452]],
    [[-0.0167, -0.2608], [-0.0950, 0.0092], [-0.0079, 0.2102], [-0.0441, -1.6537], [-0.0109, 0.0529]],
];
/// Chromaticity of the zenith: rows by falling powers of the turbidity, columns by falling powers of the sun's zenith angle.
const ZENITH: [[[f64; 4]; 3]; 2] = [
    [[0.001_66, -0.003_75, 0.002_09, 0.0], [-0.029_03, 0.063_77, -0.032_02, 0.003_94], [0.116_93, -0.211_96, 0.060_52, 0.258_86]],
    [[0.002_75, -0.006_10, 0.003_17, 0.0], [-0.042_14, 0.089_70, -0.041_53, 0.005_16], [0.153_46, -0.267_56, 0.066_70, 0.266_88]],
];

/// The model for one sun and turbidity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preetham {
    shapes: [[f64; 5]; 3],
    /// Y in cd/m², x and y of the zenith over the shapes' values there.
    scales: [f64; 3],
}

impl Preetham {
    /// The sky under a sun `zenith_angle` radians from the zenith (to π/2), of a turbidity (2 to 10).
    pub fn new(zenith_angle: f64, turbidity: f64) -> Self {
        let shapes = SHAPES.map(|rows| rows.map(|[factor, constant]| factor * turbidity + constant));
        let angle = (4.0 / 9.0 - turbidity / 120.0) * (std::f64::consts::PI - 2.0 * zenith_angle);
        let luminance = 1000.0 * ((4.0453 * turbidity - 4.9710) * angle.tan() - 0.2155 * turbidity + 2.4192);
        let chromaticity = ZENITH.map(|rows| {
            let polynomial = |row: [f64; 4]| row.iter().fold(0.0, |sum, factor| sum * zenith_angle + factor);
            rows.iter().fold(0.0, |sum, row| sum * turbidity + polynomial(*row))
        });
        let values = [luminance, chromaticity[0], chromaticity[1]];
        Self { shapes, scales: std::array::from_fn(|i| values[i] / perez(&shapes[i], 1.0, zenith_angle)) }
    }

    /// Perez's parameters of Y, x and y.
    pub fn shapes(&self) -> [[f64; 5]; 3] {
        self.shapes
    }

    /// Y in cd/m², x and y of the zenith over the shapes' values there.
    pub fn scales(&self) -> [f64; 3] {
        self.scales
    }

    /// Radiance, linear Rec.709 in cd/m², towards a direction whose height above the horizon has a sine of `up` (above 0) and that is `angle` radians
    /// from the sun.
    pub fn radiance(&self, up: f64, angle: f64) -> [f64; 3] {
        let [luminance, x, y] = std::array::from_fn(|i| self.scales[i] * perez(&self.shapes[i], up, angle));
        if y <= 0.0 {
            return [0.0; 3];
        }
        to_rec709([x / y * luminance, luminance, (1.0 - x - y) / y * luminance]).map(|value| value.max(0.0))
    }
}

fn perez(&[a, b, c, d, e]: &[f64; 5], up: f64, angle: f64) -> f64 {
    (1.0 + a * (b / up).exp()) * (1.0 + c * (d * angle).exp() + e * angle.cos() * angle.cos())
}
