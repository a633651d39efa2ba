//! The drawn sky against its inputs.

use super::somewhere;
use crate::scene::{Scene, TextureSource};
use crate::sky::{
    Clearness, Daylight, Frame, Irradiance, SkyImage, SkyModel, SunPosition, UpAxis, diffuse_efficacy, extraterrestrial_irradiance,
    relative_air_mass,
};
use std::f64::consts::PI;

fn luminance(pixel: &[f32]) -> f64 {
    0.2126 * f64::from(pixel[0]) + 0.7152 * f64::from(pixel[1]) + 0.0722 * f64::from(pixel[2])
}

/// Illuminance of a level surface by the pixels above the horizon, and the largest pixel below it.
fn horizontal(image: &SkyImage) -> (f64, f64) {
    let (mut sum, mut below) = (0.0, 0f64);
    for (row, pixels) in image.rgba.chunks_exact(4 * image.width as usize).enumerate() {
        let polar = PI * (row as f64 + 0.5) / f64::from(image.height);
        for pixel in pixels.chunks_exact(4) {
            if polar < PI / 2.0 {
                sum += luminance(pixel) * polar.sin() * polar.cos();
            } else {
                below = below.max(luminance(pixel));
            }
        }
    }
    (sum * PI / f64::from(image.height) * 2.0 * PI / f64::from(image.width), below)
}

#[test]
fn horizontal_illuminance_is_irradiance_times_efficacy() {
    let mut day = Daylight { is_coloured: false, ..somewhere() };
    let normal = extraterrestrial_irradiance(&day.moment);
    for elevation_deg in [3.0, 10.0, 25.0, 45.0, 70.0, 89.0] {
        let sun = SunPosition { azimuth_deg: 130.0, elevation_deg };
        let (zenith_angle, air_mass) = (sun.zenith_angle(), relative_air_mass(elevation_deg));
        for (class, clearness) in [1.0, 1.15, 1.4, 1.7, 2.3, 3.5, 5.5, 9.0].into_iter().enumerate() {
            for brightness in [0.05, 0.15, 0.3] {
                let diffuse_horizontal = brightness * normal / air_mass;
                let direct_normal = diffuse_horizontal * (clearness - 1.0) * (1.0 + 1.041 * zenith_angle.powi(3));
                if direct_normal > normal {
                    continue;
                }
                let irradiance = Irradiance { direct_normal, diffuse_horizontal };
                day.irradiance = Some(irradiance);
                let found = Clearness::new(&irradiance, zenith_angle, air_mass, normal);
                assert_eq!(found.class(), class);
                let expected = diffuse_horizontal * diffuse_efficacy(&found, zenith_angle, day.dew_point_c);
                for model in [SkyModel::Perez, SkyModel::Cie(12)] {
                    day.model = model;
                    let (drawn, below) = horizontal(&day.sky_under(sun).expect("a sky").image(128).expect("a picture"));
                    assert!((drawn / expected - 1.0).abs() < 0.01, "{model}, {elevation_deg}°, {found:?}: {drawn} lx, expected {expected}");
                    assert_eq!(below, 0.0);
                }
            }
        }
    }
}

#[test]
fn every_model_s_picture_has_its_zenith_and_its_sum() {
    let mut day = somewhere();
    for model in (1..=16).map(SkyModel::Cie).chain([SkyModel::HosekWilkie, SkyModel::Perez]) {
        day.model = model;
        let sky = day.sky_under(SunPosition { azimuth_deg: 250.0, elevation_deg: 35.0 }).expect("a sky");
        let image = sky.image(512).expect("a picture");
        let (found, _) = horizontal(&image);
        assert!((found / sky.diffuse_lux - 1.0).abs() < 5e-3, "{model}: {found} lx, expected {}", sky.diffuse_lux);
        let zenith = luminance(&image.rgba[..4]);
        assert!((zenith / sky.zenith_luminance() - 1.0).abs() < 0.02, "{model}: {zenith}, expected {}", sky.zenith_luminance());
    }
}

