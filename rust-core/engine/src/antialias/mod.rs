//! Adaptive antialiasing for rays without noise: the paper's, in three levels, and with a second threshold.
//!
//! A tile's pixels are sampled at their corners; where these differ, or where a map of the triangles that are seen shows a seam, at four inner points;
//! and where neighbours among corners and inner points differ, in the zone between the two, at the four points of a zigzag. What is not
//! traced is interpolated. All comparisons and sums are the same for any number of threads and width of registers: packets are filled from queues of
//! the whole tile, and a tile looks at no other.

mod compare;
mod places;
mod raster;
mod samples;
mod seams;
mod tables;
mod tile;
mod triangles;
mod view;
mod visibility;

pub use tile::{Antialiaser, TileTask};

/// What counts as a discontinuity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Difference of two corners, of what is shown where white is 1, from which on a pixel is sampled inside.
    pub first: f32,
    /// Difference of neighbours from which on the zone between them is.
    pub second: f32,
    /// Rays of the visibility map along a pixel's side.
    pub map_side: u32,
    /// Whether a pixel that differs both ways is turned by the larger difference; else it stays upright.
    pub steeper: bool,
}

impl Rule {
    /// Two thresholds, of which the second is higher: inner points repair what corners blur, zigzags are for edges.
    pub const STANDARD: Self = Self { first: 8.0 / 255.0, second: 24.0 / 255.0, map_side: 4, steeper: true };
    /// A lower first threshold and a finer map.
    pub const HIGH: Self = Self { first: 4.0 / 255.0, second: 24.0 / 255.0, map_side: 6, steeper: true };
    /// The paper's: one threshold for all.
    pub const PAPER: Self = Self { first: 16.0 / 255.0, second: 16.0 / 255.0, map_side: 4, steeper: false };
}
