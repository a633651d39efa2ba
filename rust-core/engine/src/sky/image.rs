//! The sky as a picture and as lights of a scene.

use super::{Daylight, Frame, SUN_ANGLE_DEG, Sky, within};
use crate::scene::{DomeFormat, Emission, Light, LightShape, Origin, Scene, Texture, TextureSource};
use crate::{Error, Result, threads::in_pool};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Rows of a sky's picture: a third of a degree each.
pub const DEFAULT_ROWS: u32 = 512;
/// Most rows.
const MOST_ROWS: u32 = 4096;

/// A latitude–longitude picture: the zenith in the top row, south in the middle column, east to the left of it.
#[derive(Clone, Debug)]
pub struct SkyImage {
    /// Pixels in a row, twice the rows.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear Rec.709 in the sky's unit and an alpha of 1, rows from the top.
    pub rgba: Arc<[f32]>,
}

impl Sky {
    /// Draws the sky without the sun's disc, at the middle of every pixel.
    ///
    /// # Errors
    /// The number of rows is odd, below 2 or above 4096.
    pub fn image(&self, rows: u32) -> Result<SkyImage> {
        drawn(rows, |direction| self.radiance(direction))
    }
}

/// A sky under a sun in the east, `elevation_deg` high, whose radiance depends on the sine of a direction's height, which stays above 0.001, and on
/// its angle from the sun in radians.
///
/// # Errors
/// The number of rows is odd, below 2 or above 4096, or the sun is not from 0° to 90° high.
pub fn draw_by_angle(elevation_deg: f64, rows: u32, radiance: impl Fn(f64, f64) -> [f64; 3] + Sync) -> Result<SkyImage> {
    let (sun_up, sun_flat) = within("sun elevation", "°", elevation_deg, 0.0..=90.0)?.to_radians().sin_cos();
    drawn(rows, |[east, _, up]| radiance(up.max(1e-3), (east * sun_flat + up * sun_up).clamp(-1.0, 1.0).acos()))
}

/// A picture of a radiance by direction (east, north, up), at the middle of every pixel.
pub(super) fn drawn(rows: u32, radiance: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Result<SkyImage> {
    if !rows.is_multiple_of(2) || !(2..=MOST_ROWS).contains(&rows) {
        return Err(Error::setting("rows", format!("{rows} was found, expected an even number from 2 to {MOST_ROWS}")));
    }
    let columns = 2 * rows;
    let line = |row: u32| -> Vec<f32> {
        let polar = PI * (f64::from(row) + 0.5) / f64::from(rows);
        let pixel = |column: u32| {
            let [r, g, b] = radiance(direction(polar, (f64::from(column) + 0.5) / f64::from(columns)));
            [r as f32, g as f32, b as f32, 1.0]
        };
        (0..columns).flat_map(pixel).collect()
    };
    let lines: Vec<Vec<f32>> = in_pool(|| (0..rows).into_par_iter().map(line).collect());
    Ok(SkyImage { width: columns, height: rows, rgba: lines.concat().into() })
}

/// The direction (east, north, up) of a polar angle and a place from left to right (0 to 1): longitudes grow to the left from south.
fn direction(polar: f64, across: f64) -> [f64; 3] {
    let (sin, cos) = (2.0 * PI * (0.5 - across)).sin_cos();
    let (flat, up) = polar.sin_cos();
    [flat * sin, -flat * cos, up]
}

impl Daylight {
    /// Adds sun and sky to a scene: a dome of `rows` rows, and a distant light for the disc where it shines. Gives the sky that was added.
    ///
    /// # Errors
    /// As [`Self::sky`] and [`Sky::image`].
    pub fn add_to(&self, scene: &mut Scene, frame: &Frame, rows: u32) -> Result<Sky> {
        let sky = self.sky()?;
        let SkyImage { width, height, rgba } = sky.image(rows)?;
        let source = TextureSource::Pixels { width, height, rgba };
        let texture = scene.add_texture(Texture { origin: Origin::new("sky"), source, colour_space: "raw".into() });
        let dome = LightShape::Dome { format: DomeFormat::LatLong };
        let colour_spectra = sky.sky_spectra().map(Arc::new);
        scene.lights.push(Light { texture: Some(texture), colour_spectra, ..Light::new(Origin::new("sky"), dome, frame.dome()) });
        if sky.direct_lux > 0.0 {
            scene.lights.push(sun_light(&sky, frame));
        }
        Ok(sky)
    }
}

/// The sun's disc.
fn sun_light(sky: &Sky, frame: &Frame) -> Light {
    let emission = Emission { radiance: sky.sun_irradiance().map(|value| value as f32), normalized: true, ..Emission::default() };
    let shape = LightShape::Distant { angle_deg: SUN_ANGLE_DEG };
    let colour_spectra = sky.sun_spectra().map(Arc::new);
    Light { emission, colour_spectra, ..Light::new(Origin::new("sun"), shape, frame.from_direction(sky.sun.direction())) }
}