#[test]
fn where_perez_has_no_light_the_sky_has_what_was_measured() {
    let mut day = somewhere();
    day.model = SkyModel::Perez;
    day.irradiance = Some(Irradiance { direct_normal: 169.25, diffuse_horizontal: 63.9 });
    let sky = day.sky_under(SunPosition { azimuth_deg: 180.0, elevation_deg: 75.0 }).expect("a sky");
    let (found, _) = horizontal(&sky.image(512).expect("a picture"));
    assert!((found / sky.diffuse_lux - 1.0).abs() < 5e-3 && found > 5000.0, "{found} lx, expected {}", sky.diffuse_lux);
}

#[test]
fn the_brightest_pixel_lies_at_the_sun() {
    let mut day = somewhere();
    day.model = SkyModel::Cie(12);
    let sky = day.sky_under(SunPosition { azimuth_deg: 90.0, elevation_deg: 45.0 }).expect("a sky");
    let image = sky.image(128).expect("a picture");
    let brightest = (0..image.rgba.len() / 4).max_by(|a, b| luminance(&image.rgba[4 * a..]).total_cmp(&luminance(&image.rgba[4 * b..])));
    let (column, row) = (brightest.expect("pixels") as u32 % image.width, brightest.expect("pixels") as u32 / image.width);
    // East is a quarter of a turn left of south.
    assert!(column.abs_diff(64) <= 1 && row.abs_diff(32) <= 1, "column {column}, row {row}");
}

#[test]
fn the_ground_shows_where_it_reflects() {
    let mut day = somewhere();
    day.ground = 0.2;
    let sky = day.sky().expect("a sky");
    let (_, below) = horizontal(&sky.image(64).expect("a picture"));
    assert!((below * PI / (0.2 * sky.global_lux()) - 1.0).abs() < 1e-5);
}

#[test]
fn nothing_shines_at_night() {
    let mut day = somewhere();
    day.moment.hour = 0.0;
    let mut scene = Scene::default();
    let sky = day.add_to(&mut scene, &Frame::default(), 64).expect("a night");
    assert_eq!((sky.direct_lux, sky.diffuse_lux, scene.lights.len()), (0.0, 0.0, 1));
}

#[test]
fn lights_stand_as_the_frame_says() {
    let day = somewhere();
    let sun = day.sun().expect("a sun").direction();
    for (up_axis, north_deg) in [(UpAxis::Z, 0.0), (UpAxis::Y, 0.0), (UpAxis::Z, 90.0), (UpAxis::Y, 30.0)] {
        let (mut scene, frame) = (Scene::default(), Frame { up_axis, north_deg });
        day.add_to(&mut scene, &frame, 64).expect("daylight");
        assert_eq!(scene.lights.len(), 2);
        for light in &scene.lights {
            assert!((light.transform.determinant() - 1.0).abs() < 1e-12);
        }
        // The dome's axes: east, up, south.
        let dome = scene.lights[0].transform.vector([sun[0], sun[2], -sun[1]]);
        let disc = scene.lights[1].transform.vector([0.0, 0.0, 1.0]);
        assert!(dome.iter().zip(disc).all(|(a, b)| (a - b).abs() < 1e-12), "{dome:?} {disc:?}");
    }
    // A scene whose north lies 90° anticlockwise of true north: true north is its east.
    let north = Frame { up_axis: UpAxis::Z, north_deg: 90.0 }.to_scene([0.0, 1.0, 0.0]);
    assert!((north[0] - 1.0).abs() < 1e-12);
    assert!(Frame { up_axis: UpAxis::Y, north_deg: 0.0 }.to_scene([0.0, 1.0, 0.0])[2] < -0.999);
}

#[test]
fn the_same_daylight_gives_the_same_bits() {
    let picture = || {
        let mut scene = Scene::default();
        somewhere().add_to(&mut scene, &Frame::default(), 64).expect("daylight");
        scene.textures.remove(0).source
    };
    let (TextureSource::Pixels { rgba: first, .. }, TextureSource::Pixels { rgba: second, .. }) = (picture(), picture()) else {
        panic!("pixels were expected");
    };
    assert!(first.iter().zip(second.iter()).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert!(first.iter().all(|value| value.is_finite() && *value >= 0.0));
}
