//! Triples of wavelengths whose light is white together: what a path of a spectral picture carries.
//!
//! Three wavelengths run through [380, a], [a, b] and [b, 780] nm as u goes from 0 to 1, at speeds at which D65's light at them is white for
//! each u: the sum of colour(λ) D65(λ) λ'(u) is the colour of all of D65. So a grey scene under D65 has no colour noise, whatever
//! triple a path draws. u is parted into cells; what a renderer needs of a spectrum is its mean over a cell.

mod course;

use crate::{alpha_opic, integral::Integral, source::Spectrum, white};
use std::sync::LazyLock;

/// Cells of three wavelengths.
#[derive(Debug)]
pub struct Triples {
    /// [`Triples::COUNT`] + 1 edges, nm, of the long, the middle and the short wavelength (this order, as red, green, blue).
    pub edges: Vec<[f64; 3]>,
}

static TRIPLES: LazyLock<Triples> = LazyLock::new(|| Triples { edges: course::edges() });

/// The triples, made at first use.
pub fn triples() -> &'static Triples {
    &TRIPLES
}

/// The weight of a wavelength within its cell: D65 as all three of the observer's curves see it.
fn weight(nm: f64) -> f64 {
    white::d65(nm) * white::observer(nm).iter().sum::<f64>()
}

impl Triples {
    /// How many cells there are, all equally likely.
    pub const COUNT: usize = 512;

    /// The edges of each cell's three intervals.
    fn cells(&self) -> impl Iterator<Item = [[f64; 2]; 3]> {
        self.edges.windows(2).map(|pair| std::array::from_fn(|k| [pair[0][k], pair[1][k]]))
    }

    /// By cell: a wavelength of each interval, nm, the mean by D65's light.
    pub fn centres(&self) -> Vec<[f32; 3]> {
        self.filter(|nm| nm)
    }

    /// By cell and wavelength (long, middle, short): the linear Rec.709 that a value of 1, relative to D65, at that wavelength means. A path's colour
    /// is the sum over its three; the mean over cells of D65 of radiance 1 is (1, 1, 1).
    pub fn film(&self) -> Vec<[[f32; 3]; 3]> {
        let colour = Integral::new(&[], white::colour);
        let means = |[from, to]: [f64; 2]| colour.between(from, to).map(|value| (Self::COUNT as f64 * value) as f32);
        self.cells().map(|cell| cell.map(means)).collect()
    }

    /// By cell and wavelength: what a value of 1, relative to D65, at that wavelength brings melanopsin, over what D65 of radiance 1 does; its
    /// mean over cells, summed over the three, is 1. Of light in cd/m² of D65 it so is the melanopic equivalent daylight luminance (CIE S 026).
    pub fn melanopic(&self) -> Vec<[f32; 3]> {
        let response = Integral::new(&[], |nm| [white::d65(nm) * alpha_opic::melanopic(nm)]);
        let all = response.all()[0];
        let mean = |[from, to]: [f64; 2]| (Self::COUNT as f64 * response.between(from, to)[0] / all) as f32;
        self.cells().map(|cell| cell.map(mean)).collect()
    }

    /// By cell and wavelength: a spectrum over D65, both of luminance 1, so that the mean over cells of [`Self::film`] times it is the
    /// spectrum's linear Rec.709 at a luminance of 1. Zero where the spectrum has no light within 380 to 780 nm.
    pub fn tabulate(&self, spectrum: &Spectrum) -> Vec<[f32; 3]> {
        let light = Integral::new(&spectrum.wavelengths_nm, |nm| {
            let [x, y, z] = white::observer(nm).map(|observed| observed * spectrum.at(nm));
            [y, x + y + z]
        });
        let daylight = Integral::new(&[], |nm| [weight(nm)]);
        let luminance = light.all()[0];
        let mean = |[from, to]: [f64; 2]| {
            let value = light.between(from, to)[1] / (daylight.between(from, to)[0] * luminance);
            if luminance > 0.0 { value as f32 } else { 0.0 }
        };
        self.cells().map(|cell| cell.map(mean)).collect()
    }

    /// By cell and wavelength: the mean of a function of the wavelength in nm (a reflectance, an index), by D65's light.
    pub fn filter(&self, values: impl Fn(f64) -> f64) -> Vec<[f32; 3]> {
        let weighed = Integral::new(&[], |nm| [weight(nm), weight(nm) * values(nm)]);
        let mean = |[from, to]: [f64; 2]| {
            let [weights, sum] = weighed.between(from, to);
            (sum / weights) as f32
        };
        self.cells().map(|cell| cell.map(mean)).collect()
    }
}
