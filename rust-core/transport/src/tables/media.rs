//! The media of a scene, a row each: what fills closed meshes, or all of space, evenly.

use gonio_simd::{Column, F, Lanes, PADDING, Rgb, Spectrum, U};

/// A medium (pbrt's `HomogeneousMedium`); coefficients a metre, R, G, B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Medium {
    /// Absorption.
    pub absorption: [f32; 3],
    /// Scattering.
    pub scattering: [f32; 3],
    /// Radiance that a metre of it sends.
    pub emission: [f32; 3],
    /// Mean cosine g of its phase function (Henyey and Greenstein), above −1 and below 1.
    pub anisotropy: f32,
}

/// All of a scene. Row 0 is no medium.
#[derive(Clone, Debug, Default)]
pub struct MediumTable {
    rows: Vec<Medium>,
    extinction: [Column; 3],
    scattering: [Column; 3],
    emission: [Column; 3],
    anisotropy: Column,
    /// The row that fills all of space, 0 for none.
    pub everywhere: u32,
    /// Whether any scatters, and whether any shines.
    scatters: bool,
    shines: bool,
}

impl MediumTable {
    /// The row of a medium; media that are alike share one.
    pub fn add(&mut self, medium: Medium) -> u32 {
        if let Some(known) = self.rows.iter().position(|row| *row == medium) {
            return known as u32 + 1;
        }
        self.rows.push(medium);
        let rows = &self.rows;
        self.extinction = three(rows, |row, part| row.absorption[part] + row.scattering[part]);
        self.scattering = three(rows, |row, part| row.scattering[part]);
        self.emission = three(rows, |row, part| row.emission[part]);
        self.anisotropy = column(rows, |row| row.anisotropy);
        self.scatters |= medium.scattering != [0.0; 3];
        self.shines |= medium.emission != [0.0; 3];
        self.rows.len() as u32
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
    /// Extinction a metre of some rows.
    #[inline(always)]
    pub(crate) fn extinction<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Spectrum::coefficient(gathered(l, &self.extinction, row))
    }
    /// Scattering a metre of some rows.
    #[inline(always)]
    pub(crate) fn scattering<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Spectrum::coefficient(gathered(l, &self.scattering, row))
    }
    /// Radiance that a metre of some rows sends.
    #[inline(always)]
    pub(crate) fn emission<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        Spectrum::radiance(gathered(l, &self.emission, row))
    }
    /// Mean cosines of some rows.
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

fn three(rows: &[Medium], of: impl Fn(&Medium, usize) -> f32) -> [Column; 3] {
    [0, 1, 2].map(|part| column(rows, |row| of(row, part)))
}

#[inline(always)]
fn gathered<L: Lanes>(l: L, [r, g, b]: &[Column; 3], row: U<L>) -> Rgb<L> {
    Rgb::new(l.gather(r, row), l.gather(g, row), l.gather(b, row))
}
