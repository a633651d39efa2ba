//! What skies bring to a level surface, and the CIE's skies by their closed forms.

use super::made_up;
use crate::{
    Division, Sun,
    sky::{Light, Model, SkyMatrix, SkyOptions, cie_sky},
};
use std::f64::consts::PI;

fn level(column: &[f32], division: &Division) -> f64 {
    let patches = column.iter().zip(division.patches()).skip(1);
    patches.map(|(value, patch)| f64::from(*value) * patch.direction()[2] * patch.solid_angle).sum()
}

#[test]
fn every_sky_brings_its_diffuse_light() {
    let year = made_up();
    for (factor, model) in [(1, Model::Perez), (3, Model::Perez), (2, Model::Cie(1)), (2, Model::Cie(12)), (1, Model::Cie(16))] {
        let options = SkyOptions { factor, model, light: Light::WithoutSun, ..SkyOptions::default() };
        let matrix = SkyMatrix::new(&year, options).expect("a matrix");
        for step in [1952, 4142, 8292] {
            let now = matrix.conditions(step).expect("light");
            let found = level(&matrix.columns(&[step], 1), matrix.division());
            assert!((found / now.diffuse_horizontal - 1.0).abs() < 1e-5, "{model:?} {found}");
        }
    }
}

#[test]
fn nights_are_dark_and_the_ground_shows_its_share() {
    let year = made_up();
    let matrix = SkyMatrix::new(&year, SkyOptions { ground: 0.5, ..SkyOptions::default() }).expect("a matrix");
    assert!(matrix.conditions(0).is_none() && matrix.columns(&[0], 1).iter().all(|value| *value == 0.0));
    let now = matrix.conditions(4140).expect("light");
    let ground = f64::from(matrix.columns(&[4140], 1)[0]);
    assert!((ground / (now.horizontal() * 0.5 / PI) - 1.0).abs() < 1e-6);
}

#[test]
fn the_traditional_overcast_sky_is_three_times_as_bright_above() {
    // Moon and Spencer: L(zenith) = 9 E / (7 π), L(up) = L(zenith) (1 + 2 up) / 3.
    let sky = cie_sky(6, 16, Sun::default(), 7.0 * PI / 9.0, 0.2).expect("a sky");
    let division = Division::new(6).expect("a division");
    for (value, patch) in sky.iter().zip(division.patches()).skip(1) {
        let expected = (1.0 + 2.0 * patch.direction()[2]) / 3.0;
        assert!((f64::from(*value) / expected - 1.0).abs() < 1e-3, "{value} {expected}");
    }
    assert!((f64::from(sky[0]) - 7.0 / 9.0 * 0.2).abs() < 1e-6);
}

#[test]
fn a_wall_under_the_overcast_sky_has_its_share() {
    // Vertical over horizontal: 3/14 + 4/(7 π), the integral of (1 + 2 sin h)/3 over the half sky before a wall.
    let sky = cie_sky(6, 16, Sun::default(), 1.0, 0.0).expect("a sky");
    let division = Division::new(6).expect("a division");
    let patches = sky.iter().zip(division.patches()).skip(1);
    let wall: f64 = patches.map(|(value, patch)| f64::from(*value) * patch.direction()[0].max(0.0) * patch.solid_angle).sum();
    assert!((wall / (3.0 / 14.0 + 4.0 / (7.0 * PI)) - 1.0).abs() < 3e-3, "{wall}");
}

#[test]
fn the_sun_in_patches_keeps_its_light() {
    let year = made_up();
    for sun_patches in 1..=4 {
        let options = SkyOptions { factor: 2, light: Light::SunAlone { sun_patches }, ..SkyOptions::default() };
        let matrix = SkyMatrix::new(&year, options).expect("a matrix");
        let column = matrix.columns(&[4144], 1);
        let found: f64 = column.iter().zip(matrix.division().patches()).map(|(value, patch)| f64::from(*value) * patch.solid_angle).sum();
        let now = matrix.conditions(4144).expect("light");
        assert_eq!(column.iter().filter(|value| **value > 0.0).count(), sun_patches);
        assert!((found / now.direct_normal - 1.0).abs() < 1e-6);
    }
}
