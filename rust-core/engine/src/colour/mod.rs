//! Colour spaces: transfer functions, gamuts, and the names that USD, MaterialX, OCIO and Blender give them. The core renders in linear Rec.709.

mod gamut;
mod matrix;
mod space;
mod transfer;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests;

pub use gamut::{Gamut, Primaries};
pub use matrix::{Matrix3, apply, inverse, product};
pub use space::{ColourSpace, UnknownColourSpace, file_rule};
pub use transfer::{Transfer, linear_to_srgb, srgb_to_linear};

/// Luminance of a linear Rec.709 colour, in the colour's unit (ITU-R BT.709).
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}
