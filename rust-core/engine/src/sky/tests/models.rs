//! The models' formulas and coefficients.

use super::somewhere;
use crate::sky::{
    CieSky, Clearness, HosekWilkie, Irradiance, SkyModel, SunPosition, clear_sky_irradiance, diffuse_efficacy, direct_efficacy,
    relative_air_mass,
};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} was found, expected {expected} ± {tolerance}");
}

#[test]
fn general_skies_are_the_standard_s_formula() {
    // ISO 15469, table 1: a, b, c, d, e by type, written out a second time.
    let table = [
        [4.0, -0.70, 0.0, -1.0, 0.00],
        [4.0, -0.70, 2.0, -1.5, 0.15],
        [1.1, -0.80, 0.0, -1.0, 0.00],
        [1.1, -0.80, 2.0, -1.5, 0.15],
        [0.0, -1.00, 0.0, -1.0, 0.00],
        [0.0, -1.00, 2.0, -1.5, 0.15],
        [0.0, -1.00, 5.0, -2.5, 0.30],
        [0.0, -1.00, 10.0, -3.0, 0.45],
        [-1.0, -0.55, 2.0, -1.5, 0.15],
        [-1.0, -0.55, 5.0, -2.5, 0.30],
        [-1.0, -0.55, 10.0, -3.0, 0.45],
        [-1.0, -0.32, 10.0, -3.0, 0.45],
        [-1.0, -0.32, 16.0, -3.0, 0.30],
        [-1.0, -0.15, 16.0, -3.0, 0.30],
        [-1.0, -0.15, 24.0, -2.8, 0.15],
    ];
    for (kind, [a, b, c, d, e]) in (1u8..).zip(table) {
        let sun = 50f64.to_radians();
        let sky = CieSky::new(kind, sun).expect("a type");
        close(sky.relative_luminance(1.0, sun), 1.0, 1e-12);
        for (zenith, angle) in [(0.3, 0.2), (1.0, 1.3), (1.5, 2.5)] {
            let graded = |z: f64| 1.0 + a * f64::exp(b / z.cos());
            let scattered = |x: f64| 1.0 + c * ((d * x).exp() - (d * FRAC_PI_2).exp()) + e * x.cos().powi(2);
            let expected = graded(zenith) * scattered(angle) / (graded(0.0) * scattered(sun));
            close(sky.relative_luminance(f64::cos(zenith), angle), expected, 1e-12 * expected);
        }
    }
    assert!(CieSky::new(0, 0.0).is_none() && CieSky::new(17, 0.0).is_none());
}

#[test]
fn overcast_and_even_skies_have_their_closed_forms() {
    let mut day = somewhere();
    for (model, share) in [(SkyModel::Cie(16), 7.0 * PI / 9.0), (SkyModel::Cie(5), PI)] {
        day.model = model;
        let sky = day.sky().expect("a sky");
        close(sky.diffuse_lux / sky.zenith_luminance(), share, 1e-4);
        assert_eq!(sky.direct_lux, 0.0);
    }
    day.model = SkyModel::Cie(16);
    let sky = day.sky().expect("a sky");
    close(sky.luminance([0.0, FRAC_PI_4.cos(), FRAC_PI_4.sin()]) / sky.zenith_luminance(), (1.0 + 2.0 * FRAC_PI_4.sin()) / 3.0, 1e-12);
    close(sky.luminance([1.0, 0.0, 0.0]) / sky.zenith_luminance(), 1.0 / 3.0, 1e-12);
}

