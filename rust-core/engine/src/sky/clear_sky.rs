//! What comes through a cloudless atmosphere: the ESRA model (Rigollier, Bauer and Wald, Solar Energy 68, 2000) by Linke's turbidity.

use super::{Irradiance, Moment};

/// Irradiance outside the atmosphere at the mean distance, W/m².
const SOLAR_CONSTANT: f64 = 1367.0;

/// Normal irradiance outside the atmosphere on the moment's day, W/m² (Spencer 1971).
pub fn extraterrestrial_irradiance(moment: &Moment) -> f64 {
    let angle = std::f64::consts::TAU * (f64::from(moment.day_of_year()) - 1.0) / 365.0;
    let (sin, cos) = angle.sin_cos();
    let (sin_twice, cos_twice) = (2.0 * angle).sin_cos();
    SOLAR_CONSTANT * (1.000_110 + 0.034_221 * cos + 0.001_280 * sin + 0.000_719 * cos_twice + 0.000_077 * sin_twice)
}

/// Air that a ray crosses at an apparent elevation, 1 at the zenith at sea level (Kasten and Young 1989).
pub fn relative_air_mass(elevation_deg: f64) -> f64 {
    let elevation = elevation_deg.max(0.0);
    1.0 / (elevation.to_radians().sin() + 0.505_72 * (elevation + 6.079_95).powf(-1.6364))
}

/// Irradiance under a cloudless sky.
///
/// `turbidity` is Linke's: 1 is clean and dry air, 3 usual in the country, 5 in cities. `normal` is the irradiance outside the atmosphere in W/m²,
/// `pressure_ratio` the place's pressure over that at the sea.
pub fn clear_sky_irradiance(elevation_deg: f64, turbidity: f64, normal: f64, pressure_ratio: f64) -> Irradiance {
    if elevation_deg <= 0.0 {
        return Irradiance::default();
    }
    let mass = relative_air_mass(elevation_deg) * pressure_ratio;
    let direct_normal = normal * (-0.8662 * turbidity * mass * rayleigh_thickness(mass)).exp();
    let at_zenith = (-1.5843e-2 + 3.0543e-2 * turbidity + 3.797e-4 * turbidity * turbidity).max(0.0);
    Irradiance { direct_normal, diffuse_horizontal: normal * at_zenith * diffuse_by_height(elevation_deg, turbidity, at_zenith) }
}

/// Optical thickness of clean, dry air, by the air mass (Kasten 1996).
fn rayleigh_thickness(mass: f64) -> f64 {
    let m = mass;
    if m > 20.0 { 1.0 / (10.4 + 0.718 * m) } else { 1.0 / (6.6296 + m * (1.7513 + m * (-0.1202 + m * (0.0065 - 0.000_13 * m)))) }
}

/// How the diffuse irradiance depends on the sun's height.
fn diffuse_by_height(elevation_deg: f64, turbidity: f64, at_zenith: f64) -> f64 {
    let (t, sine) = (turbidity, elevation_deg.to_radians().sin());
    let level = 2.6463e-1 + t * (-6.1581e-2 + 3.1408e-3 * t);
    let level = if level * at_zenith < 2e-3 { 2e-3 / at_zenith.max(1e-6) } else { level };
    let linear = 2.0402 + t * (1.8945e-2 - 1.1161e-2 * t);
    let square = -1.3025 + t * (3.9231e-2 + 8.5079e-3 * t);
    (level + sine * (linear + sine * square)).max(0.0)
}
