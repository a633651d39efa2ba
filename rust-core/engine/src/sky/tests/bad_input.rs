//! What is out of its range is told by name.

use super::somewhere;
use crate::sky::{Daylight, HosekWilkie, Irradiance, Moment, Place, SkyModel};
use gonio_formats::weather::{Hour, Weather};

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
fn weather_of_elsewhere_and_of_another_clock_is_doubted() {
    let vienna = Place { latitude_deg: 48.21, longitude_deg: 16.37, elevation_m: 190.0 };
    let noon = Moment::parse("2025-06-21T12:00+01:00").expect("a moment");
    let station = |latitude_deg, longitude_deg| {
        let record = Hour { year: None, month: 6, day: 21, hour: 12.5, direct_normal: 700.0, diffuse_horizontal: 100.0, dew_point_c: None };
        Weather { place: "Station".into(), latitude_deg, longitude_deg, utc_offset_h: 1.0, hours: vec![record], ..Weather::default() }
    };
    let doubts = |place: Place, weather: &Weather, moment: Moment| {
        let mut day = Daylight::new(place, moment);
        day.take_weather(weather).expect("an hour");
        day.doubts_about(weather).expect("a sun")
    };
    assert_eq!(doubts(vienna, &station(48.12, 16.57), noon), Vec::<String>::new());
    let berlin = doubts(vienna, &station(52.47, 13.40), noon);
    // The great circle between the two is 518 km long.
    assert!(berlin.len() == 1 && berlin[0].contains("Station at 52.47, 13.40, 518 km"), "{berlin:?}");
    let mirrored = doubts(Place { longitude_deg: -16.37, ..vienna }, &station(48.12, 16.57), noon);
    assert!(mirrored[0].ends_with("north and east are positive") && mirrored.len() == 1, "{mirrored:?}");
    // A file whose clock is twelve hours off.
    let mut other = station(48.12, 16.57);
    other.utc_offset_h = -11.0;
    let night = doubts(vienna, &other, Moment::parse("2025-06-22T00:30+01:00").expect("a moment"));
    assert!(night.len() == 1 && night[0].contains("700 W/m² of sun") && night[0].contains("below the horizon"), "{night:?}");
    let mut day = Daylight::new(vienna, Moment::parse("2025-06-21T18:00+01:00").expect("a moment"));
    let missing = day.take_weather(&station(48.12, 16.57)).expect_err("no record").to_string();
    assert!(missing.contains("within an hour of 18:00 on the 21.6."), "{missing}");
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
