//! The sky's matrix: the radiance of every patch in every step of a year, as Radiance's `gendaymtx` 6 gives it.

mod conditions;
mod nearest;
mod options;

pub use conditions::Conditions;
pub use options::{Light, Model, Quantity, SkyOptions};

use crate::{
    division::{Division, dot},
    error::{AnnualError, Result},
    year::Year,
};
use conditions::conditions;
use gonio_sky::{CIE_TYPES, CieSky, PerezSky};
use std::{f64::consts::PI, thread};

/// A year's matrix, of which any steps can be had.
#[derive(Clone, Debug)]
pub struct SkyMatrix<'a> {
    year: &'a Year,
    options: SkyOptions,
    division: Division,
    centres: Vec<[f64; 3]>,
}

impl<'a> SkyMatrix<'a> {
    /// The matrix of a year.
    ///
    /// # Errors
    /// An option out of its range.
    pub fn new(year: &'a Year, options: SkyOptions) -> Result<Self> {
        let division = Division::new(options.factor)
            .ok_or_else(|| AnnualError::setting("the sky's division", format!("{} was found, expected 1 to 6", options.factor)))?;
        let check = |name, value: f64, range: std::ops::RangeInclusive<f64>| match range.contains(&value) {
            true => Ok(()),
            false => Err(AnnualError::setting(name, format!("{value} was found, expected {} to {}", range.start(), range.end()))),
        };
        check("ground", options.ground, 0.0..=1.0)?;
        check("rotation", options.rotation_deg, -360.0..=360.0)?;
        check("dew point", options.dew_point_c.unwrap_or(0.0), -90.0..=60.0)?;
        if let Light::All { sun_patches } | Light::SunAlone { sun_patches } = options.light {
            check("patches of the sun", sun_patches as f64, 1.0..=nearest::MOST as f64)?;
        }
        if let Model::Cie(kind) = options.model {
            check("CIE sky", f64::from(kind), f64::from(*CIE_TYPES.start())..=f64::from(*CIE_TYPES.end()))?;
        }
        let centres = division.patches().iter().map(|patch| patch.direction()).collect();
        Ok(Self { year, options, division, centres })
    }

    /// Its division.
    pub fn division(&self) -> &Division {
        &self.division
    }

    /// Its year.
    pub fn year(&self) -> &'a Year {
        self.year
    }

    /// Sun and sky of a step in the matrix' quantity; `None` at night.
    pub fn conditions(&self, step: usize) -> Option<Conditions> {
        conditions(self.year, &self.year.steps[step], &self.options)
    }

    /// Columns of some steps, one after the other, on some threads: element `[step][patch]`.
    pub fn columns(&self, steps: &[usize], threads: usize) -> Vec<f32> {
        let patches = self.centres.len();
        let mut columns = vec![0.0; steps.len() * patches];
        let share = steps.len().div_ceil(threads.max(1)).max(1);
        thread::scope(|scope| {
            for (part, steps) in columns.chunks_mut(share * patches).zip(steps.chunks(share)) {
                scope.spawn(move || part.chunks_exact_mut(patches).zip(steps).for_each(|(column, step)| self.fill(*step, column)));
            }
        });
        columns
    }

    /// Writes a step's column of zeros over.
    fn fill(&self, step: usize, column: &mut [f32]) {
        let Some(now) = self.conditions(step) else { return };
        if !matches!(self.options.light, Light::SunAlone { .. }) {
            column[0] = (now.horizontal() * self.options.ground / PI) as f32;
            self.spread(&now, &mut column[1..]);
        }
        if let Light::All { sun_patches } | Light::SunAlone { sun_patches } = self.options.light
            && now.direct_normal > 1e-4
        {
            nearest::add_sun(&self.division, &self.centres, &now, sun_patches, column);
        }
    }

    /// The sky's patches, such that their illuminance of a level surface is the diffuse one.
    fn spread(&self, now: &Conditions, sky: &mut [f32]) {
        match self.options.model {
            Model::Perez => self.spread_by(now, sky, PerezSky::unlimited(&now.clearness, now.zenith_angle)),
            Model::Cie(kind) => CieSky::new(kind, now.zenith_angle).into_iter().for_each(|model| self.spread_by(now, sky, model)),
        }
    }

    fn spread_by(&self, now: &Conditions, sky: &mut [f32], model: impl Luminance) {
        let sun = now.limited_sun();
        let (mut level, mut row, mut rows_factor) = (0.0, f64::NAN, 0.0);
        for ((value, centre), patch) in sky.iter_mut().zip(&self.centres[1..]).zip(&self.division.patches()[1..]) {
            if patch.altitude != row {
                (row, rows_factor) = (patch.altitude, model.of_height(centre[2]));
            }
            let found = (rows_factor * model.of_angle(centre[2], dot(sun, *centre).clamp(-1.0, 1.0).acos())).max(0.0);
            *value = found as f32;
            level += found * centre[2] * patch.solid_angle;
        }
        // A sky that the formula leaves dark all over is even.
        let is_dark = level <= 1e-6;
        let scale = now.diffuse_horizontal / if is_dark { PI } else { level };
        sky.iter_mut().for_each(|value| *value = if is_dark { scale as f32 } else { (f64::from(*value) * scale) as f32 });
    }
}

/// A spread of luminance as a factor of a row and one of each patch.
trait Luminance {
    /// By the sine of the height above the horizon.
    fn of_height(&self, up: f64) -> f64;
    /// By the angle from the sun in radians, at a height.
    fn of_angle(&self, up: f64, angle: f64) -> f64;
}

impl Luminance for PerezSky {
    fn of_height(&self, up: f64) -> f64 {
        self.gradation(up)
    }

    fn of_angle(&self, _: f64, angle: f64) -> f64 {
        self.indicatrix(angle)
    }
}

impl Luminance for CieSky {
    fn of_height(&self, _: f64) -> f64 {
        1.0
    }

    fn of_angle(&self, up: f64, angle: f64) -> f64 {
        self.relative_luminance(up, angle)
    }
}

/// One sky of the CIE's on a division, cd/m² a patch, ground first: `horizontal_lux` is its illuminance of a level surface without the sun's.
///
/// # Errors
/// No such type or division, or a ground that reflects more than arrives.
pub fn cie_sky(factor: u32, kind: u8, sun: crate::Sun, horizontal_lux: f64, ground: f64) -> Result<Vec<f32>> {
    let nobody = Year::dark();
    let options = SkyOptions { factor, model: Model::Cie(kind), ground, light: Light::WithoutSun, ..SkyOptions::default() };
    let matrix = SkyMatrix::new(&nobody, options)?;
    let now = Conditions::of_sky(sun, horizontal_lux);
    let mut column = vec![0.0; matrix.centres.len()];
    column[0] = (now.horizontal() * ground / PI) as f32;
    matrix.spread(&now, &mut column[1..]);
    Ok(column)
}
