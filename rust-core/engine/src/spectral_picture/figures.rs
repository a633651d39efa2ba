//! Figures of the light that falls on what a picture shows, from its illuminance by wavelength.

use super::SpectralPicture;
use crate::{
    error::{Error, Result},
    scene::Aov,
    threads::in_pool,
};
use gonio_spectrum::{RenderingOfMany, melanopic_daylight};
use rayon::prelude::*;

/// The widest bands that colour rendering is told of, nm: lines of lamps fill a band. Over bands of 10 nm Ra is within 2.5 of what lamps have.
const WIDEST_NM: f64 = 10.0;

/// A figure of the light on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightFigure {
    /// Colour rendering by CIE 13.3.
    Ra,
    /// Fidelity by TM-30.
    Rf,
    /// Gamut by TM-30.
    Rg,
    /// Melanopic equivalent daylight illuminance, lx (CIE S 026).
    MelanopicEdi,
}

impl LightFigure {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ra, Self::Rf, Self::Rg, Self::MelanopicEdi];

    /// Its name, as meters have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ra => "ra",
            Self::Rf => "rf",
            Self::Rg => "rg",
            Self::MelanopicEdi => "melanopic-edi",
        }
    }

    /// The figure of a name, in any letters.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|figure| figure.name().eq_ignore_ascii_case(name))
    }
}

impl SpectralPicture {
    /// A figure of the light on what each pixel shows, rows from the top; NaN where it is not defined: without light, where the light is not white, and Ra
    /// outside of CIE 13.3's range.
    ///
    /// # Errors
    /// A picture without illuminance, or with bands of 20 nm where colour rendering is asked for.
    pub fn light_figure(&self, figure: LightFigure) -> Result<Vec<f32>> {
        let name = figure.name();
        let layer = self.layers.iter().find(|layer| layer.aov == Aov::Illuminance).ok_or_else(|| {
            let problem = format!(
                "{name} is of the light on surfaces: the picture lacks illuminance, which --aov illuminance adds to --by-wavelength"
            );
            Error::setting("quantity", problem)
        })?;
        let (width, centres) = (self.bands.width_nm(), self.bands.centres());
        if figure != LightFigure::MelanopicEdi && width > WIDEST_NM {
            return Err(Error::setting("quantity", format!("{name} wants bands of 5 or 10 nm, the picture has {width} nm")));
        }
        let rendering = RenderingOfMany::new(&centres);
        let melanopic: Vec<f64> = centres.iter().map(|nm| width * melanopic_daylight(*nm)).collect();
        let of_pixel = |pixel: usize| {
            let power: Vec<f64> = layer.bands.iter().map(|band| f64::from(band[pixel])).collect();
            let found = match figure {
                LightFigure::Ra => rendering.ra(&power),
                LightFigure::Rf => rendering.rf_rg(&power).map(|[rf, _]| rf),
                LightFigure::Rg => rendering.rf_rg(&power).map(|[_, rg]| rg),
                LightFigure::MelanopicEdi => Some(power.iter().zip(&melanopic).map(|(power, weight)| power * weight).sum()),
            };
            found.map_or(f32::NAN, |found| found as f32)
        };
        let pixels = layer.bands.first().map_or(0, Vec::len);
        Ok(in_pool(|| (0..pixels).into_par_iter().map(of_pixel).collect()))
    }
}
