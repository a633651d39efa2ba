//! What a goniophotometer counted: intensities with a standard error each, and the fluxes that belong to them.
//!
//! A [`Measurement`] becomes a [`Reduced`] one: a goniogram with the symmetry that the errors bear out, or that the user names, with errors
//! of its own, written as EULUMDAT, LM-63-2019, TM-33 or GLDF, and its figures with standard errors.

mod figures;
mod input;
mod product;
mod reduce;
mod symmetry;

pub use figures::{MeasuredFigures, MeasuredSpread, WithError};
pub use input::{Measurement, MeasurementHead};
pub use product::ProductParts;
pub use reduce::Reduced;
pub use symmetry::SymmetryTest;
