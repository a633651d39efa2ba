//! gonio: a physically exact path tracer on SIMD lanes.
//!
//! A front end fills a [`scene::Scene`], in metres and physical units; [`compile`] lays it out for computing; [`render`] traces it tile by
//! tile into a film.

pub mod accel;
pub mod antialias;
pub mod bench;
pub mod bsdf;
pub mod camera;
pub mod checkpoint;
pub mod colour;
pub mod compile;
pub mod distribution;
pub mod error;
pub mod film;
pub mod geometry;
pub mod graph;
pub mod integrator;
pub mod light;
pub mod measure;
pub mod mesh;
pub mod output;
pub mod render;
pub mod sampler;
pub mod scene;
pub mod sky;
pub mod table;
pub mod texture;
mod threads;

pub use error::{Diagnostic, Error, Result, Severity};
