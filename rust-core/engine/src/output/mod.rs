//! Files: EXR with all passes, deep EXR, PNG and JPEG for looking at, false colour, and comparing images.

mod compare;
mod deep;
mod exr;
mod false_colour;
mod picture;
mod spectral;
mod spectral_read;
mod tone_map;

pub use crate::scene::{Output, check_writable, is_ordinary, write_atomically, write_beside};
pub use compare::{ChannelDifference, Comparison, compare, difference_picture};
pub use deep::write_deep_exr;
pub use exr::{
    Channels, ExrOptions, Further, exposure_of_exr, has_other_primaries, matte_notes, read_exr, view_of_exr, white_luminance_of_exr,
    write_exr, write_exr_with,
};
pub use false_colour::{Canvas, FalseColour, FalseColourScale, MOST_STEPS};
pub use picture::{encode_jpeg, encode_png, write_picture};
pub use spectral::{check_spectral, write_spectral};
pub use spectral_read::spectral_of_exr;
pub use tone_map::{Adaptation, DisplaySpace, Look, ToneMap, display, display_deep, display_linear, display_over_black, log_average};
pub use tone_map::{KEY, ToneCurve, map_lanes};
