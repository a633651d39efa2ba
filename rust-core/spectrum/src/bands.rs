//! Even bands of wavelengths, of which the spectrum of light that was measured or rendered is put together.
//!
//! A renderer that knows one wavelength at a time finds light relative to daylight D65, band by band; [`Bands::power`] makes power of it.

use crate::{
    integral::{Integral, VISIBLE},
    observer::EFFICACY,
    source::Spectrum,
    upsampling::{REC709_TO_REC2020, upsampling},
    white,
};
use std::sync::LazyLock;

/// Bands of one width from 380 to 780 nm.
#[derive(Debug)]
pub struct Bands {
    width_nm: f64,
    /// Power of D65 in each, W/nm for each lm.
    daylight: Vec<f64>,
}

static BANDS: LazyLock<Vec<Bands>> = LazyLock::new(|| Bands::WIDTHS_NM.into_iter().map(Bands::new).collect());

/// The bands of a width in nm, made at first use; none but of [`Bands::WIDTHS_NM`].
pub fn bands_of(width_nm: f64) -> Option<&'static Bands> {
    BANDS.iter().find(|bands| bands.width_nm.total_cmp(&width_nm).is_eq())
}

impl Bands {
    /// The widths that there are, nm.
    pub const WIDTHS_NM: [f64; 3] = [5.0, 10.0, 20.0];

    fn new(width_nm: f64) -> Self {
        let energy = Integral::new(&[], |nm| [white::d65(nm)]);
        let daylight = edges(width_nm).map(|[from, to]| energy.between(from, to)[0] / (width_nm * EFFICACY)).collect();
        Self { width_nm, daylight }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.daylight.len()
    }

    /// The width of each, nm.
    pub fn width_nm(&self) -> f64 {
        self.width_nm
    }

    /// The middle of a band, nm.
    pub fn centre(&self, band: usize) -> f64 {
        VISIBLE[0] + self.width_nm * (band as f64 + 0.5)
    }

    /// The middles of all, nm.
    pub fn centres(&self) -> Vec<f64> {
        (0..self.count()).map(|band| self.centre(band)).collect()
    }

    /// Mean power in a band, W/nm for each lm (or of an illuminance W/(m² nm), of a luminance W/(m² sr nm)), where D65 would have the value 1.
    pub fn power(&self, band: usize, relative: f64) -> f64 {
        self.daylight[band] * relative
    }

    /// By band: linear Rec.709 of a value that is 1 relative to D65 there. All together are white.
    pub fn film(&self) -> Vec<[f32; 3]> {
        let colour = Integral::new(&[], white::colour);
        edges(self.width_nm).map(|[from, to]| colour.between(from, to).map(|part| part as f32)).collect()
    }

    /// By band: a spectrum over D65, both of luminance 1. Zero where the spectrum has no light within 380 to 780 nm.
    pub fn tabulate(&self, spectrum: &Spectrum) -> Vec<f32> {
        let light = Integral::new(&spectrum.wavelengths_nm, |nm| {
            let power = spectrum.at(nm);
            [power, power * white::observer(nm)[1]]
        });
        let luminance = light.all()[1];
        let relative = |([from, to], daylight): ([f64; 2], &f64)| {
            let value = light.between(from, to)[0] / (self.width_nm * EFFICACY * daylight * luminance);
            if luminance > 0.0 { value as f32 } else { 0.0 }
        };
        edges(self.width_nm).zip(&self.daylight).map(relative).collect()
    }

    /// By band: the mean of functions of the wavelength in nm (a reflectance, spectra over D65's), by D65's light.
    pub fn filter<const N: usize>(&self, values: impl Fn(f64) -> [f64; N]) -> Vec<[f32; N]> {
        let weighed = Integral::new(&[], |nm| values(nm).map(|value| value * white::d65(nm)));
        let mean = |([from, to], daylight): ([f64; 2], &f64)| {
            weighed.between(from, to).map(|sum| (sum / (self.width_nm * EFFICACY * daylight)) as f32)
        };
        edges(self.width_nm).zip(&self.daylight).map(mean).collect()
    }

    /// What a linear Rec.709 colour of any size is in a band, relative to D65: as lanes have it that know wavelengths.
    pub fn of_colour(&self, band: usize, colour: [f32; 3]) -> f32 {
        let nm = self.centre(band) as f32;
        let above = colour.map(|part| part.max(0.0));
        let below = colour.map(|part| (-part).max(0.0));
        bounded(nm, above) - bounded(nm, below)
    }
}

/// The first and the last wavelength of each band of a width, nm.
fn edges(width_nm: f64) -> impl Iterator<Item = [f64; 2]> {
    let count = ((VISIBLE[1] - VISIBLE[0]) / width_nm).round() as usize;
    (0..count).map(move |band| [band, band + 1].map(|edge| VISIBLE[0] + width_nm * edge as f64))
}

/// Colours without negative components are asked for at half of the range, where the polynomials are smoothest; greys are even.
fn bounded(nm: f32, colour: [f32; 3]) -> f32 {
    let [r, g, b] = colour;
    if r == g && g == b {
        return g;
    }
    let height = 2.0 * r.max(g).max(b);
    let wide = REC709_TO_REC2020.map(|row| row.iter().zip(colour).map(|(part, value)| part * (value / height)).sum());
    height * upsampling().reflectance(wide, nm)
}
