//! Colour spaces: transfer functions, gamuts, and the names that USD, MaterialX, OCIO and Blender give them. The core renders in linear Rec.709.

mod curve;
mod gamut;
mod matrix;
mod profile;
mod space;
mod stated;
mod transfer;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests;

pub use curve::Curve;
pub use gamut::{Gamut, Primaries};
pub use matrix::{Matrix3, apply, inverse, product};
pub use profile::from_profile;
pub use space::{ColourSpace, Product, UnknownColourSpace};
pub use stated::{Encoding, Stated};
pub use transfer::{Transfer, linear_to_srgb, srgb_to_linear};

/// Weights of luminance in linear Rec.709 (ITU-R BT.709).
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Luminance of a linear Rec.709 colour, in the colour's unit.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    LUMINANCE[0] * r + LUMINANCE[1] * g + LUMINANCE[2] * b
}

/// The same in single precision, as pixels are.
#[inline]
pub fn luminance_of_pixel([r, g, b]: [f32; 3]) -> f32 {
    LUMINANCE[0] as f32 * r + LUMINANCE[1] as f32 * g + LUMINANCE[2] as f32 * b
}
