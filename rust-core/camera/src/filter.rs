//! Pixel filters as distributions: a sample's place in the pixel is drawn by the filter, so that every sample has weight one.

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
