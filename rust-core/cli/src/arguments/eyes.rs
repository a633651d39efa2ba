//! Eyes at the points of grids: what `gonio measure`, `gonio dim` and `gonio report` share.

use super::number::{count, finite};
use clap::Args;
use gonio::scene::{SITTING, STANDING};

#[derive(Args, Clone, Debug)]
pub(crate) struct EyeArguments {
    /// Put eyes at the points of these grids: sitting (1.2 m above the surface), standing (1.6 m) or so many metres above it. They have illuminance, melanopic-edi, cct, duv, ra, rf and rg of the plane before them. A point's value is the mean over its directions.
    #[arg(long, value_name = "sitting|standing|METRES", allow_hyphen_values = true, requires = "grid", conflicts_with = "height", value_parser = eye_height)]
    pub(crate) eyes: Option<f64>,
    /// So many level directions around that these eyes look, the first one as the grid faces (+Y, -Z where Y is up); 4 where nothing is said.
    #[arg(long, value_name = "COUNT", requires = "eyes", conflicts_with = "facing", value_parser = count::<u32>(1..=64))]
    pub(crate) directions: Option<u32>,
}

/// Metres from a surface to eyes, by name or as they are.
pub(super) fn eye_height(text: &str) -> Result<f64, String> {
    match text.trim() {
        "sitting" => Ok(SITTING),
        "standing" => Ok(STANDING),
        other => finite(other).map_err(|_| format!("'{other}' was found, expected sitting, standing or a height in metres")),
    }
}
