//! The doors for light: colour becomes light at the wavelengths of each lane, and light colour.
//!
//! Without a table light is linear Rec.709, computed as colours are. With one each lane's three components stand at three wavelengths, a long, a middle and a
//! short one, which its rotation tells. Light then is relative to daylight D65: what is white to the eye has the same number at all wavelengths. The
//! rotations are such that D65 at the three is white (see `gonio_spectrum::triples`), so that scenes in black and white have no noise of colour.

use super::Spectrum;
use crate::{Column, F, Lanes, Rgb, Select, U};

/// Words of an item of the tables.
const WORDS: u32 = 4;
/// Colours whose components differ by less than this share are grey.
const GREY: f32 = 1e-5;

/// What three wavelengths mean, for each rotation of them; built by the engine.
#[derive(Clone, Debug, Default)]
pub struct WavelengthTable {
    /// How many rotations there are.
    pub rotations: u32,
    /// Where the wavelengths stand between 380 and 780 nm, 0 to 1, and the number of the one that goes on alone: a quad a rotation.
    pub places: Column,
    /// Linear Rec.709 of a component that is 1: a quad for each component of a rotation.
    pub film: Column,
    /// Jakob and Hanika's polynomials of Rec.2020 colours (see `gonio_spectrum::upsampling`): a quad a node.
    pub polynomials: Column,
    /// Nodes along an axis of those.
    pub resolution: u32,
    /// Spectra of lamps over D65's, of unit luminance: a quad for each rotation of each lamp.
    pub lamps: Column,
    /// Linear Rec.709 of those spectra: a quad a lamp.
    pub lamp_colours: Column,
}

/// The wavelengths of a batch: rotations in a column. By default there are none.
#[derive(Clone, Copy, Debug, Default)]
pub struct WavelengthColumn<'a> {
    table: Option<&'a WavelengthTable>,
    rotations: &'a [u32],
}

impl<'a> WavelengthColumn<'a> {
    /// Those of rotations, padded to whole registers, where there is a table.
    pub fn new(table: Option<&'a WavelengthTable>, rotations: &'a [u32]) -> Self {
        Self { table, rotations }
    }
    /// A register from the place `at` on.
    #[inline(always)]
    pub fn load<L: Lanes>(&self, l: L, at: usize) -> Wavelengths<'a, L> {
        match self.table {
            Some(_) => Wavelengths { table: self.table, rotation: l.load_integers(self.rotations, at) },
            None => Wavelengths::rgb(l),
        }
    }
    /// Those of these places.
    #[inline(always)]
    pub fn gather<L: Lanes>(&self, l: L, index: U<L>) -> Wavelengths<'a, L> {
        match self.table {
            Some(_) => Wavelengths { table: self.table, rotation: l.gather_integers(self.rotations, index) },
            None => Wavelengths::rgb(l),
        }
    }
}

/// One of a path's wavelengths, which goes on alone where each would go its own way (Wilkie and others 2014, hero wavelength).
#[derive(Clone, Copy, Debug)]
pub struct Hero<L: Lanes> {
    /// Where it stands.
    pub nanometres: F<L>,
    /// Factor on what the path carries: none is left of the others.
    pub factor: Spectrum<L>,
}

/// The wavelengths of a register's paths.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths<'a, L: Lanes> {
    table: Option<&'a WavelengthTable>,
    /// Number of the rotation.
    rotation: U<L>,
}

impl<'a, L: Lanes> Wavelengths<'a, L> {
    /// None: light is computed as colour.
    #[inline(always)]
    pub fn rgb(l: L) -> Self {
        Self { table: None, rotation: l.u(0) }
    }
    /// Those of rotations, where there is a table.
    #[inline(always)]
    pub fn new(table: Option<&'a WavelengthTable>, rotation: U<L>) -> Self {
        Self { table, rotation }
    }

