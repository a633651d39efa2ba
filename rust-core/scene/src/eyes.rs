//! Eyes at the points of a calculation grid.

use serde::{Deserialize, Serialize};

/// Metres from the floor to the eyes of somebody who sits.
pub const SITTING: f64 = 1.2;
/// Metres from the floor to the eyes of somebody who stands.
pub const STANDING: f64 = 1.6;

/// Where eyes at a grid's points look, each of them all ways.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Eyes {
    /// So many ways across the grid's normal, even around and clockwise seen from above; the first as near to the grid's `facing` as can be.
    Around(u32),
    /// These ways, world space; any length.
    Towards(Vec<[f64; 3]>),
}
