//! Tests of the module: formats against each other and against closed forms, samplers against their densities.

mod bad_input;
mod chi_square;
mod colours;
mod counted;
mod fit;
mod formats;
mod klems;
mod models;
mod real_files;
mod report;
mod rgl;
mod sampling;
mod tables;
mod trees;

use super::direction::{Direction, cosine_direction, through};

/// Numbers in [0, 1) without visible order, the same every time (Steele, Lea and Flood's SplitMix64, 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A direction at the front, at least 5° above the surface.
    fn direction(&mut self) -> Direction {
        cosine_direction([0.99 * self.next(), self.next()])
    }

    /// A direction on either side.
    fn any_direction(&mut self) -> Direction {
        let d = self.direction();
        if self.next() < 0.5 { d } else { through(d) }
    }
}
