//! The sky as the table that Blender 5 keeps of it: tristimulus values, rows that lie closer together at the horizon.
//!
//! Hosts that show the sky on surfaces read it linearly between texels, so the table's own grid is part of what is seen.

use super::{Atmosphere, Model, Scattering};
use crate::Result;
use crate::sky::{SkyImage, within};
use crate::threads::in_pool;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Columns around and rows from nadir to zenith.
const SIZE: [usize; 2] = [512, 256];
/// Below the horizon, a sky of light scattered once fades to black over this sine.
const FADE: f64 = 0.4;

impl Atmosphere {
    /// The table under a sun of an elevation in degrees, which stands in the middle: X, Y and Z whose Y is in W/(m² sr) weighed by the eye, and an
    /// alpha of 1, the zenith in the top row. The row at a share y of the height shows the elevation ±(2 y − 1)² of a right angle.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn table(&self, elevation_deg: f64) -> Result<SkyImage> {
        let (up, flat) = within("sun elevation", "°", elevation_deg, -90.0..=90.0)?.to_radians().sin_cos();
        let (model, sun) = (self.model()?, [flat, 0.0, up]);
        let line = |row: usize| match self.scattering {
            Scattering::Single => once(&*model, sun, row),
            Scattering::SingleInPieces => once_in_pieces(&*model, sun, row),
            Scattering::Multiple => often(&*model, sun, row),
        };
        let lines: Vec<Vec<f32>> = in_pool(|| (0..SIZE[1]).into_par_iter().rev().map(line).collect());
        Ok(SkyImage { width: SIZE[0] as u32, height: SIZE[1] as u32, rgba: lines.concat().into() })
    }

    /// Irradiance by the sun's disc of a surface that faces it, as if all of it were as bright as its foot and as its top: X, Y and Z in W/m²
    /// weighed by the eye.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn sun_limbs(&self, elevation_deg: f64, diameter_deg: f64) -> Result<[[f64; 3]; 2]> {
        let elevation = within("sun elevation", "°", elevation_deg, -90.0..=90.0)?.to_radians();
        let half = 0.5 * within("sun diameter", "°", diameter_deg, 0.0..=180.0)?.to_radians();
        let model = self.model()?;
        let is_down = self.scattering == Scattering::Single && elevation + half <= 0.0;
        Ok([elevation - half, elevation + half].map(|height| if is_down { [0.0; 3] } else { model.sun_irradiance(height) }))
    }
}

/// A row, counted from the nadir, of light that was scattered once: texels stand for the lower left of what they cover.
fn once(model: &dyn Model, sun: [f64; 3], row: usize) -> Vec<f32> {
    let place = 2.0 * row as f64 / SIZE[1] as f64 - 1.0;
    let latitude = FRAC_PI_2 * place * place;
    let (latitude, fade) = if place < 0.0 { (0.0, (1.0 - latitude.sin() / FADE).max(0.0).powi(3)) } else { (latitude, 1.0) };
    mirrored(|column| {
        let longitude = TAU * column as f64 / SIZE[0] as f64 - PI;
        model.radiance(direction(latitude, longitude), sun).map(|value| value * fade)
    })
}

/// The same of the way in pieces: rows lie a little higher, and those below the horizon are like the one at it, for hosts fade them.
fn once_in_pieces(model: &dyn Model, sun: [f64; 3], row: usize) -> Vec<f32> {
    let rows = SIZE[1] / 2;
    let place = row.saturating_sub(rows) as f64 / rows as f64;
    let latitude = (FRAC_PI_2 * (1.0 + 0.5 / rows as f64) * place * place).min(FRAC_PI_2);
    mirrored(|column| model.radiance(direction(latitude, TAU * column as f64 / SIZE[0] as f64 - PI), sun))
}

/// The same of light that was scattered often, at the middles of texels.
fn often(model: &dyn Model, sun: [f64; 3], row: usize) -> Vec<f32> {
    let place = 2.0 * (row as f64 + 0.5) / SIZE[1] as f64 - 1.0;
    mirrored(|column| {
        let longitude = TAU * (column as f64 + 0.5) / SIZE[0] as f64 - PI;
        model.radiance(direction(FRAC_PI_2 * place * place.abs(), longitude), sun)
    })
}

fn direction(latitude: f64, longitude: f64) -> [f64; 3] {
    let ((up, flat), (across, along)) = (latitude.sin_cos(), longitude.sin_cos());
    [flat * along, flat * across, up]
}

/// A row whose right half is the left one's image.
fn mirrored(texel: impl Fn(usize) -> [f64; 3]) -> Vec<f32> {
    let half: Vec<[f64; 3]> = (0..SIZE[0] / 2).map(texel).collect();
    half.iter().chain(half.iter().rev()).flat_map(|[x, y, z]| [*x as f32, *y as f32, *z as f32, 1.0]).collect()
}
