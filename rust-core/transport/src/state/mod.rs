//! What waits between wavefront stages, as structs of arrays: pbrt's work items and queues.
//!
//! Paths, shadow rays, measured points, subsurface random walks and light samples. [`workspace::Workspace`] holds all of them for one worker.

pub(crate) mod chunk;
pub(crate) mod columns;
pub(crate) mod light_paths;
pub(crate) mod material_order;
pub(crate) mod mix_weights;
pub(crate) mod nearest;
pub(crate) mod passed;
pub(crate) mod path_core;
pub(crate) mod paths;
pub(crate) mod queue;
pub(crate) mod rays;
pub(crate) mod sample;
pub(crate) mod start_room;
pub(crate) mod textured_emission;
pub(crate) mod times;
pub(crate) mod vertex;
pub(crate) mod wavelengths;
pub(crate) mod workspace;
pub(crate) mod workspaces;
