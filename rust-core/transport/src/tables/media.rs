//! The media of a scene, a row each: what fills closed meshes evenly.

use gonio_simd::{Column, Lanes, PADDING, Rgb, Spectrum, U};

/// A medium (pbrt's `HomogeneousMedium`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Medium {
    /// Absorption a metre, R, G, B.
    pub absorption: [f32; 3],
}

/// All of a scene. Row 0 is no medium.
#[derive(Clone, Debug, Default)]
pub struct MediumTable {
    rows: Vec<Medium>,
    absorption: [Column; 3],
}

impl MediumTable {
    /// The row of a medium; media that are alike share one.
    pub fn add(&mut self, medium: Medium) -> u32 {
        if let Some(known) = self.rows.iter().position(|row| *row == medium) {
            return known as u32 + 1;
        }
        self.rows.push(medium);
        self.absorption = [0, 1, 2].map(|part| {
            let mut column = Column::new(self.rows.len() + PADDING);
            column[1..].iter_mut().zip(&self.rows).for_each(|(place, row)| *place = row.absorption[part]);
            column
        });
        self.rows.len() as u32
    }
    /// Whether nothing fills any mesh.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
    /// Absorption a metre of some rows.
    #[inline(always)]
    pub(crate) fn absorption<L: Lanes>(&self, l: L, row: U<L>) -> Spectrum<L> {
        let [r, g, b] = &self.absorption;
        Spectrum::coefficient(Rgb::new(l.gather(r, row), l.gather(g, row), l.gather(b, row)))
    }
}
