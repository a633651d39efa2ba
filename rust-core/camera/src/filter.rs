//! Pixel filters as distributions: a sample's place in the pixel is drawn by the filter, so that every sample has weight one.

use gonio_simd::{F, Lanes};

/// Knots of the tabulated inverse.
pub const KNOTS: usize = 257;

/// Where in their pixels samples lie.
#[derive(Clone, Debug)]
pub enum Placement {
    /// At random, by a filter.
    Filter(FilterTable),
    /// On a regular grid of so many places along a pixel's side, row after row.
    Grid(u32),
}

/// The inverse of a filter's cumulative distribution along one axis.
#[derive(Clone, Debug)]
pub struct FilterTable {
    /// Offset from the pixel's centre in pixels at u = i / 256.
    pub inverse: Vec<f32>,
}

impl FilterTable {
    /// Where in the pixel a sample lies, pixels from its centre: the tabulated inverse at `u`.
    #[inline(always)]
    pub fn offset<L: Lanes>(&self, l: L, u: F<L>) -> F<L> {
        let place = u * (self.inverse.len() - 1) as f32;
        let floor = place.floor();
        let [low, high] = l.gather_pairs(&self.inverse, floor.to_i32());
        low.lerp(high, place - floor)
    }
}
