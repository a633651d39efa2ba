//! The doors for light: colour becomes light at the wavelengths of each lane, and light colour.
//!
//! Without a table light is linear Rec.709, computed as colours are. With one each lane's three components stand at three wavelengths, a long, a middle and a
//! short one, which its rotation tells. Light then is relative to daylight D65: what is white to the eye has the same number at all wavelengths. The
//! rotations are such that D65 at the three is white (see `gonio_spectrum::triples`), so that scenes in black and white have no noise of colour.

use super::Spectrum;
use super::upsampled::upsampled;
use crate::{Column, F, Lanes, Rgb, Select, U};

/// Words of an item of the tables.
pub(super) const WORDS: u32 = 4;

/// From this number on spectra are those of a light's colours, not a lamp's own.
pub const FIRST_COLOUR_SPECTRA: u32 = 1 << 24;

/// What three wavelengths mean, for each rotation of them; built by the engine.
#[derive(Clone, Debug, Default)]
pub struct WavelengthTable {
    /// How many rotations there are.
    pub rotations: u32,
    /// Where the wavelengths stand between 380 and 780 nm, 0 to 1: a quad a rotation.
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
    /// What red, green and blue of a light are, over D65's: a quad each for each rotation of each set.
    pub colour_spectra: Column,
    /// Indices of metals: for each rotation of each metal a quad of n and one of k.
    pub metals: Column,
    /// Indices of glasses over those at 587.56 nm: a quad for each rotation of each glass.
    pub glasses: Column,
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
    /// Whether there are none.
    #[inline(always)]
    pub fn is_colour(self) -> bool {
        self.table.is_none()
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
        let Some(table) = self.table.filter(|_| spectrum.ne(0).any()) else { return self.radiance(colour) };
        let is_lamp = spectrum.lt(FIRST_COLOUR_SPECTRA);
        if is_lamp.all() {
            return of_lamps(table, self.rotation, spectrum, colour);
        }
        let none = spectrum.lanes().u(0);
        let of_set = of_colours(table, self.rotation, is_lamp.select(none, spectrum - FIRST_COLOUR_SPECTRA), colour);
        let of_lamp = of_lamps(table, self.rotation, is_lamp.select(spectrum, none), colour);
        Spectrum::select(is_lamp, of_lamp, of_set)
    }
    /// The index of the metal of a row: n and k, where light has wavelengths.
    #[inline(always)]
    pub fn metal(self, row: u32) -> Option<[Spectrum<L>; 2]> {
        self.table.map(
            #[inline(always)]
            |table| {
                let l = self.rotation.lanes();
                let first = (self.rotation + row * table.rotations) * (2 * WORDS);
                [first, first + WORDS].map(
                    #[inline(always)]
                    |place| {
                        let [r, g, b, _] = l.gather_quads(&table.metals, place);
                        Spectrum { r, g, b }
                    },
                )
            },
        )
    }
    /// What a column has for some rows, a quad for each rotation of each row; none where light is computed as colour.
    #[inline(always)]
    pub fn of_rows(self, quads: &Column, row: U<L>) -> Option<Spectrum<L>> {
        self.table.map(
            #[inline(always)]
            |table| of_rows(table, self.rotation, quads, row),
        )
    }
    /// The index of the glass of a row over that at 587.56 nm, where light has wavelengths.
    #[inline(always)]
    pub fn glass(self, row: u32) -> Option<Spectrum<L>> {
        self.table.map(
            #[inline(always)]
            |table| {
                let [r, g, b, _] = self.rotation.lanes().gather_quads(&table.glasses, (self.rotation + row * table.rotations) * WORDS);
                Spectrum { r, g, b }
            },
        )
    }
    /// Door for light: light as colour to be stored.
    #[inline(always)]
    pub fn to_rgb(self, light: Spectrum<L>) -> Rgb<L> {
        match self.table {
            None => light.to_rgb(),
            Some(table) => seen(table, self.rotation, light),
        }
    }
    /// Light whose components are colour from here on, as its wavelengths will not be known.
    #[inline(always)]
    pub fn as_colour(self, light: Spectrum<L>) -> Spectrum<L> {
        let Rgb { r, g, b } = self.to_rgb(light);
        Spectrum { r, g, b }
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
}

/// Where the wavelengths of rotations stand, 0 to 1.
#[inline(always)]
pub(super) fn places<L: Lanes>(table: &WavelengthTable, rotation: U<L>) -> Spectrum<L> {
    let [r, g, b, _] = rotation.lanes().gather_quads(&table.places, rotation * WORDS);
    Spectrum { r, g, b }
}

/// Colour of light at three wavelengths.
#[inline(never)]
fn seen<L: Lanes>(table: &WavelengthTable, rotation: U<L>, light: Spectrum<L>) -> Rgb<L> {
    rotation.lanes().vectorize(
        #[inline(always)]
        || {
            let l = rotation.lanes();
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

/// Quads of a column at rotations of rows. Apart, to keep what calls it small where light is colour.
#[inline(never)]
fn of_rows<L: Lanes>(table: &WavelengthTable, rotation: U<L>, quads: &Column, row: U<L>) -> Spectrum<L> {
    rotation.lanes().vectorize(
        #[inline(always)]
        || {
            let [r, g, b, _] = rotation.lanes().gather_quads(quads, (row * table.rotations + rotation) * WORDS);
            Spectrum { r, g, b }
        },
    )
}

/// What lamps with spectra send. Filters before them stand in the colour: what it is over the spectrum's own colour.
#[inline(never)]
fn of_lamps<L: Lanes>(table: &WavelengthTable, rotation: U<L>, spectrum: U<L>, colour: Rgb<L>) -> Spectrum<L> {
    rotation.lanes().vectorize(
        #[inline(always)]
        || {
            let l = rotation.lanes();
            let with = spectrum.ne(0);
            let row = with.select(spectrum - 1, spectrum);
            let [r, g, b, _] = l.gather_quads(&table.lamps, (row * table.rotations + rotation) * WORDS);
            let [own_r, own_g, own_b, _] = l.gather_quads(&table.lamp_colours, row * WORDS);
            let luminance = colour.luminance();
            let filter = Rgb::new(over(colour.r, own_r, luminance), over(colour.g, own_g, luminance), over(colour.b, own_b, luminance));
            let filter = Rgb::select(with, filter, colour);
            let sent = upsampled(table, rotation, filter, f32::MAX);
            Spectrum::select(with, sent * Spectrum { r, g, b }, sent)
        },
    )
}

/// What lights send by the spectra of their colours, of these sets. No light takes away at one wavelength what it gives at others.
#[inline(never)]
fn of_colours<L: Lanes>(table: &WavelengthTable, rotation: U<L>, set: U<L>, colour: Rgb<L>) -> Spectrum<L> {
    rotation.lanes().vectorize(
        #[inline(always)]
        || {
            let l = rotation.lanes();
            let first = (set * table.rotations + rotation) * (3 * WORDS);
            let mut sum = Spectrum::zero(l);
            for (component, value) in [colour.r, colour.g, colour.b].into_iter().enumerate() {
                let [r, g, b, _] = l.gather_quads(&table.colour_spectra, first + WORDS * component as u32);
                sum = Spectrum { r, g, b }.mul_add(value, sum);
            }
            sum.part_of(Spectrum::constant(colour.luminance()))
        },
    )
}

/// Components of a lamp's colour below this are no measure of filters before it.
const LEAST_COLOUR: f32 = 0.02;

/// A component over the lamp's own. Colours beyond Rec.709 have components of nearly nothing, which tell nothing of a filter: there the luminance does.
#[inline(always)]
fn over<L: Lanes>(part: F<L>, own: F<L>, luminance: F<L>) -> F<L> {
    own.gt(LEAST_COLOUR).select(part / own.max(LEAST_COLOUR), luminance)
}
