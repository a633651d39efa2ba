//! Clear skies by scattering in a spherical atmosphere, as Blender's Sky Texture has them: an artist's model in its units, not a standard's.

mod multiple;
mod single;
mod table;

use super::{SkyImage, colour, within};
use crate::{Error, Result, threads::in_pool};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the table from nadir to zenith and in half a turn about the sun.
const STEPS: [usize; 2] = [192, 128];

/// How often light may be scattered on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scattering {
    /// Once (Nishita and others, SIGGRAPH 1993), by 21 wavelengths; the ground is black.
    Single,
    /// The same with the way to the sun in sixteen even pieces, as Blender had it up to version 4.
    SingleInPieces,
    /// Often, by a fit for Earth and four wavelengths (García Liñán 2022, after Hillaire 2020), over ground of an albedo of 0.3.
    Multiple,
}

/// An atmosphere and where it is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atmosphere {
    /// How often light is scattered.
    pub scattering: Scattering,
    /// Metres above the sea, up to 59 km.
    pub altitude_m: f64,
    /// Amount of air; 1 is Earth's.
    pub air: f64,
    /// Amount of dust; 1 is a clear day over a city.
    pub dust: f64,
    /// Amount of ozone; 1 is Earth's.
    pub ozone: f64,
}

/// A model ready to be asked: radiance in tristimulus values whose Y is in W/(m² sr), weighed by the eye.
trait Model: Sync {
    /// Towards a direction; both directions are (towards the sun, across, up), in the vertical plane of the sun and beside it.
    fn radiance(&self, direction: [f64; 3], sun: [f64; 3]) -> [f64; 3];
    /// By the sun's disc on a surface that faces it, at an elevation in radians.
    fn sun_irradiance(&self, elevation: f64) -> [f64; 3];
}

impl Atmosphere {
    /// The sky without the sun's disc, under a sun of an elevation in degrees in the east: linear Rec.709 in W/(m² sr) weighed by the eye.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn image(&self, elevation_deg: f64, rows: u32) -> Result<SkyImage> {
        let elevation = within("sun elevation", "°", elevation_deg, -90.0..=90.0)?.to_radians();
        let model = self.model()?;
        let table = Table::new(&*model, elevation);
        super::image::drawn(rows, |[east, north, up]| table.look_up(north.atan2(east).abs(), up.clamp(-1.0, 1.0).asin()))
    }

    /// Irradiance by the sun's disc, of an angular diameter in degrees, of a surface that faces it: linear Rec.709 in W/m² weighed by the eye.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn sun_irradiance(&self, elevation_deg: f64, diameter_deg: f64) -> Result<[f64; 3]> {
        let elevation = within("sun elevation", "°", elevation_deg, -90.0..=90.0)?.to_radians();
        let half = 0.5 * within("sun diameter", "°", diameter_deg, 0.0..=180.0)?.to_radians();
        let model = self.model()?;
        // The mean of the lower and the upper limb.
        let [lower, upper] = [elevation - half, elevation + half].map(|height| model.sun_irradiance(height));
        Ok(colour::to_rec709(std::array::from_fn(|i| 0.5 * (lower[i] + upper[i]))).map(|value| value.max(0.0)))
    }

    fn model(&self) -> Result<Box<dyn Model>> {
        within("altitude", " m", self.altitude_m, 0.0..=59_999.0)?;
        for (name, amount) in [("air", self.air), ("dust", self.dust), ("ozone", self.ozone)] {
            if !(amount.is_finite() && (0.0..=1000.0).contains(&amount)) {
                return Err(Error::setting(name, format!("{amount} was found, expected 0 to 1000")));
            }
        }
        Ok(match self.scattering {
            Scattering::Single => Box::new(single::Single::new(self, single::gauss_laguerre())),
            Scattering::SingleInPieces => Box::new(single::Single::new(self, single::even_pieces())),
            Scattering::Multiple => Box::new(multiple::Multiple::new(self)),
        })
    }
}

/// A model at knots that lie closer together at the horizon.
struct Table {
    values: Vec<[f64; 3]>,
}

impl Table {
    fn new(model: &dyn Model, elevation: f64) -> Self {
        let (up, flat) = elevation.sin_cos();
        let row = |row: usize| {
            let place = 2.0 * row as f64 / STEPS[0] as f64 - 1.0;
            let (up_here, flat_here) = (place * place.abs() * FRAC_PI_2).sin_cos();
            (0..=STEPS[1]).map(move |column| {
                let (across, along) = (PI * column as f64 / STEPS[1] as f64).sin_cos();
                let xyz = model.radiance([flat_here * along, flat_here * across, up_here], [flat, 0.0, up]);
                colour::to_rec709(xyz).map(|value| value.max(0.0))
            })
        };
        let rows: Vec<Vec<[f64; 3]>> = in_pool(|| (0..=STEPS[0]).into_par_iter().map(|index| row(index).collect()).collect());
        Self { values: rows.concat() }
    }

    /// Linear between the knots.
    fn look_up(&self, azimuth: f64, latitude: f64) -> [f64; 3] {
        let place = (latitude.abs() / FRAC_PI_2).sqrt().copysign(latitude);
        let [y, x] = [(0.5 * place + 0.5) * STEPS[0] as f64, azimuth / PI * STEPS[1] as f64];
        let [row, column] = [(y as usize).min(STEPS[0] - 1), (x as usize).min(STEPS[1] - 1)];
        let [v, u] = [y - row as f64, x - column as f64];
        let knot = |down: usize, right: usize| self.values[(row + down) * (STEPS[1] + 1) + column + right];
        let [a, b, c, d] = [knot(0, 0), knot(0, 1), knot(1, 0), knot(1, 1)];
        std::array::from_fn(|i| (1.0 - v) * ((1.0 - u) * a[i] + u * b[i]) + v * ((1.0 - u) * c[i] + u * d[i]))
    }
}

/// How far a ray from (0, 0, `radius`) that rises with the sine `up` goes until it is `to` from the centre; `None` if it never is ahead.
fn distance_to(radius: f64, up: f64, to: f64) -> Option<f64> {
    let middle = radius * up;
    let root = middle * middle - radius * radius + to * to;
    let [near, far] = [-1.0, 1.0].map(|sign: f64| -middle + sign * root.max(0.0).sqrt());
    if root < 0.0 || far < 0.0 { None } else { Some(if near >= 0.0 { near } else { far }) }
}
