//! What practice asks of a year: daylight autonomy, useful illuminance, LM-83, EN 17037.

mod counts;
mod en17037;
mod errors;
mod grid;
mod point;

pub(crate) use counts::Counts;
pub(crate) use en17037::Half;
pub use en17037::{AreaErrors, En17037, En17037Errors, Level, Method};
pub(crate) use errors::jackknife;
pub(crate) use grid::Variant;
pub use grid::{Grid, GridErrors};
pub use point::Point;