    /// Door for light: what a surface does to it, a share for each wavelength (pbrt's `RGBAlbedoSpectrum`).
    #[inline(always)]
    pub fn reflectance(self, colour: Rgb<L>) -> Spectrum<L> {
        match self.table {
            None => Spectrum { r: colour.r, g: colour.g, b: colour.b },
            Some(table) => upsampled(table, self.rotation, colour, 1.0),
        }
    }
    /// Door for light: an index, a length, absorption a metre; any number for each wavelength (pbrt's `RGBUnboundedSpectrum`).
    #[inline(always)]
    pub fn coefficient(self, colour: Rgb<L>) -> Spectrum<L> {
        match self.table {
            None => Spectrum { r: colour.r, g: colour.g, b: colour.b },
            Some(table) => upsampled(table, self.rotation, colour, f32::MAX),
        }
    }
    /// Door for light: what something sends, radiance or flux (pbrt's `RGBIlluminantSpectrum`).
    #[inline(always)]
    pub fn radiance(self, colour: Rgb<L>) -> Spectrum<L> {
        self.coefficient(colour)
    }
    /// Door for light: what lamps send whose colour is given, by the spectra of these numbers; 0 is none.
    #[inline(always)]
    pub fn lamp(self, spectrum: U<L>, colour: Rgb<L>) -> Spectrum<L> {
        match self.table {
            Some(table) if spectrum.ne(0).any() => of_lamps(table, self.rotation, spectrum, colour),
            _ => self.radiance(colour),
        }
    }
    /// Door for light: light as colour to be stored.
    #[inline(always)]
    pub fn to_rgb(self, light: Spectrum<L>) -> Rgb<L> {
        match self.table {
            None => light.to_rgb(),
            Some(table) => seen(table, self.rotation, light),
        }
    }
    /// The wavelengths in nanometres, where light has any.
    #[inline(always)]
    pub fn nanometres(self) -> Option<Spectrum<L>> {
        self.table.map(|table| {
            places(table, self.rotation).map(
                #[inline(always)]
                |place| place.mul_add(400.0, place.lanes().f(380.0)),
            )
        })
    }
    /// The one wavelength that goes on where wavelengths part ways, if there are any; it stands for the others of a path that carries all.
    #[inline(always)]
    pub fn hero(self, throughput: Spectrum<L>) -> Option<Hero<L>> {
        let l = self.rotation.lanes();
        self.table.map(
            #[inline(always)]
            |table| {
                let [r, g, b, chosen] = l.gather_quads(&table.places, self.rotation * WORDS);
                let place = chosen.lt(0.5).select(r, chosen.lt(1.5).select(g, b));
                let (red, green, blue) = (chosen.lt(0.5), chosen.ge(0.5) & chosen.lt(1.5), chosen.ge(1.5));
                // Where it went on alone before, nothing is left of the others.
                let one = l.f(1.0);
                let Spectrum { r, g, b } = throughput;
                let others = red.select(l.f(0.0), r.abs()) + green.select(l.f(0.0), g.abs()) + blue.select(l.f(0.0), b.abs());
                let all = others.gt(0.0).select(l.f(3.0), one);
                let factor = Spectrum { r: all.keep_if(red), g: all.keep_if(green), b: all.keep_if(blue) };
                Hero { nanometres: place.mul_add(400.0, l.f(380.0)), factor }
            },
        )
    }
}

#[inline(always)]
fn places<L: Lanes>(table: &WavelengthTable, rotation: U<L>) -> Spectrum<L> {
    let [r, g, b, _] = rotation.lanes().gather_quads(&table.places, rotation * WORDS);
    Spectrum { r, g, b }
}

/// Colour of light at three wavelengths.
#[inline(never)]
fn seen<L: Lanes>(table: &WavelengthTable, rotation: U<L>, light: Spectrum<L>) -> Rgb<L> {
    let l = rotation.lanes();
    l.vectorize(
        #[inline(always)]
        || {
            let first = rotation * (3 * WORDS);
            let mut sum = Rgb::zero(l);
            for (component, value) in [light.r, light.g, light.b].into_iter().enumerate() {
                let [r, g, b, _] = l.gather_quads(&table.film, first + WORDS * component as u32);
                sum = Rgb::new(r.mul_add(value, sum.r), g.mul_add(value, sum.g), b.mul_add(value, sum.b));
            }
            sum
        },
    )
}

/// What lamps with spectra send. Filters before them stand in the colour: what it is over the spectrum's own colour.
#[inline(never)]
fn of_lamps<L: Lanes>(table: &WavelengthTable, rotation: U<L>, spectrum: U<L>, colour: Rgb<L>) -> Spectrum<L> {
    let l = rotation.lanes();
    l.vectorize(
        #[inline(always)]
        || {
            let with = spectrum.ne(0);
            let row = with.select(spectrum - 1, spectrum);
            let [r, g, b, _] = l.gather_quads(&table.lamps, (row * table.rotations + rotation) * WORDS);
            let [own_r, own_g, own_b, _] = l.gather_quads(&table.lamp_colours, row * WORDS);
            let luminance = colour.luminance();
            // Colours beyond Rec.709 have components of nearly nothing, which tell nothing of a filter.
            let over = |part: F<L>, own: F<L>| own.gt(LEAST_COLOUR).select(part / own.max(LEAST_COLOUR), luminance);
            let filter = Rgb::new(over(colour.r, own_r), over(colour.g, own_g), over(colour.b, own_b));
            let filter = Rgb::select(with, filter, colour);
            let sent = upsampled(table, rotation, filter, f32::MAX);
            Spectrum::select(with, sent * Spectrum { r, g, b }, sent)
        },
    )
}

/// Components of a lamp's colour below this are no measure of filters before it.
const LEAST_COLOUR: f32 = 0.02;

/// Spectra of colours by Jakob and Hanika's polynomials, which go up to `most`; greys are even.
#[inline(always)]
fn upsampled<L: Lanes>(table: &WavelengthTable, rotation: U<L>, colour: Rgb<L>, most: f32) -> Spectrum<L> {
    let limit = colour.g.abs() * GREY;
    let coloured = (colour.r - colour.g).abs().gt(limit) | (colour.b - colour.g).abs().gt(limit);
    let grey = Spectrum::constant(colour.g);
    if coloured.any() { Spectrum::select(coloured, by_polynomials(table, rotation, colour, most), grey) } else { grey }
}

