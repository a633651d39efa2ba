//! Skies of a spherical atmosphere, and Preetham's.

use crate::sky::{Atmosphere, Preetham, Scattering, SkyImage};

const CLEAR: Atmosphere = Atmosphere { scattering: Scattering::Single, altitude_m: 0.0, air: 1.0, dust: 1.0, ozone: 1.0 };

fn pixel(image: &SkyImage, column: usize, row: usize) -> [f32; 3] {
    let at = 4 * (row * image.width as usize + column);
    [image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]]
}

#[test]
fn skies_are_blue_above_and_red_beside_a_low_sun() {
    for scattering in [Scattering::Single, Scattering::Multiple] {
        let image = |elevation| Atmosphere { scattering, ..CLEAR }.image(elevation, 64).expect("a sky");
        let [r, _, b] = pixel(&image(50.0), 96, 2);
        assert!(b > 2.0 * r, "{r} {b}");
        // The sun stands in the east, a quarter of a turn left of the middle.
        let low = image(2.0);
        let [r, _, b] = pixel(&low, 32, 30);
        assert!(r > 1.3 * b, "{r} {b}");
        assert!(pixel(&low, 32, 30)[1] > 3.0 * pixel(&low, 96, 30)[1]);
        // Both sides of the sun are the same.
        let [left, right] = [pixel(&low, 20, 20), pixel(&low, 43, 20)];
        assert!(left.iter().zip(right).all(|(a, b)| (a - b).abs() <= 1e-5 * a), "{left:?} {right:?}");
    }
}

#[test]
fn without_air_nothing_is_scattered_and_the_disc_has_the_sun_s_irradiance() {
    let space = Atmosphere { air: 0.0, dust: 0.0, ozone: 0.0, ..CLEAR };
    assert!(space.image(30.0, 16).expect("a sky").rgba.chunks_exact(4).all(|pixel| pixel[..3] == [0.0; 3]));
    let [r, g, b] = space.sun_irradiance(30.0, 0.545).expect("a sun");
    // 683 lm/W of it are the 133 klx of the CIE's solar illuminance.
    let lux = 683.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b);
    assert!((125_000.0..140_000.0).contains(&lux), "{lux}");
}

#[test]
fn the_sun_under_the_horizon_leaves_little() {
    for scattering in [Scattering::Single, Scattering::Multiple] {
        let atmosphere = Atmosphere { scattering, ..CLEAR };
        let night = atmosphere.image(-30.0, 16).expect("a sky");
        assert!(night.rgba.chunks_exact(4).all(|pixel| pixel[..3].iter().all(|x| (0.0..1.0).contains(x))));
    }
    assert!(CLEAR.image(f64::NAN, 16).is_err());
    assert!(Atmosphere { dust: -1.0, ..CLEAR }.image(10.0, 16).is_err());
    assert!(Atmosphere { altitude_m: 1e9, ..CLEAR }.image(10.0, 16).is_err());
}

#[test]
fn tables_agree_with_pictures_and_are_mirrored() {
    for scattering in [Scattering::Single, Scattering::SingleInPieces, Scattering::Multiple] {
        let atmosphere = Atmosphere { scattering, ..CLEAR };
        let table = atmosphere.table(40.0).expect("a table");
        assert_eq!((table.width, table.height), (512, 256));
        let [left, right] = [pixel(&table, 100, 60), pixel(&table, 411, 60)];
        assert_eq!(left, right);
        // The zenith's luminance, in the picture's upper row and the table's, which is 1.4 degrees nearer to the sun.
        let [_, y, _] = pixel(&table, 256, 0);
        let [r, g, b] = pixel(&atmosphere.image(40.0, 512).expect("a picture"), 0, 0);
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        assert!((y / luminance - 1.0).abs() < 0.05, "{scattering:?}: {y} {luminance}");
        let [foot, top] = atmosphere.sun_limbs(40.0, 0.5).expect("a sun");
        assert!(foot[1] < top[1] && foot[1] > 0.99 * top[1]);
    }
}

#[test]
fn preetham_s_zenith_is_the_paper_s() {
    // Formula A.2 for a turbidity of 3 and a sun 30° from the zenith.
    let (turbidity, zenith_angle) = (3.0f64, 30f64.to_radians());
    let angle = (4.0 / 9.0 - turbidity / 120.0) * (std::f64::consts::PI - 2.0 * zenith_angle);
    let expected = 1000.0 * ((4.0453 * turbidity - 4.9710) * angle.tan() - 0.2155 * turbidity + 2.4192);
    let [r, g, b] = Preetham::new(zenith_angle, turbidity).radiance(1.0, zenith_angle);
    assert!((0.2126 * r + 0.7152 * g + 0.0722 * b) / expected - 1.0 < 1e-3);
    assert!(b > g && g > r);
}
