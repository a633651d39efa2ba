//! Lumens in a watt of daylight (Perez, Ineichen, Seals, Michalsky and Stewart, Solar Energy 44, 1990, tables 4).

use super::Clearness;

/// Constant and factors of water, the sun's height and the sky's brightness, a row for each class of clearness.
const DIFFUSE: [[f64; 4]; 8] = [
    [97.24, -0.46, 12.00, -8.91],
    [107.22, 1.15, 0.59, -3.95],
    [104.97, 2.96, -5.53, -8.77],
    [102.39, 5.59, -13.95, -13.90],
    [100.71, 5.94, -22.75, -23.74],
    [106.42, 3.83, -36.15, -28.83],
    [141.88, 1.90, -53.24, -14.03],
    [152.23, 0.35, -45.27, -7.98],
];
const DIRECT: [[f64; 4]; 8] = [
    [57.20, -4.55, -2.98, 117.12],
    [98.99, -3.46, -1.21, 12.38],
    [109.83, -4.90, -1.71, -8.81],
    [110.34, -5.84, -1.99, -4.56],
    [106.36, -3.97, -1.75, -6.16],
    [107.19, -1.25, -1.51, -26.73],
    [105.75, 0.77, -1.26, -34.44],
    [101.18, 1.58, -1.10, -8.29],
];

/// Water in the air above, cm, from the dew point in °C.
fn precipitable_water(dew_point_c: f64) -> f64 {
    (0.07 * dew_point_c - 0.075).exp()
}

/// Efficacy of the sky's light on a level surface, lm/W. `zenith_angle` is the sun's, in radians.
pub fn diffuse_efficacy(clearness: &Clearness, zenith_angle: f64, dew_point_c: f64) -> f64 {
    let [constant, water, height, brightness] = DIFFUSE[clearness.class()];
    let value = constant
        + water * precipitable_water(dew_point_c)
        + height * zenith_angle.cos()
        + brightness * clearness.brightness.max(Clearness::LEAST_BRIGHTNESS).ln();
    value.max(0.0)
}

/// Efficacy of the sun's light, lm/W. `zenith_angle` is the sun's, in radians.
pub fn direct_efficacy(clearness: &Clearness, zenith_angle: f64, dew_point_c: f64) -> f64 {
    let [constant, water, height, brightness] = DIRECT[clearness.class()];
    let value =
        constant + water * precipitable_water(dew_point_c) + height * (5.73 * zenith_angle - 5.0).exp() + brightness * clearness.brightness;
    value.max(0.0)
}
