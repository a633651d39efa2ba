//! What waits between wavefront stages, as structs of arrays: pbrt's work items and queues.
//!
//! Paths, shadow rays, measured points, subsurface random walks and light samples. [`workspace::Workspace`] holds all of them for one worker.

pub(crate) mod branches;
pub(crate) mod columns;
pub(crate) mod event;
pub(crate) mod flag;
pub(crate) mod light_samples;
pub(crate) mod measure_points;
pub(crate) mod paths;
pub(crate) mod retraced;
pub(crate) mod sample;
pub(crate) mod shadow_order;
pub(crate) mod shadow_rays;
pub(crate) mod vertex;
pub(crate) mod walks;
pub(crate) mod workspace;
pub(crate) mod workspaces;