#[inline(never)]
fn by_polynomials<L: Lanes>(table: &WavelengthTable, rotation: U<L>, colour: Rgb<L>, most: f32) -> Spectrum<L> {
    let l = rotation.lanes();
    l.vectorize(
        #[inline(always)]
        || {
            let places = places(table, rotation);
            let sent = bounded(table, places, colour.max(0.0), most);
            let below = colour.r.lt(0.0) | colour.g.lt(0.0) | colour.b.lt(0.0);
            if !below.any() || most <= 1.0 {
                return sent;
            }
            // What lies below zero is taken away as it would be added.
            let taken = Rgb::new(-colour.r, -colour.g, -colour.b).max(0.0);
            sent - bounded(table, places, taken, most).keep_if(below)
        },
    )
}

/// Spectra of colours without negative components. Reflectances are asked for at their own height, where all else is at half of the range, where the
/// polynomials are smoothest.
#[inline(always)]
fn bounded<L: Lanes>(table: &WavelengthTable, places: Spectrum<L>, colour: Rgb<L>, most: f32) -> Spectrum<L> {
    let largest = colour.r.max(colour.g).max(colour.b);
    let height = if most > 1.0 { (largest * 2.0).max(f32::MIN_POSITIVE) } else { largest.max(1.0) };
    let [c0, c1, c2] = polynomial(table, wide(colour * height.recip()));
    let reflectance = places.map(
        #[inline(always)]
        |t| sigmoid(c0.mul_add(t, c1).mul_add(t, c2)),
    );
    reflectance * height
}

/// Rec.2020 of linear Rec.709.
#[inline(always)]
fn wide<L: Lanes>(c: Rgb<L>) -> Rgb<L> {
    let row = |[r, g, b]: [f32; 3]| c.r.mul_add(r, c.g.mul_add(g, c.b * b)).saturate();
    Rgb::new(
        row([0.627_404, 0.329_283, 0.043_313_1]),
        row([0.069_097_3, 0.919_541, 0.011_362_3]),
        row([0.016_391_4, 0.088_013_3, 0.895_595]),
    )
}

/// ½ + x / (2 √(1 + x²)), in a form that keeps its digits near 0 and 1.
#[inline(always)]
fn sigmoid<L: Lanes>(x: F<L>) -> F<L> {
    let q = x.mul_add(x, x.lanes().f(1.0)).sqrt();
    let end = (q * (q + x.abs())).recip() * 0.5;
    x.lt(0.0).select(end, 1.0 - end)
}

/// The first node along the axis of s, as `gonio_spectrum::Upsampling` has it.
const EDGE: f32 = 1.0 / 1024.0;

/// The polynomial of a Rec.2020 colour within [0, 1], read as `gonio_spectrum::Upsampling` tells.
#[inline(always)]
fn polynomial<L: Lanes>(table: &WavelengthTable, c: Rgb<L>) -> [F<L>; 3] {
    let l = c.r.lanes();
    let (red, green) = (c.r.ge(c.g) & c.r.ge(c.b), c.g.ge(c.b));
    let largest = c.r.max(c.g).max(c.b);
    let (next, after) = (red.select(c.g, green.select(c.b, c.r)), red.select(c.b, green.select(c.r, c.g)));
    let chosen = red.select(l.u(0), green.select(l.u(1), l.u(2)));
    let nodes = table.resolution as f32;
    let (dark, bright) = (largest.safe_sqrt(), (1.0 - largest).safe_sqrt());
    let s = (dark / (dark + bright)).clamp(EDGE, 1.0 - EDGE);
    let over = largest.max(f32::MIN_POSITIVE).recip() * (nodes - 1.0);
    let along = (s - EDGE) * ((nodes - 1.0) / (1.0 - 2.0 * EDGE));
    let axes = [along, (after * over).min(nodes - 1.0), (next * over).min(nodes - 1.0)];
    let mut low = [l.u(0); 3];
    let mut share = [l.f(0.0); 3];
    for ((low, share), place) in low.iter_mut().zip(&mut share).zip(axes) {
        let below = place.floor().min(nodes - 2.0);
        (*low, *share) = (below.to_i32(), place - below);
    }
    let base = ((chosen * table.resolution + low[0]) * table.resolution + low[1]) * table.resolution + low[2];
    let mut sum = [l.f(0.0); 3];
    for corner in 0..8_u32 {
        let [above_s, above_y, above_x] = [corner >> 2 & 1, corner >> 1 & 1, corner & 1];
        let offset = (above_s * table.resolution + above_y) * table.resolution + above_x;
        let mut weight = l.f(1.0);
        for (above, share) in [above_s, above_y, above_x].into_iter().zip(share) {
            weight = weight * if above == 1 { share } else { 1.0 - share };
        }
        let [a, b, c, _] = l.gather_quads(&table.polynomials, (base + offset) * WORDS);
        for (sum, value) in sum.iter_mut().zip([a, b, c]) {
            *sum = value.mul_add(weight, *sum);
        }
    }
    let scale = (s * (1.0 - s) * 2.0).recip();
    let [a, b, c] = sum;
    [a * scale, b * scale, c * scale]
}
