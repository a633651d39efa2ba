//! USD stages as gonio scenes, read through the Python package `pxr` (usd-core).
//!
//! [`load_stage`] does it all; [`Stage::open`] and [`Stage::load`] apart read one stage at many times. Traversal makes *models* of the world
//! and of each prototype (`traverse`), which are then multiplied out into the scene's instances (`place`).

pub mod asset;
pub mod build;
pub mod camera;
pub mod context;
pub mod curves;
mod data_window;
pub mod daylight;
pub mod dependencies;
mod draw_mode;
pub mod explain;
pub mod frame_name;
pub mod framing;
mod goniogram;
mod haze;
pub mod instancer;
mod kept;
mod lamp_spectrum;
pub mod light;
mod light_filter;
mod luminaire_file;
pub mod material;
pub mod memory_limit;
pub mod mesh;
mod mesh_light;
pub mod meter;
pub mod model;
mod motion;
mod nesting;
pub mod nurbs_patch;
pub mod options;
mod photometry;
pub mod place;
pub mod points;
pub mod prim;
pub mod primvar;
pub mod pxr;
pub mod quadrics;
pub mod render_pass;
pub mod render_settings;
pub mod render_variable;
pub mod roles;
pub mod settings;
pub mod skeleton;
pub mod stage;
pub mod strand_values;
pub mod subset;
pub mod tet_mesh;
pub mod traverse;
pub mod view;
pub mod volume;
pub mod vt;
mod watch;
pub mod xform;

pub use luminaire_file::LuminaireFile;
pub use options::{Complexity, Purpose, SampleTime, StageOptions, Standing, VariantSelection};
pub use stage::{CameraInfo, Loaded, Stage, StageInfo, load_stage};