#[test]
fn hosek_and_wilkie_s_radiances_are_those_of_their_coefficients() {
    // Sun's elevation, turbidity, albedo, direction's angles from the zenith and from the sun; the authors' formula on their data, in W.
    let published = [
        ([30.0, 3.7, 0.25, 60.0, 20.0], [17.338907, 19.736769, 22.001371]),
        ([5.0, 2.0, 0.0, 85.0, 3.0], [30.248954, 20.979333, 8.916439]),
        ([80.0, 10.0, 1.0, 10.0, 5.0], [123.683397, 117.371357, 103.958332]),
        ([45.0, 1.0, 0.5, 0.0, 45.0], [1.945864, 4.142405, 9.484326]),
        ([0.0, 6.5, 0.8, 89.0, 170.0], [1.012704, 0.741673, 0.436882]),
    ];
    for ([elevation, turbidity, albedo, zenith, angle], expected) in published {
        let sky = HosekWilkie::new(elevation, turbidity, albedo).expect("a sky");
        let found = sky.radiance(f64::to_radians(zenith).cos(), f64::to_radians(angle));
        for (value, watts) in found.into_iter().zip(expected) {
            close(value, 683.0 * watts, 1e-6 * 683.0 * watts);
        }
    }
}

#[test]
fn efficacies_and_clear_skies_are_plausible() {
    let zenith = 40f64.to_radians();
    let irradiance = clear_sky_irradiance(50.0, 3.0, 1367.0, 1.0);
    assert!((700.0..950.0).contains(&irradiance.direct_normal), "{irradiance:?}");
    assert!((70.0..160.0).contains(&irradiance.diffuse_horizontal), "{irradiance:?}");
    let clearness = Clearness::new(&irradiance, zenith, relative_air_mass(50.0), 1367.0);
    assert!(clearness.class() >= 5, "{clearness:?}");
    assert!((95.0..115.0).contains(&direct_efficacy(&clearness, zenith, 11.0)));
    assert!((110.0..150.0).contains(&diffuse_efficacy(&clearness, zenith, 11.0)));
    let overcast = Clearness::new(&Irradiance { direct_normal: 0.0, diffuse_horizontal: 200.0 }, zenith, relative_air_mass(50.0), 1367.0);
    assert_eq!((overcast.clearness, overcast.class()), (1.0, 0));
    assert!((105.0..125.0).contains(&diffuse_efficacy(&overcast, zenith, 11.0)));
    close(relative_air_mass(90.0), 1.0, 1e-3);
    close(relative_air_mass(0.0), 38.0, 1.0);
}

#[test]
fn colours_leave_luminances_alone() {
    let mut day = somewhere();
    for model in [SkyModel::Perez, SkyModel::HosekWilkie, SkyModel::Cie(12), SkyModel::Cie(16)] {
        day.model = model;
        let sky = day.sky_under(SunPosition { azimuth_deg: 200.0, elevation_deg: 20.0 }).expect("a sky");
        for direction in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, -0.8, 0.6]] {
            let [r, g, b] = sky.radiance(direction);
            close(0.2126 * r + 0.7152 * g + 0.0722 * b, sky.luminance(direction), 1e-6 * sky.luminance(direction));
            assert_eq!(b > r * 1.05, model != SkyModel::Cie(16), "{model}: {r} {g} {b}");
        }
    }
}

#[test]
fn the_sun_reddens_towards_the_horizon() {
    let ratio = |elevation_deg| {
        let [r, _, b] = somewhere().sky_under(SunPosition { azimuth_deg: 0.0, elevation_deg }).expect("a sky").sun_irradiance();
        r / b
    };
    assert!(ratio(5.0) > ratio(20.0) && ratio(20.0) > ratio(60.0) && ratio(60.0) > 1.0);
}

#[test]
fn the_disc_is_as_bright_as_its_illuminance_says() {
    let sky = somewhere().sky_under(SunPosition { azimuth_deg: 0.0, elevation_deg: 60.0 }).expect("a sky");
    let solid_angle = PI * (0.5f64 * 0.533).to_radians().sin().powi(2);
    close(sky.sun_luminance() * solid_angle, sky.direct_lux, 1e-6 * sky.direct_lux);
    assert!((1.0e9..1.9e9).contains(&sky.sun_luminance()), "{}", sky.sun_luminance());
}
