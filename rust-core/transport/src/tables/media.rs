//! The media of a scene, a row each: what fills closed meshes evenly.

use gonio_simd::{Lanes, Rgb, Spectrum};

/// A medium (pbrt's `HomogeneousMedium`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Medium {
    /// Absorption a metre, R, G, B.
    pub absorption: [f32; 3],
}

/// All of a scene.
#[derive(Clone, Debug, Default)]
pub struct MediumTable {
    rows: Vec<Medium>,
}

impl MediumTable {
    /// The row of a medium; media that are alike share one.
    pub fn add(&mut self, medium: Medium) -> u32 {
        let row = self.rows.iter().position(|row| *row == medium).unwrap_or_else(|| {
            self.rows.push(medium);
            self.rows.len() - 1
        });
        row as u32
    }
    /// Whether nothing fills any mesh.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
    /// Absorption a metre of a row, in every lane.
    #[inline(always)]
    pub(crate) fn absorption<L: Lanes>(&self, l: L, row: u32) -> Spectrum<L> {
        let [r, g, b] = self.rows[row as usize].absorption.map(|x| l.f(x));
        Spectrum::coefficient(Rgb::new(r, g, b))
    }
}
