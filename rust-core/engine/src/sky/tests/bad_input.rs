//! What is out of its range is told by name.

use super::somewhere;
use crate::sky::{Daylight, HosekWilkie, Irradiance, SkyModel};

#[test]
fn numbers_out_of_range_are_named() {
    type Change = (&'static str, fn(&mut Daylight));
    let changes: [Change; 9] = [
        ("latitude", |day| day.place.latitude_deg = 90.1),
        ("longitude", |day| day.place.longitude_deg = f64::NAN),
        ("elevation", |day| day.place.elevation_m = f64::INFINITY),
        ("month", |day| day.moment.month = 0),
        ("hour", |day| day.moment.hour = -1.0),
        ("turbidity", |day| day.turbidity = 0.5),
        ("ground", |day| day.ground = 1.5),
        ("diffuse_horizontal", |day| day.irradiance = Some(Irradiance { direct_normal: 0.0, diffuse_horizontal: -1.0 })),
        ("direct_normal", |day| day.irradiance = Some(Irradiance { direct_normal: f64::NAN, diffuse_horizontal: 1.0 })),
    ];
    for (name, change) in changes {
        let mut day = somewhere();
        change(&mut day);
        let problem = day.sky().expect_err(name).to_string();
        assert!(problem.starts_with(name) && problem.contains("expected"), "{name}: {problem}");
    }
    assert!(HosekWilkie::new(-1.0, 3.0, 0.0).is_err());
    for rows in [0, 1, 3, 4098, u32::MAX] {
        assert!(somewhere().sky().expect("a sky").image(rows).is_err(), "{rows}");
    }
}

#[test]
fn skies_have_names() {
    for name in ["perez", "hosek-wilkie", "overcast", "clear", "cie1", "cie15"] {
        assert_eq!(SkyModel::parse(name).expect(name).to_string(), name);
    }
    assert_eq!(SkyModel::parse("cie16").expect("a type"), SkyModel::Cie(16));
    for name in ["", "cie", "cie0", "cie17", "cie-1", "Perez", "blue"] {
        assert!(SkyModel::parse(name).is_err(), "{name}");
    }
}

#[test]
fn no_weather_breaks_a_sky() {
    let mut day = somewhere();
    for direct_normal in [0.0, 1e-9, 10.0, 1400.0] {
        for diffuse_horizontal in [0.0, 1e-9, 5.0, 1400.0] {
            day.irradiance = Some(Irradiance { direct_normal, diffuse_horizontal });
            for elevation_deg in [1e-9, 0.1, 45.0, 90.0] {
                for model in [SkyModel::Perez, SkyModel::HosekWilkie, SkyModel::Cie(15)] {
                    day.model = model;
                    let sun = crate::sky::SunPosition { azimuth_deg: 0.0, elevation_deg };
                    let sky = day.sky_under(sun).expect("a sky");
                    let image = sky.image(16).expect("a picture");
                    let is_light = |value: &f32| value.is_finite() && *value >= 0.0;
                    assert!(image.rgba.iter().all(is_light), "{model} {direct_normal} {diffuse_horizontal} {elevation_deg}");
                    assert!(sky.direct_lux.is_finite() && sky.direct_lux >= 0.0);
                }
            }
        }
    }
}
