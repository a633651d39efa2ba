//! What media do to light of some lanes: their coefficients, as colour or at the lanes' wavelengths.
//!
//! Absorption and scattering are spectra of their own colours, and extinction is their sum: what absorbs nothing scatters all that it takes.

use super::{Medium, MediumTable, column};
use crate::tables::fields::ROW;
use gonio_simd::{Column, F, Lanes, M, One, PADDING, Rgb, Spectrum, U, WavelengthTable, Wavelengths};

/// Greatest number of a colour's spectrum over its greatest component: spectra of coefficients are asked for at half of their range.
const ABOVE_COLOUR: f32 = 2.0;

/// One quantity of all media, by row.
#[derive(Clone, Debug, Default)]
pub(super) struct Quantity {
    /// R, G, B.
    colour: [Column; 3],
    /// A quad for each rotation of each row; empty where light is colour.
    by_rotation: Column,
}

impl Quantity {
    /// That of rows, as colour.
    pub(super) fn new(rows: &[Medium], of: impl Fn(&Medium) -> [f32; 3]) -> Self {
        Self { colour: [0, 1, 2].map(|part| column(rows, |row| of(row)[part])), by_rotation: Column::new(0) }
    }
    /// Extinction of even media.
    pub(super) fn of_even_rows(rows: &[Medium]) -> Self {
        Self::new(rows, |row| if row.field == 0 { extinction(row) } else { [0.0; 3] })
    }
    /// Extinction of those by a field, where density is 1.
    pub(super) fn of_field_rows(rows: &[Medium]) -> Self {
        Self::new(rows, |row| if row.field == 0 { [0.0; 3] } else { extinction(row) })
    }
    /// Sets it at all rotations of a table; row 0 has none of it.
    fn tabulate(&mut self, table: &WavelengthTable, rows: &[Medium], of: impl Fn(Wavelengths<'_, One>, &Medium) -> Spectrum<One>) {
        let rotations = table.rotations as usize;
        self.by_rotation = Column::new((rows.len() + 1) * rotations * ROW + PADDING);
        for (number, row) in rows.iter().enumerate() {
            let quads = &mut self.by_rotation[(number + 1) * rotations * ROW..];
            for (rotation, quad) in (0..table.rotations).zip(quads.chunks_exact_mut(ROW)) {
                let [r, g, b]: [f32; 3] = of(Wavelengths::new(Some(table), One.u(rotation)), row).to_rgb().into();
                quad.copy_from_slice(&[r, g, b, 0.0]);
            }
        }
    }
}

fn extinction(row: &Medium) -> [f32; 3] {
    [0, 1, 2].map(|part| row.absorption[part] + row.scattering[part])
}

/// See [`MediumTable::set_wavelengths`].
pub(super) fn set_wavelengths(media: &mut MediumTable, table: &WavelengthTable) {
    let MediumTable { rows, extinction, field_extinction, scattering, emission, .. } = media;
    let colour = |[r, g, b]: [f32; 3]| Rgb::new(One.f(r), One.f(g), One.f(b));
    let scattered = |wavelengths: Wavelengths<'_, One>, row: &Medium| wavelengths.coefficient(colour(row.scattering));
    let taken =
        |wavelengths: Wavelengths<'_, One>, row: &Medium| scattered(wavelengths, row) + wavelengths.coefficient(colour(row.absorption));
    let none = Spectrum::zero(One);
    extinction.tabulate(table, rows, |wavelengths, row| if row.field == 0 { taken(wavelengths, row) } else { none });
    field_extinction.tabulate(table, rows, |wavelengths, row| if row.field == 0 { none } else { taken(wavelengths, row) });
    scattering.tabulate(table, rows, scattered);
    emission.tabulate(table, rows, |wavelengths, row| wavelengths.radiance(colour(row.emission)));
}

/// A medium table, and the wavelengths at which it is asked.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<'a, L: Lanes> {
    /// The table.
    pub(crate) table: &'a MediumTable,
    wavelengths: Wavelengths<'a, L>,
}

impl MediumTable {
    /// What its media do to light of these wavelengths: colour, or those of the table that it was told.
    #[inline(always)]
    pub fn at<'a, L: Lanes>(&'a self, wavelengths: Wavelengths<'a, L>) -> Coefficients<'a, L> {
        Coefficients { table: self, wavelengths }
    }
}

