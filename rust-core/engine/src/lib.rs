//! gonio: a physically exact path tracer on SIMD lanes.
//!
//! A front end fills a [`scene::Scene`], in metres and physical units; `compile` lays it out for computing; `render` traces it tile by tile
//! into a film; `output` writes files.

pub mod error;
pub mod scene;

pub use error::{Diagnostic, Error, Result, Severity};
