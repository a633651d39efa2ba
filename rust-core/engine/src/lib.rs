//! gonio: a physically exact path tracer on SIMD lanes.
//!
//! A front end fills a [`scene::Scene`], in metres and physical units; [`compile`] lays it out for computing; [`render`] traces it tile by
//! tile into a film.

pub mod annual;
pub mod annual_glare;
pub mod antialias;
pub mod bake;
pub mod checkpoint;
pub mod compile;
pub mod dim;
pub mod film;
pub mod goniometer;
pub mod light_paths;
pub mod map;
pub mod measure;
pub mod output;
pub mod rays;
pub mod render;
pub mod sample_bsdf;
pub mod sky;
pub mod spectral_picture;
pub mod sunlight;
pub mod threads;
pub mod view_out;

pub use gonio_accel as accel;
pub use gonio_bsdf as bsdf;
pub use gonio_camera as camera;
pub use gonio_image::{colour, deep, memory, texture};
pub use gonio_light as light;
pub use gonio_mesh as mesh;
pub use gonio_scene as scene;
pub use gonio_scene::{Diagnostic, Error, Result, Severity, error};
pub use gonio_table as table;
pub use gonio_transport as transport;
pub use gonio_transport::{geometry, graph};
