//! The media of a scene, a row each: what fills closed meshes, or all of space, evenly (homogeneous) or by a field (heterogeneous).

use crate::tables::fields::{FieldTable, ROW};
use gonio_bsdf::phase::{Phase, PhaseTable};
use gonio_simd::{Column, F, Lanes, PADDING, Rgb, Spectrum, U, Wavelengths};

/// A medium (pbrt's `HomogeneousMedium` and `GridMedium`); coefficients a metre, R, G, B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Medium {
    /// Absorption.
    pub absorption: [f32; 3],
    /// Scattering.
    pub scattering: [f32; 3],
    /// Radiance that a metre of it sends.
    pub emission: [f32; 3],
    /// How it scatters.
    pub phase: Phase,
    /// Row of the field that the coefficients are multiplied by, 0 for none.
    pub field: u32,
}

/// All of a scene. Row 0 is no medium.
#[derive(Clone, Debug, Default)]
pub struct MediumTable {
    rows: Vec<Medium>,
    /// Of even ones, and of those by a field.
    extinction: [Column; 3],
    field_extinction: [Column; 3],
    scattering: [Column; 3],
    emission: [Column; 3],
    /// Rows of the phase functions, and mean cosines of those that are Henyey and Greenstein's.
    phase: Column<u32>,
    anisotropy: Column,
    pub(crate) phases: PhaseTable,
    field: Column<u32>,
    /// The fields.
    pub fields: FieldTable,
    /// The row that fills all of space, 0 for none.
    pub everywhere: u32,
    /// By row, the instance set whose light group what it sends is in, the one behind all sets where it is in none.
    set: Column<u32>,
    /// Whether any scatters, and whether any shines.
    scatters: bool,
    shines: bool,
    varies: bool,
}

impl MediumTable {
    /// The row of a medium; media that are alike share one.
    pub fn add(&mut self, medium: Medium) -> u32 {
        if let Some(known) = self.rows.iter().position(|row| *row == medium) {
            return known as u32 + 1;
        }
        self.rows.push(medium);
        self.fill_coefficients(&self.rows.clone());
        let rows = &self.rows;
        self.anisotropy = column(rows, |row| row.phase.henyey_greenstein().unwrap_or(0.0));
        self.phase = Column::new(rows.len() + PADDING);
        for (place, row) in self.phase[1..].iter_mut().zip(rows) {
            *place = self.phases.add(row.phase);
        }
        self.field = Column::new(rows.len() + PADDING);
        self.field[1..].iter_mut().zip(rows).for_each(|(place, row)| *place = row.field);
        self.scatters |= medium.scattering != [0.0; 3];
        self.shines |= medium.emission != [0.0; 3];
        self.varies |= medium.field != 0;
        self.rows.len() as u32
    }
    /// Fills the columns of coefficients.
    fn fill_coefficients(&mut self, rows: &[Medium]) {
        let extinction = |row: &Medium, part: usize| row.absorption[part] + row.scattering[part];
        self.extinction = three(rows, |row, part| if row.field == 0 { extinction(row, part) } else { 0.0 });
        self.field_extinction = three(rows, |row, part| if row.field == 0 { 0.0 } else { extinction(row, part) });
        self.scattering = three(rows, |row, part| row.scattering[part]);
        self.emission = three(rows, |row, part| row.emission[part]);
    }
    /// The same media where every colour is seen as something else, such as what it is at one wavelength.
    pub fn seen(&self, seen: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let of_row = |row: &Medium| Medium {
            absorption: seen(row.absorption),
            scattering: seen(row.scattering),
            emission: seen(row.emission),
            ..*row
        };
        let rows: Vec<Medium> = self.rows.iter().map(of_row).collect();
        let mut media = self.clone();
        media.fill_coefficients(&rows);
        media.fields.see(&seen);
        media
    }
    /// Says which instance set each row belongs to, from row 1 on.
    pub fn set_owners(&mut self, owners: &[u32]) {
        self.set = Column::new(owners.len() + 1 + PADDING);
        self.set[1..=owners.len()].copy_from_slice(owners);
    }
    /// The instance sets of some rows.
    #[inline(always)]
    pub(crate) fn set<L: Lanes>(&self, l: L, row: U<L>) -> U<L> {
        l.gather_integers(&self.set, row)
    }
    /// How many media there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }
    /// Whether there is no medium at all.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
    /// Whether light scatters in any.
    pub fn scatters(&self) -> bool {
        self.scatters
    }
    /// Whether any sends light.
    pub fn shines(&self) -> bool {
        self.shines
    }
    /// Whether any is by a field.
    pub fn varies(&self) -> bool {
        self.varies
    }
    /// The fields of some rows, 0 for even ones.
    #[inline(always)]
    pub(crate) fn field<L: Lanes>(&self, l: L, row: U<L>) -> U<L> {
        l.gather_integers(&self.field, row)
    }
    /// Extinction a metre of some rows where density is 1; of even ones none.
    #[inline(always)]
    pub(crate) fn field_extinction<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Wavelengths::rgb(l).coefficient(gathered(l, &self.field_extinction, row))
    }
    /// Extinction a metre of some rows; none of those by a field.
    #[inline(always)]
    pub(crate) fn extinction<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Wavelengths::rgb(l).coefficient(gathered(l, &self.extinction, row))
    }
    /// Scattering a metre of some rows.
    #[inline(always)]
    pub(crate) fn scattering<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Wavelengths::rgb(l).coefficient(gathered(l, &self.scattering, row))
    }
    /// Radiance that a metre of some rows sends.
    #[inline(always)]
    pub(crate) fn emission<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Wavelengths::rgb(l).radiance(gathered(l, &self.emission, row))
    }
    /// Factors on what media by fields send, by their rows among the fields' glows.
    #[inline(always)]
    pub(crate) fn glow<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        let [r, g, b, _] = l.gather_quads(&self.fields.glow, row * ROW as u32);
        Wavelengths::rgb(l).radiance(Rgb::new(r, g, b))
    }
    /// The phase functions of some rows.
    #[inline(always)]
    pub(crate) fn phase<L: Lanes>(&self, l: L, row: U<L>) -> U<L> {
        l.gather_integers(&self.phase, row)
    }
    /// Mean cosines of some rows, where all phase functions are Henyey and Greenstein's.
    #[inline(always)]
    pub(crate) fn anisotropy<L: Lanes>(&self, l: L, row: U<L>) -> F<L> {
        l.gather(&self.anisotropy, row)
    }
}

/// What varies from place to place, by its red, green and blue.
#[inline(always)]
pub(crate) fn coefficient<L: Lanes>(l: L, [r, g, b]: [F<L>; 3]) -> Spectrum<L> {
    Wavelengths::rgb(l).coefficient(Rgb::new(r, g, b))
}

/// A column by row; row 0 is 0.
fn column(rows: &[Medium], of: impl Fn(&Medium) -> f32) -> Column {
    let mut column = Column::new(rows.len() + PADDING);
    column[1..].iter_mut().zip(rows).for_each(|(place, row)| *place = of(row));
    column
}

fn three(rows: &[Medium], of: impl Fn(&Medium, usize) -> f32) -> [Column; 3] {
    [0, 1, 2].map(|part| column(rows, |row| of(row, part)))
}

#[inline(always)]
fn gathered<L: Lanes>(l: L, [r, g, b]: &[Column; 3], row: U<L>) -> Rgb<L> {
    Rgb::new(l.gather(r, row), l.gather(g, row), l.gather(b, row))
}
