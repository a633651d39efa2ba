//! The media of a scene, a row each: what fills closed meshes, or all of space, evenly (homogeneous) or by a field (heterogeneous).

mod coefficients;

use crate::tables::fields::FieldTable;
use coefficients::Quantity;
use gonio_bsdf::phase::{Phase, PhaseTable};
use gonio_simd::{Column, F, Lanes, PADDING, U, WavelengthTable};

pub use coefficients::Coefficients;

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
    extinction: Quantity,
    field_extinction: Quantity,
    scattering: Quantity,
    emission: Quantity,
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
        let rows = &self.rows;
        self.extinction = Quantity::of_even_rows(rows);
        self.field_extinction = Quantity::of_field_rows(rows);
        self.scattering = Quantity::new(rows, |row| row.scattering);
        self.emission = Quantity::new(rows, |row| row.emission);
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
    /// Tells the coefficients of all rows at the wavelengths of a table, by which they are asked for from now on.
    pub fn set_wavelengths(&mut self, table: &WavelengthTable) {
        coefficients::set_wavelengths(self, table);
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

/// A column by row; row 0 is 0.
fn column(rows: &[Medium], of: impl Fn(&Medium) -> f32) -> Column {
    let mut column = Column::new(rows.len() + PADDING);
    column[1..].iter_mut().zip(rows).for_each(|(place, row)| *place = of(row));
    column
}