impl<L: Lanes> Coefficients<'_, L> {
    /// Extinction a metre of some rows where density is 1; of even ones none.
    #[inline(always)]
    pub(crate) fn field_extinction(self, l: L, row: U<L>) -> Spectrum<L> {
        self.of(l, &self.table.field_extinction, row)
    }
    /// Extinction a metre of some rows; none of those by a field.
    #[inline(always)]
    pub(crate) fn extinction(self, l: L, row: U<L>) -> Spectrum<L> {
        self.of(l, &self.table.extinction, row)
    }
    /// Scattering a metre of some rows.
    #[inline(always)]
    pub(crate) fn scattering(self, l: L, row: U<L>) -> Spectrum<L> {
        self.of(l, &self.table.scattering, row)
    }
    /// Radiance that a metre of some rows sends.
    #[inline(always)]
    pub(crate) fn emission(self, l: L, row: U<L>) -> Spectrum<L> {
        self.of(l, &self.table.emission, row)
    }
    /// A quantity of some rows.
    #[inline(always)]
    fn of(self, l: L, quantity: &Quantity, row: U<L>) -> Spectrum<L> {
        match self.wavelengths.of_rows(&quantity.by_rotation, row) {
            Some(light) => light,
            None => Wavelengths::rgb(l).coefficient(gathered(l, &quantity.colour, row)),
        }
    }

    /// Scattering and extinction a metre of some rows by fields whose colours vary: by factors on both, R, G, B each, and what they are where the factors
    /// are 1.
    #[inline(always)]
    pub(crate) fn varied(self, l: L, row: U<L>, factors: [[F<L>; 3]; 2], even: [Spectrum<L>; 2]) -> [Spectrum<L>; 2] {
        let factors = factors.map(
            #[inline(always)]
            |[r, g, b]| Rgb::new(r, g, b),
        );
        if !self.wavelengths.is_colour() {
            return varied_spectra(self, row, &factors);
        }
        let rgb = Wavelengths::rgb(l);
        [even[0] * rgb.coefficient(factors[0]), even[1] * rgb.coefficient(factors[1])]
    }
    /// The greatest extinction of some rows by fields where density is 1; `coloured` are those whose colours vary.
    #[inline(always)]
    pub(crate) fn bound(self, l: L, row: U<L>, extinction: Spectrum<L>, coloured: M<L>) -> F<L> {
        let even = extinction.max_component();
        if self.wavelengths.is_colour() || !coloured.any() {
            return even;
        }
        let Rgb { r, g, b } = gathered(l, &self.table.field_extinction.colour, row);
        // Absorption and scattering may both reach it, each at its own colour's spectrum.
        coloured.select(r.max(g).max(b) * (2.0 * ABOVE_COLOUR), even)
    }
    /// What is sent where its colour varies: a factor, R, G, B.
    #[inline(always)]
    pub(crate) fn sent(self, [r, g, b]: [F<L>; 3]) -> Spectrum<L> {
        self.wavelengths.radiance(Rgb::new(r, g, b))
    }
    /// Factors on what media by fields send, between two of the fields' glows, the first by its number.
    #[inline(always)]
    pub(crate) fn glow(self, l: L, number: U<L>, part: F<L>) -> Spectrum<L> {
        let [low, high] = [number, number + 1].map(
            #[inline(always)]
            |number| {
                let [r, g, b, _] = l.gather_quads(&self.table.fields.glow, number * ROW as u32);
                Rgb::new(r, g, b)
            },
        );
        self.wavelengths.radiance(low.lerp(high, part))
    }
}

/// Scattering and extinction at wavelengths where the colours of some rows by fields vary by factors.
#[inline(never)]
fn varied_spectra<L: Lanes>(media: Coefficients<'_, L>, row: U<L>, factors: &[Rgb<L>; 2]) -> [Spectrum<L>; 2] {
    row.lanes().vectorize(
        #[inline(always)]
        || {
            let l = row.lanes();
            let Coefficients { table, wavelengths } = media;
            let scattering = gathered(l, &table.scattering.colour, row) * factors[0];
            let extinction = gathered(l, &table.field_extinction.colour, row) * factors[1];
            let absorption = Rgb::new(extinction.r - scattering.r, extinction.g - scattering.g, extinction.b - scattering.b).max(0.0);
            let scattering = wavelengths.coefficient(scattering);
            [scattering, scattering + wavelengths.coefficient(absorption)]
        },
    )
}

#[inline(always)]
fn gathered<L: Lanes>(l: L, [r, g, b]: &[Column; 3], row: U<L>) -> Rgb<L> {
    Rgb::new(l.gather(r, row), l.gather(g, row), l.gather(b, row))
}
