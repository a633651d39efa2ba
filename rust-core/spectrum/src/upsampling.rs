//! Colours as spectra of reflectance (Jakob and Hanika, A Low-Dimensional Function Space for Efficient Spectral Upsampling, 2019).
//!
//! A reflectance is S(t) = 1/2 + x / (2 √(1 + x²)) with x = (c0 t + c1) t + c2 and t = (nm - 380) / 400: smooth, and between 0 and 1. Its
//! coefficients stand in a table over linear Rec.2020, as a colour is seen under D65 by the CIE 1931 observer. The table is made here, at first use.

mod solve;

use crate::integral::VISIBLE;
use std::sync::LazyLock;

/// From linear Rec.709 to linear Rec.2020 (ITU-R BT.2087).
pub const REC709_TO_REC2020: [[f32; 3]; 3] =
    [[0.627_403_9, 0.329_283, 0.043_313_1], [0.069_097_3, 0.919_540_4, 0.011_362_3], [0.016_391_4, 0.088_013_3, 0.895_595_3]];

/// Nodes along each of the table's three axes.
const RESOLUTION: usize = 32;

/// Added to components before they are divided, so that black is a grey; too small to change another.
const TINY: f32 = 1e-30;

/// The coefficients of colours.
///
/// A colour's greatest component m has the value z, the next one (cyclic) x z, the one after it y z. The axes are x and y from 0 to 1, and
/// s = √z / (√z + √(1 - z)) from [`Upsampling::EDGE`] to 1 less this, all in even steps. Nodes hold coefficients times 2 s (1 - s): bounded, and
/// for greys linear in s.
#[derive(Debug)]
pub struct Upsampling {
    /// Nodes N along an axis.
    pub resolution: usize,
    /// Four words a node: c0, c1, c2 times 2 s (1 - s), and 0; at (((m N + s) N + y) N + x) 4.
    pub table: Vec<f32>,
}

static UPSAMPLING: LazyLock<Upsampling> = LazyLock::new(|| solve::table(RESOLUTION));

/// The table, made at first use.
pub fn upsampling() -> &'static Upsampling {
    &UPSAMPLING
}

impl Upsampling {
    /// The first node of s; the last is 1 less this. At 0 and 1 coefficients are infinite.
    pub const EDGE: f32 = 1.0 / 1024.0;

    /// The coefficients of a linear Rec.2020 colour: those of its nodes, linear between them, over 2 s (1 - s). Components below 0 or above 1
    /// count as these; s stays within its nodes, so black and white are 1e-6 from 0 and 1. Of equal greatest components the first is m.
    pub fn coefficients(&self, rec2020: [f32; 3]) -> [f32; 3] {
        let [r, g, b] = rec2020.map(|value| value.clamp(0.0, 1.0));
        let z = r.max(g).max(b);
        let m = if r == z {
            0
        } else if g == z {
            1
        } else {
            2
        };
        let [next, after] = [[g, b], [b, r], [r, g]][m];
        let root = z.sqrt();
        let s = (root / (root + (1.0 - z).sqrt())).clamp(Self::EDGE, 1.0 - Self::EDGE);
        let steps = (self.resolution - 1) as f32;
        let [(i, u), (j, v), (k, w)] =
            [(next + TINY) / (z + TINY), (after + TINY) / (z + TINY), (s - Self::EDGE) / (1.0 - 2.0 * Self::EDGE)].map(|place| {
                let place = place.min(1.0) * steps;
                let low = place.floor().min(steps - 1.0);
                (low as usize, place - low)
            });
        let n = self.resolution;
        let node = |i: usize, j: usize, k: usize, c: usize| self.table[4 * (((m * n + k) * n + j) * n + i) + c];
        let mix = |a: f32, b: f32, t: f32| a * (1.0 - t) + b * t;
        let scale = 0.5 / (s * (1.0 - s));
        std::array::from_fn(|c| {
            let row = |j: usize, k: usize| mix(node(i, j, k, c), node(i + 1, j, k, c), u);
            let sheet = |k: usize| mix(row(j, k), row(j + 1, k), v);
            mix(sheet(k), sheet(k + 1), w) * scale
        })
    }

    /// The reflectance of a linear Rec.2020 colour at a wavelength in nm.
    pub fn reflectance(&self, rec2020: [f32; 3], nm: f32) -> f32 {
        let [c0, c1, c2] = self.coefficients(rec2020);
        let t = (nm - VISIBLE[0] as f32) * (1.0 / 400.0);
        let x = (c0 * t + c1) * t + c2;
        // Without cancellation where x is large.
        let q = (1.0 + x * x).sqrt();
        let h = 0.5 / (q * (q + x.abs()));
        if x < 0.0 { h } else { 1.0 - h }
    }
}
