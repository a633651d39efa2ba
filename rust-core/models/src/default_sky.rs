//! The sky of models without light.

use gonio_scene::{DomeFormat, Light, LightShape, Origin, Scene, Texture, TextureSource, Transform};
use std::f64::consts::PI;

/// Illuminance in lx of open level ground under it: a common overcast day's.
pub const DEFAULT_SKY_LUX: f64 = 10_000.0;
/// Rows of its picture, even: the horizon lies between two of them.
const ROWS: u32 = 512;
/// Columns: it is the same all around.
const COLUMNS: u32 = 2 * ROWS;

/// Adds the CIE's traditional overcast sky (ISO 15469, type 16: L ∝ 1 + 2 sin γ) with [`DEFAULT_SKY_LUX`] to a scene whose z points up; it is black
/// below the horizon.
pub fn add_default_sky(scene: &mut Scene) {
    // E = ∫ L sin γ dω of Lz (1 + 2 sin γ) / 3 is 7 π Lz / 9.
    let zenith = DEFAULT_SKY_LUX * 9.0 / (7.0 * PI);
    add_dome(scene, &Origin::new("default sky"), [0.0, 0.0, 1.0], |sine| {
        let value = if sine > 0.0 { zenith * (1.0 + 2.0 * sine) / 3.0 } else { 0.0 };
        [value as f32; 3]
    });
}

/// Adds a dome whose radiance depends on the sine of the height over the plane across `axis`, a unit vector.
pub(crate) fn add_dome(scene: &mut Scene, origin: &Origin, axis: [f64; 3], radiance: impl Fn(f64) -> [f32; 3]) {
    let row = |row: u32| {
        let polar = (f64::from(row) + 0.5) / f64::from(ROWS) * PI;
        let [r, g, b] = radiance(polar.cos());
        std::iter::repeat_n([r, g, b, 1.0], COLUMNS as usize).flatten()
    };
    let rgba: Vec<f32> = (0..ROWS).flat_map(row).collect();
    let source = TextureSource::Pixels { width: COLUMNS, height: ROWS, rgba: rgba.into() };
    let texture = scene.add_texture(Texture { origin: origin.clone(), source, colour_space: "raw".into() });
    // The dome's own up is +y.
    let x = crate::vector::across(axis);
    let transform = Transform { columns: [x, axis, crate::vector::cross(x, axis), [0.0; 3]] };
    let mut light = Light::new(origin.clone(), LightShape::Dome { format: DomeFormat::LatLong }, transform);
    light.texture = Some(texture);
    scene.lights.push(light);
}
